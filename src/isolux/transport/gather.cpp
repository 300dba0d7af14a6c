#include "isolux/transport/gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/transport/follow.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/next_event.h"
#include "isolux/transport/path_tracer.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// METHODS eq. (10) for the gather technique.
double gather_weight(const Meeting& y, double n1_p1, double n2, double pdf) noexcept {
    const double n2_p2 = n2 * pdf * y.cosine / (y.travelled * y.travelled);
    return n2_p2 / (n1_p1 + n2_p2);
}

/// Luminance at y (times the weight) from one cached vertex, METHODS "LE-MIS", T2 for k >= 3.
Rgb light_from_vertex(const Scene& scene,
                      const VertexCache& cache,
                      const EffectiveCounts& counts,
                      const Meeting& y,
                      double pdf,
                      double u) noexcept {
    if (cache.empty())
        return {};
    const std::size_t n = cache.size();
    const PathVertex& v =
        cache.vertices[std::min(n - 1, static_cast<std::size_t>(u * static_cast<double>(n)))];
    const Vector3 d = y.at - v.position;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return {};
    const double inverse = 1.0 / std::sqrt(d2);
    const double cos_v = inverse * dot(v.normal, d);
    const double cos_y = -inverse * dot(y.normal, d);
    if (cos_v <= 0.0 || cos_y <= 0.0)
        return {};
    const double passed = scene.caster.transmittance(v.position, y.at);
    if (passed <= 0.0)
        return {};
    const double p1 = v.continuation * (cos_v / pi) * cos_y / d2 * passed;
    const double weight = gather_weight(y, counts.vertices * p1, counts.gather_later, pdf);
    const double share = static_cast<double>(n) / static_cast<double>(cache.paths);
    return (share * weight * passed * cos_v * cos_y / (d2 * pi)) * (v.radiant * y.diffuse);
}

} // namespace

Rgb gather_indirect(const Scene& scene,
                    const Emission& emission,
                    const MirrorImages& images,
                    const VertexCache& cache,
                    const EffectiveCounts& counts,
                    const Receiver& receiver,
                    GatherPart part,
                    std::size_t directions,
                    std::uint32_t first,
                    const PointRandomness& random,
                    std::uint64_t& rays) {
    if (emission.total_flux() <= 0.0)
        return {};
    const Point3 at = clear_point(scene, receiver);
    Rgb sum;
    for (std::uint32_t s = first; s < first + directions; ++s) {
        NumberSequence numbers(random, s);
        const double u = numbers.next();
        const UnitVector3 w = sample_response(receiver, u, numbers.next());
        const double pdf = pdf_response(receiver, w);
        if (!(pdf > 0.0))
            continue;
        Rgb luminance;
        const auto meet = [&](const Meeting& y) {
            // Behind a mirror no light path can do the same: trace on, nothing to share.
            if (y.reflections > 0) {
                luminance += trace_reflected(scene, emission, images, y, numbers, rays);
                return;
            }
            if (part == GatherPart::mirrors_only)
                return;
            const double u_luminaire = numbers.next();
            const double u_place = numbers.next();
            const double v_place = numbers.next();
            const NextEvent event = estimate_next_event(
                scene, emission, y.at, y.normal, u_luminaire, u_place, v_place);
            const double share =
                gather_weight(y, counts.paths * event.path_density, counts.gather_first, pdf);
            luminance += (y.throughput * share / pi) * (event.illuminance * y.diffuse);
            luminance +=
                y.throughput * light_from_vertex(scene, cache, counts, y, pdf, numbers.next());
            rays += 2;
        };
        luminance += follow(scene, emission, images, {at, w, 1.0, 0.0, 0}, numbers, rays, meet);
        sum += (evaluate_response(receiver, w) / pdf) * luminance;
    }
    return (1.0 / static_cast<double>(directions)) * sum;
}

} // namespace isolux
