#include <vector>

#include <benchmark/benchmark.h>

#include "isolux/transport/direct_light.h"
#include "isolux/transport/gather.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/next_event.h"
#include "isolux/transport/path_tracer.h"

#include "support/test_scene.h"

/// The engine's hot loops in one room of 6 x 4 x 3 m with four panels: nanoseconds a
/// vertex-point pair, a gather ray, a path.
namespace isolux {
namespace {

const Scene& room() {
    static const Scene scene = [] {
        test::Builder b;
        b.add_room(
            {0, 0, 0}, {6, 4, 3}, b.add_diffuse(0.2), b.add_diffuse(0.7), b.add_diffuse(0.5));
        for (const double x : {1.2, 4.2})
            for (const double y : {0.7, 2.7})
                b.add_panel({x, y, 2.99}, {0, 0.6, 0}, {0.6, 0, 0}, 4000);
        return b.build();
    }();
    return scene;
}

const Emission& emission() {
    static const Emission e(room());
    return e;
}

const VertexCache& cache() {
    static const VertexCache c = build_vertex_cache(
        room(), emission(), PathRandomness(1, 0), 0, 4096, {4096.0, 8000.0, 4.0, 4.0});
    return c;
}

Receiver receiver(benchmark::IterationCount i) {
    return {{0.25 + 0.5 * static_cast<double>(i % 12), 1.7, 0.75}, UnitVector3({0, 0, 1})};
}

void unshadowed_kernel(benchmark::State& state) {
    const auto points = static_cast<std::size_t>(state.range(0));
    std::vector<float> u(points * cache().blocks.size() * VertexBlock::size);
    std::vector<float> sums(points * cache().blocks.size() * VertexBlock::columns);
    std::vector<KernelReceiver> receivers;
    for (std::size_t i = 0; i < points; ++i) {
        const Receiver r = receiver(static_cast<benchmark::IterationCount>(i));
        receivers.push_back(make_kernel_receiver(cache(), r, r.point));
    }
    for (auto _ : state) {
        weigh_vertices(
            cache().blocks, IlluminanceKind::planar, Weighting::balanced, receivers, u, sums);
        benchmark::DoNotOptimize(sums.data());
    }
    state.SetLabel(vertex_kernel_instructions());
    state.counters["seconds a pair"] = benchmark::Counter(
        static_cast<double>(cache().size() * points),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(unshadowed_kernel)->Arg(1)->Arg(16);

void local_estimate_of_points(benchmark::State& state) {
    const auto draws = static_cast<std::size_t>(state.range(0));
    LocalScratch scratch;
    std::vector<Receiver> receivers;
    std::vector<LocalPoint> points;
    for (benchmark::IterationCount i = 0; i < 12; ++i)
        receivers.push_back(receiver(i));
    for (const Receiver& r : receivers)
        points.push_back({&r, r.point, 0.37, draws});
    std::vector<Rgb> result(points.size());
    for (auto _ : state)
        benchmark::DoNotOptimize(gather_local_estimates(
            room(), cache(), points, Weighting::balanced, scratch, result));
    state.counters["seconds a point"] = benchmark::Counter(
        static_cast<double>(points.size()),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(local_estimate_of_points)->Arg(4)->Arg(16);

void gather_of_a_point(benchmark::State& state) {
    const MirrorImages images(room());
    std::uint64_t rays = 0;
    benchmark::IterationCount i = 0;
    for (auto _ : state) {
        const PointRandomness random(
            1, StreamPurpose::gather, 0, static_cast<std::uint64_t>(i));
        benchmark::DoNotOptimize(gather_indirect(room(),
                                                 emission(),
                                                 images,
                                                 cache(),
                                                 {4096.0, 8000.0, 4.0, 4.0},
                                                 receiver(i++),
                                                 GatherPart::balanced,
                                                 4,
                                                 0,
                                                 random,
                                                 rays));
    }
    state.counters["rays/s"] =
        benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

BENCHMARK(gather_of_a_point);

void path_tracing_of_a_point(benchmark::State& state) {
    const MirrorImages images(room());
    std::uint64_t rays = 0;
    benchmark::IterationCount i = 0;
    for (auto _ : state) {
        const PointRandomness random(
            1, StreamPurpose::gather, 0, static_cast<std::uint64_t>(i));
        benchmark::DoNotOptimize(
            trace_indirect(room(), emission(), images, receiver(i++), 4, 0, random, rays));
    }
    state.counters["rays/s"] =
        benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

BENCHMARK(path_tracing_of_a_point);

void direct_of_a_point(benchmark::State& state) {
    const MirrorImages images(room());
    const DirectLight direct(room(), emission(), images);
    std::vector<Rgb> result(16);
    std::uint64_t rays = 0;
    benchmark::IterationCount i = 0;
    for (auto _ : state) {
        direct.estimate(receiver(i), static_cast<std::uint64_t>(i), 1, 0, 0, result, rays);
        ++i;
    }
    state.counters["rays/s"] =
        benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

BENCHMARK(direct_of_a_point);

void light_path(benchmark::State& state) {
    const PathRandomness random(1, 0);
    std::vector<PathVertex> vertices;
    std::uint64_t path = 0;
    std::uint64_t rays = 0;
    for (auto _ : state) {
        vertices.clear();
        rays += walk_light_path(room(), emission(), random, path++, vertices).rays;
    }
    state.counters["rays/s"] =
        benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

BENCHMARK(light_path);

/// One sample of the luminaires for a place on a surface, without its ray.
void next_event(benchmark::State& state) {
    const PointRandomness random(1, StreamPurpose::gather, 0, 0);
    std::uint32_t i = 0;
    for (auto _ : state) {
        const PathVertex& at = cache().vertices[i % cache().size()];
        NumberSequence numbers(random, i++);
        const double u_luminaire = numbers.next();
        const double u = numbers.next();
        const double v = numbers.next();
        benchmark::DoNotOptimize(
            sample_next_event(emission(), at.position, at.normal, u_luminaire, u, v));
    }
}

BENCHMARK(next_event);

} // namespace
} // namespace isolux
