#include <chrono>
#include <numbers>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "isolux/scene/primitives.h"
#include "isolux/scene/scene.h"

#include "bench/bare_embree.h"

/// Shadow rays through our caster and, on the same triangles and rays, through bare Embree: the
/// share of its rate that is left after recentring, offsets and double precision.
namespace isolux {
namespace {

/// An office of 12 m x 8 m x 3 m with desks and round columns: about 1.7 thousand triangles.
Scene make_office() {
    SceneDescription d;
    d.materials = {{"grey", Opaque{Rgb::grey(0.5)}, Sides::both}};
    Room room;
    room.name = "office";
    room.footprint = {{0, 0}, {12, 0}, {12, 8}, {0, 8}};
    room.height = 3.0;
    room.walls.assign(4, MaterialId(0));
    d.rooms = {room};
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 3; ++j) {
            const double x = 0.7 + 1.15 * i, y = 1.0 + 2.5 * j;
            const auto add = [&](SurfaceMesh mesh, const Point3& at) {
                d.objects.push_back(
                    {"thing", mesh.transformed({1, 1, 1}, Frame{at}), {MaterialId(0)}});
            };
            add(make_box({0.9, 0.7, 0.02}), {x, y, 0.72});
            add(make_box({0.4, 0.03, 0.35}), {x, y + 0.2, 0.9});
            add(make_cylinder(0.1, 0.7, 8), {x, y, 0.0});
        }
    return build_scene(std::move(d));
}

std::vector<SightSegment> make_segments(std::size_t count) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> u(0.05, 0.95);
    const auto point = [&] {
        return Point3{12.0 * u(engine), 8.0 * u(engine), 3.0 * u(engine)};
    };
    std::vector<SightSegment> segments;
    for (std::size_t i = 0; i < count; i += packet_size) {
        const Point3 common = point(); // a packet shares one end
        for (std::size_t k = 0; k < packet_size; ++k)
            segments.push_back({common, point()});
    }
    return segments;
}

const Scene& office() {
    static const Scene scene = make_office();
    return scene;
}

const std::vector<SightSegment>& segments() {
    static const auto all = make_segments(1U << 14U);
    return all;
}

const bench::BareEmbree& bare() {
    static const bench::BareEmbree embree(office());
    return embree;
}

/// Rays prepared beforehand, so that only Embree's own time counts.
std::vector<RTCRay> make_rays() {
    std::vector<RTCRay> rays;
    for (const auto& s : segments()) {
        RTCRay r{};
        const Vector3 way = s.b - s.a;
        r.org_x = static_cast<float>(s.a.x), r.org_y = static_cast<float>(s.a.y);
        r.org_z = static_cast<float>(s.a.z), r.dir_x = static_cast<float>(way.x);
        r.dir_y = static_cast<float>(way.y), r.dir_z = static_cast<float>(way.z);
        r.tfar = 0.99999F, r.mask = ~0U;
        rays.push_back(r);
    }
    return rays;
}

std::vector<RTCRay16> make_packets() {
    const auto rays = make_rays();
    std::vector<RTCRay16> packets(rays.size() / 16);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        RTCRay16& p = packets[i / 16];
        const std::size_t k = i % 16;
        p.org_x[k] = rays[i].org_x, p.org_y[k] = rays[i].org_y, p.org_z[k] = rays[i].org_z;
        p.dir_x[k] = rays[i].dir_x, p.dir_y[k] = rays[i].dir_y, p.dir_z[k] = rays[i].dir_z;
        p.tnear[k] = p.time[k] = 0.0F, p.tfar[k] = 0.99999F, p.mask[k] = ~0U;
    }
    return packets;
}

double run_single() {
    double sum = 0.0;
    for (const auto& s : segments())
        sum += office().caster.transmittance(s.a, s.b);
    return sum;
}

double run_packets() {
    double sum = 0.0;
    std::array<float, packet_size> result{};
    const std::span all(segments());
    for (std::size_t i = 0; i < all.size(); i += packet_size) {
        office().caster.transmittance16(all.subspan(i, packet_size), 0xFFFF, result);
        for (const float r : result)
            sum += static_cast<double>(r);
    }
    return sum;
}

double run_bare_single() {
    static const auto rays = make_rays();
    double sum = 0.0;
    for (RTCRay r : rays) {
        bench::occluded(bare(), r);
        sum += r.tfar >= 0.0F ? 1.0 : 0.0;
    }
    return sum;
}

double run_bare_packets() {
    static const auto packets = make_packets();
    alignas(64) int valid[16];
    std::fill(std::begin(valid), std::end(valid), -1);
    double sum = 0.0;
    for (RTCRay16 p : packets) {
        bench::occluded(bare(), valid, p);
        for (const float t : p.tfar)
            sum += t >= 0.0F ? 1.0 : 0.0;
    }
    return sum;
}

/// Times both ways turn by turn, so that a busy machine slows both alike.
void compare(benchmark::State& state, double (*ours)(), double (*theirs)()) {
    using Clock = std::chrono::steady_clock;
    Clock::duration bare_time{}, own_time{};
    for (auto _ : state) {
        const auto t0 = Clock::now();
        benchmark::DoNotOptimize(theirs());
        const auto t1 = Clock::now();
        benchmark::DoNotOptimize(ours());
        const auto t2 = Clock::now();
        bare_time += t1 - t0;
        own_time += t2 - t1;
        state.SetIterationTime(std::chrono::duration<double>(t2 - t1).count());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(segments().size()));
    state.counters["share_of_embree"] =
        std::chrono::duration<double>(bare_time) / std::chrono::duration<double>(own_time);
    state.counters["visible"] = ours() / static_cast<double>(segments().size());
}

void BM_OcclusionSingle(benchmark::State& state) {
    compare(state, run_single, run_bare_single);
}

void BM_OcclusionPackets(benchmark::State& state) {
    compare(state, run_packets, run_bare_packets);
}

void BM_FirstHit(benchmark::State& state) {
    for (auto _ : state)
        for (const auto& s : segments())
            benchmark::DoNotOptimize(
                office().caster.find_first_hit(s.a, UnitVector3(s.b - s.a)));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(segments().size()));
}

BENCHMARK(BM_OcclusionSingle)->UseManualTime();
BENCHMARK(BM_OcclusionPackets)->UseManualTime();
BENCHMARK(BM_FirstHit);

} // namespace
} // namespace isolux
