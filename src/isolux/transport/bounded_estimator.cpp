#include "isolux/transport/bounded_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "isolux/base/check.h"
#include "isolux/transport/follow.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/path_tracer.h"
#include "isolux/transport/response.h"
#include "isolux/transport/vertex_draws.h"

namespace isolux {

namespace {

/// One vertex in so many exceeds the bound.
constexpr std::size_t vertices_per_bounded_one = 200;

/// R(w) cos_v / d2, the kernel of METHODS eq. (5) for any receiver, 1/m2.
double kernel_of(const Receiver& receiver, const Point3& at, const PathVertex& v) noexcept {
    const Vector3 d = v.position - at;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return 0.0;
    const Vector3 w = (1.0 / std::sqrt(d2)) * d;
    const double cos_v = -dot(v.normal, w);
    return cos_v > 0.0 ? evaluate_response(receiver, w) * cos_v / d2 : 0.0;
}

} // namespace

double choose_bound(const VertexCache& pilot, const Receiver& receiver, const Point3& at) {
    std::vector<double> kernels;
    for (const PathVertex& v : pilot.vertices)
        if (const double k = kernel_of(receiver, at, v); k > 0.0)
            kernels.push_back(k);
    if (kernels.empty())
        return std::numeric_limits<double>::infinity();
    const std::size_t above = kernels.size() / vertices_per_bounded_one;
    const auto place = kernels.end() - 1 - static_cast<std::ptrdiff_t>(above);
    std::nth_element(kernels.begin(), place, kernels.end());
    return *place;
}

Rgb estimate_below_bound(const Scene& scene,
                         const VertexCache& cache,
                         const Receiver& receiver,
                         double bound,
                         std::size_t draws,
                         double offset) {
    ISOLUX_EXPECT(bound > 0.0 && draws > 0);
    if (cache.empty())
        return {};
    const Point3 at = clear_point(scene, receiver);
    std::vector<double> u;
    u.reserve(cache.size());
    for (const PathVertex& v : cache.vertices)
        u.push_back(luminance_sum(v.radiant) * std::min(bound, kernel_of(receiver, at, v)));
    Rgb sum;
    const double total = draw_in_proportion(u, draws, offset, [&](std::size_t i) {
        const PathVertex& v = cache.vertices[i];
        const double visible = scene.caster.transmittance(at, v.position);
        sum += (visible / luminance_sum(v.radiant)) * v.radiant;
    });
    return (total / (static_cast<double>(cache.paths) * static_cast<double>(draws))) * sum;
}

Rgb gather_above_bound(const Scene& scene,
                       const Emission& emission,
                       const MirrorImages& images,
                       const Receiver& receiver,
                       double bound,
                       std::size_t directions,
                       std::uint32_t first,
                       const PointRandomness& random,
                       std::uint64_t& rays) {
    ISOLUX_EXPECT(bound > 0.0 && directions > 0);
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
        const double response = evaluate_response(receiver, w);
        Rgb luminance;
        const auto meet = [&](const Meeting& y) {
            // What a mirror shows no vertex can: counts in full. Else the part above the bound,
            // METHODS eq. (76).
            double share = 1.0;
            if (y.reflections == 0) {
                const double kernel = response * y.cosine / (y.travelled * y.travelled);
                share = kernel > bound ? 1.0 - bound / kernel : 0.0;
            }
            if (share > 0.0)
                luminance += share * trace_reflected(scene, emission, images, y, numbers, rays);
        };
        luminance += follow(scene, emission, images, {at, w, 1.0, 0.0, 0}, numbers, rays, meet);
        sum += (response / pdf) * luminance;
    }
    return (1.0 / static_cast<double>(directions)) * sum;
}

} // namespace isolux
