#pragma once

#include <cstddef>
#include <vector>

#include "isolux/calc/results.h"
#include "isolux/viz/map_page.h"

namespace isolux {

/// Where a surface's values lie, lx.
struct ValueRange {
    double minimum = 0.0;
    double maximum = 0.0;
    std::size_t darkest = 0; ///< point
    std::size_t brightest = 0;

    [[nodiscard]] bool is_flat() const noexcept { return !(maximum > minimum); }
};

[[nodiscard]] ValueRange find_range(const std::vector<PointResult>& points);

/// Breaks and colours of one map, and which colour a value has.
struct MapScale {
    std::vector<double> breaks;
    std::vector<Colour> colours; ///< one more than breaks

    [[nodiscard]] const Colour& colour_of(double value) const;
};

[[nodiscard]] MapScale
make_scale(const SurfaceResult& result, const ValueRange& range, double confidence);

[[nodiscard]] ColourLegend make_legend(const MapScale& scale, const ValueRange& range);

} // namespace isolux
