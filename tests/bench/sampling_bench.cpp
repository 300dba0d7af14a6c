#include <cstdint>

#include <benchmark/benchmark.h>

#include "isolux/sampling/random_stream.h"
#include "isolux/sampling/sobol.h"
#include "isolux/sampling/warp.h"

// What a light path and a direct sample pay for their random numbers and directions.
namespace isolux {
namespace {

/// One number at a time: three of the four that Philox makes are thrown away.
void philox_one(benchmark::State& state) {
    const RandomStream stream(1, StreamPurpose::gather, 0);
    std::uint64_t index = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(stream.uniform(++index, 5));
    state.SetItemsProcessed(state.iterations());
}

BENCHMARK(philox_one);

void philox_four(benchmark::State& state) {
    const RandomStream stream(1, StreamPurpose::gather, 0);
    std::uint64_t index = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(stream.uniform4(++index, 1));
    state.SetItemsProcessed(4 * state.iterations());
}

BENCHMARK(philox_four);

/// Ten dimensions of successive points, as a light path of two bounces draws them; the argument
/// is where in the sequence.
void sobol_light_path(benchmark::State& state) {
    constexpr std::uint32_t dimensions = 10;
    std::uint32_t scramble[dimensions];
    for (std::uint32_t d = 0; d < dimensions; ++d)
        scramble[d] = make_scramble(1, 0, d);
    auto index = static_cast<std::uint32_t>(state.range(0));
    for (auto _ : state) {
        double sum = 0.0;
        for (std::uint32_t d = 0; d < dimensions; ++d)
            sum += sobol_owen(index, d, scramble[d]);
        benchmark::DoNotOptimize(sum);
        ++index;
    }
    state.SetItemsProcessed(dimensions * state.iterations());
}

BENCHMARK(sobol_light_path)->Arg(0)->Arg(1 << 20);

/// All dimensions of a point at once.
void sobol_whole_points(benchmark::State& state) {
    const ScrambledSobol sequence(1, 0);
    auto index = static_cast<std::uint32_t>(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(sequence.words(index++));
    state.SetItemsProcessed(sobol_dimensions * state.iterations());
}

BENCHMARK(sobol_whole_points)->Arg(0)->Arg(1 << 20);

void spherical_rectangle(benchmark::State& state) {
    const RandomStream stream(1, StreamPurpose::direct, 0);
    const auto x = stream.uniform4(1, 0);
    Point3 eye{0.3, 0.2, 0.0};
    for (auto _ : state) {
        eye.x += 1e-9;
        const SphericalRectangle r({-0.5, -0.5, 2}, {1, 0, 0}, {0, 1, 0}, eye);
        benchmark::DoNotOptimize(r.sample(x[0], x[1]));
    }
}

BENCHMARK(spherical_rectangle);

/// The rectangle is set up once for a point and serves many samples.
void spherical_rectangle_sample(benchmark::State& state) {
    const SphericalRectangle r({-0.5, -0.5, 2}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.2, 0});
    double u = 0.3;
    for (auto _ : state) {
        benchmark::DoNotOptimize(r.sample(u, 0.7));
        u = u < 0.9 ? u + 1e-7 : 0.1;
    }
}

BENCHMARK(spherical_rectangle_sample);

void spherical_triangle_sample(benchmark::State& state) {
    const SphericalTriangle t(UnitVector3(Vector3{1, 0.2, 0.1}),
                              UnitVector3(Vector3{0.1, 1, 0.3}),
                              UnitVector3(Vector3{0.1, 0.2, 1}));
    double u = 0.3;
    for (auto _ : state) {
        benchmark::DoNotOptimize(t.sample(u, 0.7));
        u = u < 0.9 ? u + 1e-7 : 0.1;
    }
}

BENCHMARK(spherical_triangle_sample);

} // namespace
} // namespace isolux
