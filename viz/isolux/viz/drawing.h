#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
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
    double opacity = 1.0; ///< of the fill
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

/// A PNG picture, stretched over a rectangle.
struct Picture {
    std::string png; ///< the file's bytes
    Point2 at;       ///< upper left corner
    double width = 0.0;
    double height = 0.0;
};

/// A page in millimetres: x to the right, y down. A plain list, painted in order; the same
/// list becomes SVG, PNG and PDF.
struct Drawing {
    double width = 0.0;
    double height = 0.0;
    std::string title; ///< for screen readers and file lists
    std::vector<std::variant<Shape, Text, Clip, EndClip, Picture>> items;
};

/// Adds everything of `inner` to `page`, its upper left corner at `at`, `scale` times as large.
void place(Drawing& page, const Drawing& inner, const Point2& at, double scale);

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

/// The same with the characters that mean something in XML and HTML as entities.
[[nodiscard]] std::string escape_xml(std::string_view text);

/// SVG 1.1 with real text; equal drawings give equal bytes.
[[nodiscard]] std::string to_svg(const Drawing& drawing);

/// PNG, painted by cairo in memory: no display, no OpenGL.
/// @throws DeviceError  if cairo cannot (memory, page above 32767 pixels)
[[nodiscard]] std::string to_png(const Drawing& drawing, double dots_per_inch = 200.0);

/// PDF with one page a drawing, real text and a bookmark for each page whose title differs from
/// the one before it. No dates: equal drawings give equal bytes on one machine.
/// @throws DeviceError  if cairo cannot
[[nodiscard]] std::string to_pdf(std::span<const Drawing> pages, const std::string& title);

/// Pixels of a PNG's header; nothing if the bytes are no PNG.
struct PixelSize {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

[[nodiscard]] std::optional<PixelSize> png_size(std::string_view png);

/// Bytes in the 64 letters of RFC 4648, for pictures inside SVG and HTML.
[[nodiscard]] std::string to_base64(std::string_view bytes);

/// Writes `stem`.svg and `stem`.png, each under a temporary name first.
/// @throws WriteError
void write_drawing(const std::filesystem::path& stem, const Drawing& drawing);

/// Writes one file in the format its name ends in: .svg, .png or .pdf (in any letter case).
/// @throws InputError  for another ending
/// @throws WriteError
void write_drawing_file(const std::filesystem::path& file, const Drawing& drawing);

} // namespace isolux
