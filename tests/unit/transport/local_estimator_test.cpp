#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/local_estimator.h"
#include "isolux/transport/response.h"

#include "support/test_scene.h"

namespace isolux {
namespace {

/// A room with a panel; nothing stands in it, so that every vertex above a floor point is seen.
const Scene& room() {
    static const Scene scene = [] {
        test::Builder b;
        b.add_room(
            {0, 0, 0}, {5, 4, 3}, b.add_diffuse(0.3), b.add_diffuse(0.7), b.add_diffuse(0.5));
        b.add_panel({2, 1.5, 2.99}, {0, 1, 0}, {1, 0, 0}, 3000);
        return b.build();
    }();
    return scene;
}

VertexCache make_cache(std::size_t paths) {
    const Emission emission(room());
    const EffectiveCounts counts{static_cast<double>(paths), 2.0 * static_cast<double>(paths)};
    return build_vertex_cache(room(), emission, PathRandomness(3, 0), 0, paths, counts);
}

std::vector<Receiver> make_receivers() {
    std::vector<Receiver> receivers;
    for (std::size_t i = 0; i < 7; ++i)
        receivers.push_back({{0.5 + 0.6 * static_cast<double>(i), 1.1, 0.8},
                             UnitVector3({0, 0, 1}),
                             i == 3 ? IlluminanceKind::cylindrical : IlluminanceKind::planar});
    return receivers;
}

/// METHODS eq. (6), vertex by vertex with a ray each.
double sum_over_vertices(const VertexCache& cache, const Receiver& r, const Point3& at) {
    double sum = 0.0;
    for (const PathVertex& v : cache.vertices) {
        const Vector3 d = v.position - at;
        const UnitVector3 w(d);
        const double cos_vertex = std::max(0.0, -dot(v.normal, w));
        sum += luminance_sum(v.radiant) * evaluate_response(r, w) * cos_vertex
               / length_squared(d) * room().caster.transmittance(at, v.position);
    }
    return sum / static_cast<double>(cache.paths);
}

TEST(LocalEstimator, IsTheSumOverAllVerticesWhereAllAreVisible) {
    const VertexCache cache = make_cache(512);
    const std::vector<Receiver> receivers = make_receivers();
    std::vector<LocalPoint> points;
    for (const Receiver& r : receivers)
        points.push_back({&r, clear_point(room(), r), 0.4, 4});
    LocalScratch scratch;
    std::vector<Rgb> result(points.size());
    gather_local_estimates(room(), cache, points, Weighting::alone, scratch, result);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double e = sum_over_vertices(cache, receivers[p], points[p].at);
        EXPECT_NEAR(luminance_sum(result[p]), e, 1e-4 * e) << p; // single precision
    }
}

TEST(LocalEstimator, DrawsVerticesInProportionToTheirLight) {
    const VertexCache cache = make_cache(64);
    const Receiver r = make_receivers().front();
    LocalScratch scratch;
    std::vector<double> drawn(cache.size(), 0.0);
    constexpr int offsets = 4096;
    for (int k = 0; k < offsets; ++k) {
        const LocalPoint point{&r, clear_point(room(), r), (k + 0.5) / offsets, 2};
        Rgb result;
        for (const LocalDraw& d : gather_local_estimates(
                 room(), cache, {&point, 1}, Weighting::alone, scratch, {&result, 1}))
            drawn[d.vertex] += 0.5 / offsets;
    }
    std::vector<double> light;
    double total = 0.0;
    for (const PathVertex& v : cache.vertices) {
        const Vector3 d = v.position - r.point;
        const UnitVector3 w(d);
        light.push_back(luminance_sum(v.radiant) * evaluate_response(r, w)
                        * std::max(0.0, -dot(v.normal, w)) / length_squared(d));
        total += light.back();
    }
    // Systematic draws at even offsets meet every interval of the running sum once too often or
    // too rarely at each of its ends.
    for (std::size_t i = 0; i < cache.size(); ++i)
        EXPECT_NEAR(drawn[i], light[i] / total, 1.0 / offsets + 1e-4) << i;
}

TEST(LocalEstimator, GivesAPointTheSameLightInAnyCompany) {
    const VertexCache cache = make_cache(256);
    const std::vector<Receiver> receivers = make_receivers();
    std::vector<LocalPoint> points;
    for (const Receiver& r : receivers)
        points.push_back({&r, clear_point(room(), r), 0.7, 16 + points.size(), 3.0});
    LocalScratch scratch;
    std::vector<Rgb> together(points.size());
    gather_local_estimates(room(), cache, points, Weighting::balanced, scratch, together);
    for (std::size_t p = 0; p < points.size(); ++p) {
        Rgb alone;
        gather_local_estimates(
            room(), cache, {&points[p], 1}, Weighting::balanced, scratch, {&alone, 1});
        EXPECT_EQ(alone, together[p]) << p;
    }
}

TEST(LocalEstimator, GivesNothingWithoutVertices) {
    const Receiver r = make_receivers().front();
    const LocalPoint point{&r, r.point, 0.5, 8};
    LocalScratch scratch;
    Rgb result;
    EXPECT_TRUE(gather_local_estimates(
                    room(), VertexCache{}, {&point, 1}, Weighting::alone, scratch, {&result, 1})
                    .empty());
    EXPECT_EQ(result, Rgb{});
}

TEST(VertexCache, PutsEveryVertexIntoTheBlocksOnce) {
    const VertexCache cache = make_cache(300);
    std::vector<int> seen(cache.size(), 0);
    for (std::size_t b = 0; b < cache.blocks.size(); ++b)
        for (std::size_t i = 0; i < VertexBlock::size; ++i)
            if (cache.blocks[b].strength[i] > 0.0F) {
                const std::uint32_t v = cache.vertex_at[b * VertexBlock::size + i];
                ++seen[v];
                EXPECT_FLOAT_EQ(cache.blocks[b].strength[i],
                                static_cast<float>(luminance_sum(cache.vertices[v].radiant)));
            }
    for (const int count : seen)
        EXPECT_EQ(count, 1);
}

} // namespace
} // namespace isolux
