#include "isolux/viz/probe.h"

#include <fmt/format.h>

#include "isolux/viz/colour_scale.h"

namespace isolux {

std::optional<ProbedPoint> find_nearest_point(const Results& results,
                                              const Point3& place,
                                              std::optional<std::size_t> surface) {
    std::optional<ProbedPoint> nearest;
    for (std::size_t s = 0; s < results.surfaces.size(); ++s) {
        if (surface && *surface != s)
            continue;
        const std::vector<Receiver>& receivers = results.surfaces[s].surface.receivers;
        for (std::size_t p = 0; p < receivers.size(); ++p) {
            const double d = length(receivers[p].point - place);
            if (!nearest || d < nearest->distance)
                nearest = ProbedPoint{s, p, d};
        }
    }
    return nearest;
}

std::string describe_point(const Results& results, const ProbedPoint& probed) {
    const SurfaceResult& surface = results.surfaces[probed.surface];
    const Receiver& receiver = surface.surface.receivers[probed.point];
    const PointResult& value = surface.points[probed.point];
    const Interval interval = confidence_interval(value.total, results.confidence);
    return fmt::format("{}: point {} at ({:.3f}, {:.3f}, {:.3f}) m, {:.3f} m away\n"
                       "E = {} lx, {:g} % interval [{}, {}] lx\n"
                       "direct {} lx, indirect {} lx\n",
                       surface.surface.name,
                       probed.point + 1,
                       receiver.point.x,
                       receiver.point.y,
                       receiver.point.z,
                       probed.distance,
                       format_lux(value.total.mean),
                       100.0 * results.confidence,
                       format_lux(interval.lower),
                       format_lux(interval.upper),
                       format_lux(value.direct.mean),
                       format_lux(value.indirect.mean));
}

} // namespace isolux
