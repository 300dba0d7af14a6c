#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "isolux/base/parallel.h"
#include "isolux/calc/bench_rooms.h"
#include "isolux/calc/calculate.h"

/// The bench rooms: CPU seconds, pilot included and scene built, until the points' RMS error is
/// what the room asks for; the error is measured against an independent long run.
namespace isolux {
namespace {

/// A long run is this many times more exact than what is measured with it.
constexpr double reference_ratio = 4.0;

std::vector<double> values_of(const Results& results) {
    std::vector<double> values;
    for (const SurfaceResult& s : results.surfaces)
        for (const PointResult& p : s.points)
            values.push_back(p.total.mean);
    return values;
}

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double v : values)
        sum += v;
    return sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

/// RMS over the points of the difference / value, dark points held to a fiftieth of the mean.
double rms_error(const std::vector<double>& values, const std::vector<double>& reference) {
    const double floor = 0.02 * mean_of(reference);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += std::pow((values[i] - reference[i]) / std::max(reference[i], floor), 2);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

/// RMS of the standard errors a run states.
double stated_error(const Results& results) {
    const double floor = 0.02 * mean_of(values_of(results));
    double sum = 0.0;
    double points = 0.0;
    for (const SurfaceResult& s : results.surfaces)
        for (const PointResult& p : s.points) {
            sum += std::pow(p.total.standard_error / std::max(p.total.mean, floor), 2);
            points += 1.0;
        }
    return std::sqrt(sum / points);
}

struct Measured {
    Results results;
    double tolerance = 0.0;
};

/// The loosest tolerance whose run states `error`, in steps of the square root of two.
Measured run_to(const Scene& scene, const BenchRoom& room, double error, std::uint64_t seed) {
    Settings settings;
    settings.seed = seed;
    for (settings.tolerance = std::min(0.5, 16.0 * error);; settings.tolerance /= 1.4142) {
        Results results = calculate(scene, room.surfaces, settings);
        if (stated_error(results) <= error)
            return {std::move(results), settings.tolerance};
    }
}

void time_to_aim(benchmark::State& state, std::string_view name) {
    const ThreadLimit one(1);
    BenchRoom room = make_bench_room(name);
    const Scene scene = build_scene(std::move(room.scene));
    Measured m;
    for (auto _ : state)
        m = run_to(scene, room, room.rms_error, 1);
    const auto reference =
        values_of(run_to(scene, room, room.rms_error / reference_ratio, 77).results);
    const Results& r = m.results;
    state.counters["cpu_s"] = r.cpu_seconds;
    state.counters["aim_s"] = room.cpu_seconds;
    state.counters["rms_%"] = 100.0 * rms_error(values_of(r), reference);
    state.counters["stated_%"] = 100.0 * stated_error(r);
    state.counters["tolerance_%"] = 100.0 * m.tolerance;
    state.counters["path_rays"] = static_cast<double>(r.rays.path);
    state.counters["shadow_rays"] = static_cast<double>(r.rays.shadow);
    state.counters["gather_rays"] = static_cast<double>(r.rays.gather);
    state.SetLabel(r.estimator + "; units " + std::to_string(r.units));
}

[[maybe_unused]] const bool registered = [] {
    for (const std::string_view name : bench_room_names())
        benchmark::RegisterBenchmark(
            ("time_to_aim/" + std::string(name)).c_str(),
            [name](benchmark::State& state) { time_to_aim(state, name); })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace
} // namespace isolux
