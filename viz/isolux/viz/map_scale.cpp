#include "isolux/viz/map_scale.h"

#include <algorithm>

#include "isolux/viz/colour_scale.h"
#include "isolux/viz/map_text.h"

namespace isolux {

ValueRange find_range(const std::vector<PointResult>& points) {
    ValueRange r;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points[p].total.mean < points[r.darkest].total.mean)
            r.darkest = p;
        if (points[p].total.mean > points[r.brightest].total.mean)
            r.brightest = p;
    }
    if (!points.empty()) {
        r.minimum = points[r.darkest].total.mean;
        r.maximum = points[r.brightest].total.mean;
    }
    return r;
}

const Colour& MapScale::colour_of(double value) const {
    const auto above = std::upper_bound(breaks.begin(), breaks.end(), value);
    return colours[static_cast<std::size_t>(above - breaks.begin())];
}

MapScale make_scale(const SurfaceResult& result, const ValueRange& range, double confidence) {
    MapScale scale;
    scale.breaks =
        choose_breaks(range.minimum, range.maximum, typical_half_width(result, confidence));
    scale.colours = band_colours(scale.breaks.size() + 1);
    return scale;
}

ColourLegend make_legend(const MapScale& scale, const ValueRange& range) {
    ColourLegend legend{"lx", scale.colours, {}, format_lux(range.minimum), ""};
    for (const double b : scale.breaks)
        legend.breaks.push_back(format_break(b));
    if (!scale.breaks.empty())
        legend.highest = format_lux(range.maximum);
    return legend;
}

} // namespace isolux
