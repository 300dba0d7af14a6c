#include "isolux/calc/sobolev_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"
#include "isolux/sampling/random_stream.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Nearest to horizontal that a path may start, so that its first landing is finite.
constexpr double least_slope = 1e-9;

/// Walks one path and calls `arrive(plane, x, y, order)` at every landing; x and y in m from
/// the foot of the source, plane 0 or 1, order = reflections so far. Roulette by reflectance
/// keeps the flux of a path constant.
template <class Arrive>
void walk(const SobolevProblem& p,
          const RandomStream& random,
          std::uint64_t path,
          Arrive&& arrive) {
    const double h1 = in_metre(p.source_height);
    const double separation = in_metre(p.separation);
    std::array<double, 4> u = random.uniform4(path, 0);
    const double slope = 2.0 * u[0] - 1.0;
    const double steep = std::max(std::abs(slope), least_slope);
    int plane = slope < 0.0 ? 0 : 1;
    const double away = plane == 0 ? h1 : separation - h1;
    double length = away * std::sqrt(1.0 - steep * steep) / steep;
    double azimuth = 2.0 * pi * u[1];
    double x = length * std::cos(azimuth);
    double y = length * std::sin(azimuth);
    for (std::uint32_t order = 0;; ++order) {
        arrive(plane, x, y, order);
        u = random.uniform4(path, order + 1);
        if (u[0] >= (plane == 0 ? p.reflectance_1 : p.reflectance_2))
            return;
        length = separation * std::sqrt(u[1] / (1.0 - u[1]));
        azimuth = 2.0 * pi * u[2];
        x += length * std::cos(azimuth);
        y += length * std::sin(azimuth);
        plane = 1 - plane;
    }
}

} // namespace

double Ring::area() const noexcept { return pi * (outer * outer - inner * inner); }

Ring ring_around(double radius, double width) noexcept {
    return {std::max(0.0, radius - 0.5 * width), radius + 0.5 * width};
}

PlaneValues count_on_rings(const SobolevProblem& problem,
                           std::span<const Ring> rings,
                           std::size_t paths,
                           std::uint64_t seed,
                           std::uint32_t replicate) {
    ISOLUX_EXPECT(paths > 0);
    const RandomStream random(seed, StreamPurpose::light_path, replicate);
    const std::size_t n = rings.size();
    std::vector<double> all(2 * n, 0.0);
    std::vector<double> straight(2 * n, 0.0);
    std::vector<double> inner;
    std::vector<double> outer;
    for (const Ring& ring : rings) {
        inner.push_back(ring.inner * ring.inner);
        outer.push_back(ring.outer * ring.outer);
    }
    const double farthest = n > 0 ? *std::ranges::max_element(outer) : 0.0;
    for (std::size_t i = 0; i < paths; ++i)
        walk(problem, random, i, [&](int plane, double x, double y, std::uint32_t order) {
            const double r2 = x * x + y * y;
            if (r2 >= farthest)
                return;
            for (std::size_t k = 0; k < n; ++k) {
                if (r2 < inner[k] || r2 >= outer[k])
                    continue;
                const std::size_t at = static_cast<std::size_t>(plane) * n + k;
                all[at] += 1.0;
                straight[at] += order == 0 ? 1.0 : 0.0;
            }
        });
    PlaneValues values;
    for (std::size_t k = 0; k < 2 * n; ++k) {
        const double lux_per_path =
            in_lumen(problem.flux) / (static_cast<double>(paths) * rings[k % n].area());
        values.total.push_back(lux_per_path * all[k]);
        values.reflected.push_back(lux_per_path * (all[k] - straight[k]));
    }
    return values;
}

PlaneValues estimate_between_planes(const SobolevProblem& problem,
                                    std::span<const double> radii,
                                    std::size_t paths,
                                    std::uint64_t seed,
                                    std::uint32_t replicate) {
    ISOLUX_EXPECT(paths > 0);
    const RandomStream random(seed, StreamPurpose::gather, replicate);
    const std::size_t n = radii.size();
    const double h = in_metre(problem.separation);
    const double h2 = h * h;
    PlaneValues values;
    values.reflected.assign(2 * n, 0.0);
    for (std::size_t i = 0; i < paths; ++i)
        walk(problem, random, i, [&](int plane, double x, double y, std::uint32_t) {
            const double rho = plane == 0 ? problem.reflectance_1 : problem.reflectance_2;
            double* const opposite = values.reflected.data() + (plane == 0 ? n : 0);
            for (std::size_t k = 0; k < n; ++k) {
                // both cosines are H/d, so G = H^2/d^4
                const double d2 = (x - radii[k]) * (x - radii[k]) + y * y + h2;
                opposite[k] += rho * h2 / (d2 * d2);
            }
        });
    const double scale = in_lumen(problem.flux) / (pi * static_cast<double>(paths));
    for (std::size_t k = 0; k < 2 * n; ++k) {
        values.reflected[k] *= scale;
        const SobolevPlane plane = k < n ? SobolevPlane::one : SobolevPlane::two;
        values.total.push_back(values.reflected[k]
                               + in_lux(sobolev_direct(problem, plane, Metre(radii[k % n]))));
    }
    return values;
}

} // namespace isolux
