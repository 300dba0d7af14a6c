#pragma once

#include <span>
#include <string>
#include <vector>

#include "isolux/viz/drawing.h"

/// Charts of values over one variable: lines, marks and error bars, as SVG and PNG.
namespace isolux {

enum class AxisScale { linear, logarithmic };
enum class SeriesLook { line, marks };

/// One curve, or one row of marks with error bars.
struct ChartSeries {
    std::string name;
    SeriesLook look = SeriesLook::marks;
    Colour colour;
    std::vector<Point2> points;
    std::vector<double> half_widths; ///< of the error bars, in units of y; empty: none
};

/// One frame with axes. What lies beyond the axes is cut off.
struct Chart {
    std::string title;
    std::string x_name;
    std::string y_name;
    AxisScale x_scale = AxisScale::linear;
    AxisScale y_scale = AxisScale::linear;
    std::vector<ChartSeries> series;
};

/// A colour for the i-th series: eight that stay apart for people who see colours differently
/// (Okabe and Ito, "Color universal design", 2008).
[[nodiscard]] Colour series_colour(std::size_t i) noexcept;

/// Charts below one another on one page, with one legend of all names; series of the same name
/// are one entry. Points that are no numbers, or not above zero on a logarithmic axis, are left
/// out.
[[nodiscard]] Drawing draw_charts(const std::string& title,
                                  const std::vector<std::string>& remarks,
                                  std::span<const Chart> charts);

} // namespace isolux
