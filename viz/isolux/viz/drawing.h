#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "isolux/scene/room.h"

namespace isolux {

/// An sRGB colour, 8 bits a channel.
struct Colour {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;

    friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

using Polyline = std::vector<Point2>;

struct Stroke {
    Colour colour;
    double width = 0.2; ///< mm
    double dash = 0.0;  ///< mm of line and of gap; 0: solid
};

enum class Ends { open, closed };

/// Several polylines as one shape, filled by the even-odd rule.
struct Shape {
    std::vector<Polyline> lines;
    Ends ends = Ends::closed;
    std::optional<Colour> fill;
    std::optional<Stroke> stroke;
};

enum class Anchor { start, middle, end };
enum class Weight { normal, bold };

struct Text {
    std::string text;  ///< UTF-8
    Point2 at;         ///< on the baseline
    double size = 2.6; ///< mm, of the em square
    Anchor anchor = Anchor::start;
    Weight weight = Weight::normal;
    double turn = 0.0; ///< degrees, counter-clockwise
    Colour colour;
    std::optional<Colour> halo; ///< a rim that keeps lines behind the text away
};

/// Everything up to the matching EndClip shows only inside `lines` (even-odd).
struct Clip {
    std::vector<Polyline> lines;
};

struct EndClip {};

/// A page in millimetres: x to the right, y down. A plain list, painted in order; the same
/// list becomes SVG and PNG.
struct Drawing {
    double width = 0.0;
    double height = 0.0;
    std::string title; ///< for screen readers and file lists
    std::vector<std::variant<Shape, Text, Clip, EndClip>> items;
};

/// How wide text is in the face that is drawn with (DejaVu Sans). Ask it while laying out.
class FontRuler {
public:
    FontRuler();
    ~FontRuler();
    FontRuler(FontRuler&&) noexcept;
    FontRuler& operator=(FontRuler&&) noexcept;

    /// Advance width in mm of UTF-8 `text` at `size` mm.
    [[nodiscard]] double width(std::string_view text, double size, Weight weight) const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Share of the em square that a capital or a digit of the face rises above the baseline.
inline constexpr double cap_height = 0.73;

/// `text` without control characters and with '?' for bytes that are not UTF-8: what both
/// painters can take. They call it themselves.
[[nodiscard]] std::string printable(std::string_view text);

/// SVG 1.1 with real text; equal drawings give equal bytes.
[[nodiscard]] std::string to_svg(const Drawing& drawing);

/// PNG, painted by cairo in memory: no display, no OpenGL.
/// @throws DeviceError  if cairo cannot (memory, page above 32767 pixels)
[[nodiscard]] std::string to_png(const Drawing& drawing, double dots_per_inch = 200.0);

/// Writes `stem`.svg and `stem`.png, each under a temporary name first.
/// @throws WriteError
void write_drawing(const std::filesystem::path& stem, const Drawing& drawing);

} // namespace isolux
