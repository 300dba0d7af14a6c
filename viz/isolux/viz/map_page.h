#pragma once

#include <array>
#include <string>
#include <vector>

#include "isolux/viz/drawing.h"

namespace isolux {

/// A rectangle in metres: what a map shows.
struct Extent {
    Point2 low{1e300, 1e300};
    Point2 high{-1e300, -1e300};

    void include(const Point2& p) noexcept;

    [[nodiscard]] double width() const noexcept { return high.x - low.x; }

    [[nodiscard]] double height() const noexcept { return high.y - low.y; }

    [[nodiscard]] bool is_empty() const noexcept { return high.x < low.x; }

    /// Grown by `margin` on all sides and to at least `smallest` each way, m.
    [[nodiscard]] Extent grown(double margin, double smallest) const noexcept;
};

/// The palette all maps share.
namespace ink {
inline constexpr Colour black{26, 26, 26};
inline constexpr Colour grey{110, 110, 110};
inline constexpr Colour light_grey{200, 200, 200};
inline constexpr Colour furniture{232, 232, 232};
inline constexpr Colour white{255, 255, 255};
} // namespace ink

/// What a legend says: a swatch or a small drawing of its own, and words.
struct LegendEntry {
    std::vector<Shape>
        symbol; ///< in mm, within 0..symbol_width x -2..2 about the line's middle
    std::string text;
};

/// The bands of a false-colour scale, dark to light; one break fewer than colours.
struct ColourLegend {
    std::string unit;
    std::vector<Colour> colours;
    std::vector<std::string> breaks;
    std::string lowest;  ///< value at the dark end
    std::string highest; ///< value at the light end
};

struct PageText {
    std::string title;
    std::string project;              ///< after the title, grey; may be empty
    std::string figures;              ///< the line that counts
    std::vector<std::string> remarks; ///< small lines below
    double largest_width = 230.0;     ///< of the map's frame, mm
};

/// A page around a map: title above, axes in metres on two sides, legend and scale bar at the
/// right of high maps and below flat ones.
class MapPage {
public:
    MapPage(const PageText& text,
            const Extent& extent,
            std::array<std::string, 2> axis_names,
            const ColourLegend& colours,
            const std::vector<LegendEntry>& entries);

    /// Metres of the map to millimetres of the page.
    [[nodiscard]] Point2 to_page(const Point2& metres) const noexcept;
    [[nodiscard]] std::vector<Polyline> to_page(const std::vector<Polyline>& lines) const;

    [[nodiscard]] double mm_per_metre() const noexcept { return scale_; }

    /// The map's frame on the page, a closed loop.
    [[nodiscard]] Polyline frame() const;

    void add(Shape shape) { drawing_.items.emplace_back(std::move(shape)); }

    void add(Text text) { drawing_.items.emplace_back(std::move(text)); }

    void open_clip(std::vector<Polyline> loops) {
        drawing_.items.emplace_back(Clip{std::move(loops)});
    }

    void close_clip() { drawing_.items.emplace_back(EndClip{}); }

    [[nodiscard]] const FontRuler& ruler() const noexcept { return ruler_; }

    [[nodiscard]] Drawing finish() &&;

private:
    void write_texts(const PageText& text);
    void write_axes();
    void write_swatch(double x, double y, double width, double height, const Colour& colour);
    double write_colours_row(const ColourLegend& colours, Point2 at);
    double write_colours_column(const ColourLegend& colours, Point2 at);
    double write_entries(const std::vector<LegendEntry>& entries, Point2 at, bool is_row);
    double write_scale_bar(Point2 at);
    [[nodiscard]] double width_of(const PageText& text) const;
    [[nodiscard]] double width_of(const LegendEntry& entry) const;
    [[nodiscard]] double width_of_panel(const std::vector<LegendEntry>& entries) const;

    Drawing drawing_;
    FontRuler ruler_;
    Extent extent_;
    std::array<std::string, 2> axis_names_;
    double scale_ = 1.0; ///< mm per metre
    Point2 corner_;      ///< upper left corner of the frame, mm
};

/// Largest of 1, 2, 5 x 10^k that is not above `value`, smallest that is not below it.
/// @pre value > 0
[[nodiscard]] double nice_below(double value) noexcept;
[[nodiscard]] double nice_above(double value) noexcept;

/// `text` cut to `width` mm, with an ellipsis where something is missing.
[[nodiscard]] std::string shorten(
    const std::string& text, double width, double size, Weight weight, const FontRuler& ruler);

} // namespace isolux
