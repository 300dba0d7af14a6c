#include <vector>

#include <benchmark/benchmark.h>

#include "isolux/calc/light_scenes.h"

// One light scene from stored contributions, with its errors: METHODS eq. (115).
namespace isolux {
namespace {

constexpr std::size_t sources = 200;
constexpr std::size_t surfaces = 10;
constexpr std::size_t points_each = 1000;
constexpr std::size_t replicates = 16;

Results empty_results() {
    Results r;
    r.replicates = replicates;
    r.surfaces.resize(surfaces);
    for (SurfaceResult& s : r.surfaces)
        s.surface.receivers.resize(points_each, {Point3{}, UnitVector3::from_unit({0, 0, 1})});
    return r;
}

Contributions made_up_contributions() {
    Contributions c;
    c.replicates = replicates;
    c.points = surfaces * points_each;
    for (std::size_t s = 0; s < sources; ++s)
        c.sources.push_back(
            {"source " + std::to_string(s), SourceKind::luminaire, 1000.0, {s}});
    const std::size_t values = sources * replicates * c.points;
    c.direct.resize(values);
    c.indirect.resize(values);
    for (std::size_t i = 0; i < values; ++i) {
        c.direct[i] = 1.0F + static_cast<float>(i % 7);
        c.indirect[i] = 1.0F + static_cast<float>(i % 5);
    }
    return c;
}

void recombine_200_sources_at_10000_points(benchmark::State& state) {
    const Results results = empty_results();
    const Contributions c = made_up_contributions();
    LightScene scene{"scene", std::vector<double>(sources, 0.5)};
    for (auto _ : state) {
        scene.factors.front() += 1e-6;
        benchmark::DoNotOptimize(evaluate_scene(c, scene, results, {}, 0.95));
    }
}

BENCHMARK(recombine_200_sources_at_10000_points)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace
} // namespace isolux
