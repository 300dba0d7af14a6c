#include <cmath>
#include <numbers>
#include <vector>

#include <benchmark/benchmark.h>

#include "isolux/base/polygon.h"

// Unshadowed direct light of a Lambertian panel at one point: METHODS eq. (12).
namespace isolux {
namespace {

/// A regular polygon of that many corners, the whole above the horizon or half of it below.
void projected_solid_angle_of(benchmark::State& state) {
    const auto corners = static_cast<std::size_t>(state.range(0));
    const double lift = state.range(1) != 0 ? 0.0 : 1.5;
    std::vector<Point3> polygon;
    for (std::size_t k = 0; k < corners; ++k) {
        const double phi =
            2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
        polygon.push_back({2.0, std::cos(phi), lift + std::sin(phi)});
    }
    Point3 p{0, 0, 0};
    const UnitVector3 up = UnitVector3::from_unit({0, 0, 1});
    for (auto _ : state) {
        p.x += 1e-9;
        benchmark::DoNotOptimize(projected_solid_angle(polygon, p, up));
    }
}

BENCHMARK(projected_solid_angle_of)
    ->ArgNames({"corners", "cut"})
    ->ArgsProduct({{4, 64}, {0, 1}});

} // namespace
} // namespace isolux
