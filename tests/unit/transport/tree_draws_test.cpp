#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/sampling/random_stream.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/response.h"

#include "support/random_importance.h"
#include "support/statistics.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

constexpr double corner = 0.8; // m

/// A furnished room: tables, a screen, a leaning board and a column of many sides, so that
/// there are clusters that face one way and others that do not.
const Scene& room() {
    static const Scene scene = [] {
        test::Builder b;
        const MaterialId grey = b.add_diffuse(0.5);
        b.add_room({0, 0, 0}, {6, 5, 3}, b.add_diffuse(0.3), b.add_diffuse(0.8), grey);
        for (int k = 0; k < 4; ++k) {
            const double x = 0.5 + 1.4 * k;
            b.add_quad({x, 1, 0.72}, {1, 0, 0}, {0, 0.8, 0}, grey);
            b.add_quad({x, 1, 0.70}, {0, 0.8, 0}, {1, 0, 0}, grey);
        }
        b.add_quad({1, 2.5, 0.4}, {3, 0, 0}, {0, 0, 1.2}, grey);
        b.add_quad({1, 3.2, 0.0}, {2, 0, 0}, {0, 0.9, 1.1}, grey);
        for (int k = 0; k < 12; ++k) {
            const double turn = 2.0 * 3.14159265358979 / 12.0;
            const auto at = [&](int i) {
                return Point3{
                    5.0 + 0.3 * std::cos(turn * i), 3.8 + 0.3 * std::sin(turn * i), 0};
            };
            b.add_quad(at(k), at(k + 1) - at(k), {0, 0, 2.5}, grey);
        }
        b.add_panel({1.0, 1.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
        b.add_panel({4.0, 3.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 4000.0);
        return b.build();
    }();
    return scene;
}

VertexCache
make_cache(Weighing weighing, std::size_t paths = 8192, const PathImportance& importance = {}) {
    const Emission emission(room());
    const auto m = static_cast<double>(paths);
    const EffectiveCounts counts{m, 2.5 * m, 1.0, 1.0, corner};
    return build_vertex_cache(
        room(), emission, PathRandomness(3, 0), 0, paths, counts, importance, {}, weighing);
}

const VertexCache& tree_cache() {
    static const VertexCache cache = make_cache(Weighing::tree);
    return cache;
}

/// A tile: a short row of points, one of them a centimetre from the screen.
std::vector<Receiver> make_tile(IlluminanceKind kind, const Vector3& axis = {0, 0, 1}) {
    std::vector<Receiver> tile;
    for (std::size_t i = 0; i < 16; ++i)
        tile.push_back({{1.2 + 0.07 * static_cast<double>(i), i == 5 ? 2.49 : 2.2, 0.8},
                        UnitVector3(axis),
                        kind});
    return tile;
}

std::vector<TreePoint> make_points(const VertexCache& cache,
                                   std::span<const Receiver> tile,
                                   bool leaves = false,
                                   double rays = 4.0) {
    std::vector<TreePoint> points;
    for (const Receiver& r : tile) {
        const Point3 at = clear_point(room(), r);
        points.push_back({make_kernel_receiver(cache, r, at, rays), at, 0.0, 1, leaves});
    }
    return points;
}

/// u of all vertices in the order of the blocks, METHODS eq. (60), without those of (122).
std::vector<double> all_u(const VertexCache& cache, const TreePoint& p, IlluminanceKind kind) {
    std::vector<float> u(cache.blocks.size() * VertexBlock::size, 0.0F);
    std::vector<float> sums(cache.blocks.size() * VertexBlock::columns);
    weigh_vertices(cache.blocks, kind, Weighting::balanced, {&p.receiver, 1}, u, sums);
    for (std::size_t i = 0; p.leaves_corners && i < cache.close.all.size(); ++i)
        if (length_squared(cache.close.all[i].position - p.at) < corner * corner)
            u[cache.close.all[i].place] = 0.0F;
    return {u.begin(), u.end()};
}

double sum(std::span<const double> u) { return std::accumulate(u.begin(), u.end(), 0.0); }

/// Mean over the points of a tile of (mean of some draws with random offsets)/(sum of u), and
/// the same of the draws of vertices that lie above 1 m only.
struct Means {
    Estimate all, above;
};

Means mean_of_draws(const VertexCache& cache,
                    std::vector<TreePoint> points,
                    IlluminanceKind kind,
                    std::size_t draws) {
    const auto is_above = [&](std::size_t place) {
        return cache.vertices[cache.vertex_at[place]].position.z > 1.0;
    };
    std::vector<double> full, high;
    for (TreePoint& p : points) {
        p.draws = draws;
        std::vector<double> u = all_u(cache, p, kind);
        full.push_back(sum(u));
        for (std::size_t i = 0; i < u.size(); ++i)
            u[i] = is_above(i) ? u[i] : 0.0;
        high.push_back(sum(u));
    }
    constexpr std::size_t rounds = 24;
    TreeScratch scratch;
    std::vector<TreeDraw> drawn(points.size() * draws);
    std::vector<double> all(test::seeds, 0.0), above(test::seeds, 0.0);
    for (std::size_t s = 0; s < test::seeds; ++s)
        for (std::size_t k = 0; k < rounds; ++k) {
            const RandomStream stream(s, StreamPurpose::subset, 0);
            for (std::size_t p = 0; p < points.size(); ++p)
                points[p].offset = stream.uniform(p, static_cast<std::uint32_t>(k));
            draw_by_tree(cache, points, kind, Weighting::balanced, scratch, drawn);
            const double share = 1.0 / static_cast<double>(points.size() * rounds);
            for (std::size_t i = 0; i < drawn.size(); ++i) {
                all[s] += share * drawn[i].share / full[i / draws];
                if (drawn[i].share > 0.0 && is_above(drawn[i].place))
                    above[s] += share * drawn[i].share / high[i / draws];
            }
        }
    return {estimate_from_replicates(all), estimate_from_replicates(above)};
}

/// Everything that can light a point is in the cut, once.
double left_out(const VertexCache& cache, const TreeCut& cut, std::vector<double> u) {
    for (const std::uint32_t leaf : cut.leaves)
        std::fill_n(u.begin() + static_cast<std::ptrdiff_t>(16 * leaf), 16, 0.0);
    for (const TreeCut::Place& place : cut.places) {
        std::size_t size = VertexTree::leaf;
        for (std::size_t level = 0; level < place.level; ++level)
            size *= VertexTree::forks;
        const std::size_t first = size * place.index;
        std::fill(u.begin() + static_cast<std::ptrdiff_t>(first),
                  u.begin() + static_cast<std::ptrdiff_t>(std::min(first + size, u.size())),
                  0.0);
    }
    EXPECT_FALSE(cache.tree.empty());
    return sum(u);
}

class TreeDraws : public testing::TestWithParam<IlluminanceKind> {};

// False-alarm rate of every z-test: 2e-9, support/statistics.h.
TEST_P(TreeDraws, HaveTheSumOfAllAsTheirMeanForAnyNumber) {
    const auto points = make_points(tree_cache(), make_tile(GetParam()));
    for (const std::size_t draws : {1U, 8U, 64U}) {
        const Means m = mean_of_draws(tree_cache(), points, GetParam(), draws);
        EXPECT_LT(std::abs(test::z_score(m.all, 1.0)), test::z_limit) << m.all.mean;
        EXPECT_LT(std::abs(test::z_score(m.above, 1.0)), test::z_limit) << m.above.mean;
        EXPECT_LT(m.all.standard_error, 3e-3);
    }
}

TEST_P(TreeDraws, HaveItForAnyChancesButNotWhereOneIsMissing) {
    VertexCache bent = tree_cache();
    const RandomStream stream(9, StreamPurpose::subset, 0);
    for (std::size_t level = 0; level < bent.tree.levels.size(); ++level)
        for (std::size_t r = 0; r < bent.tree.levels[level].size(); ++r)
            for (std::size_t i = 0; i < ClusterRow::size; ++i)
                bent.tree.levels[level][r].strength[i] *= static_cast<float>(std::exp2(
                    2.0 * stream.uniform(100 * r + level, static_cast<std::uint32_t>(i))
                    - 1.0));
    const auto points = make_points(bent, make_tile(GetParam()));
    const Means m = mean_of_draws(bent, points, GetParam(), 4);
    EXPECT_LT(std::abs(test::z_score(m.all, 1.0)), test::z_limit) << m.all.mean;
    EXPECT_LT(std::abs(test::z_score(m.above, 1.0)), test::z_limit) << m.above.mean;

    // Planted: every seventh cluster of level 0 is never gone into by the one above it.
    VertexCache wrong = tree_cache();
    for (ClusterRow& row : wrong.tree.levels[0])
        row.strength[6] = row.strength[13] = 0.0F;
    const Means w = mean_of_draws(wrong, points, GetParam(), 4);
    EXPECT_GT(std::abs(test::z_score(w.all, 1.0)), test::z_limit) << w.all.mean;
}

TEST_P(TreeDraws, LeaveCornersToWalks) {
    std::vector<Receiver> tile = make_tile(GetParam());
    for (Receiver& r : tile) // along the foot of a wall
        r.point = {r.point.x, 0.1, 0.15};
    const auto points = make_points(tree_cache(), tile, true);
    const Means m = mean_of_draws(tree_cache(), points, GetParam(), 4);
    EXPECT_LT(std::abs(test::z_score(m.all, 1.0)), test::z_limit) << m.all.mean;
    // ... and what is left out is more than the test's doubt
    double share = 0.0;
    for (const TreePoint& p : points) {
        TreePoint open = p;
        open.leaves_corners = false;
        share += sum(all_u(tree_cache(), open, GetParam()))
                 / sum(all_u(tree_cache(), p, GetParam())) / static_cast<double>(points.size());
    }
    EXPECT_GT(share, 1.0 + 2.0 * test::z_limit * m.all.standard_error);
}

TEST_P(TreeDraws, ComeFromACutThatLeavesNothingOut) {
    const VertexCache& cache = tree_cache();
    for (const Vector3& axis : {Vector3{0, 0, 1}, Vector3{1, 0.3, -0.2}, Vector3{-1, 0, 0}}) {
        const auto points = make_points(cache, make_tile(GetParam(), axis));
        TreeScratch scratch;
        cut_tree(cache, points, GetParam(), scratch);
        EXPECT_LT(scratch.cut.places.size() + 16 * scratch.cut.leaves.size(), cache.size());
        for (const TreePoint& p : points) {
            const std::vector<double> u = all_u(cache, p, GetParam());
            EXPECT_LE(left_out(cache, scratch.cut, u), 1e-9 * sum(u));
        }
    }
}

/// METHODS eq. (137): 256 times the importance is a bound, and mostly it is far nearer.
TEST_P(TreeDraws, WeighClustersNeverFarTooLow) {
    const VertexCache& cache = tree_cache();
    double worst = 0.0, deviation = 0.0, total = 0.0;
    for (const Vector3& axis : {Vector3{0, 0, 1}, Vector3{1, 0.3, -0.2}, Vector3{0, 1, 0}}) {
        const auto points = make_points(cache, make_tile(GetParam(), axis));
        TreeScratch s;
        cut_tree(cache, points, GetParam(), s);
        const std::size_t rows = s.cut.rows();
        for (const TreePoint& p : points) {
            const std::vector<double> u = all_u(cache, p, GetParam());
            std::vector<float> own(16 * rows), sums(rows);
            weigh_cut({std::span(s.cut.clusters).first(s.cut.cluster_rows()),
                       cache.blocks,
                       s.cut.leaves,
                       GetParam(),
                       Weighting::balanced,
                       {&p.receiver, 1},
                       own,
                       sums});
            for (std::size_t k = 0; k < s.cut.places.size(); ++k) {
                std::size_t size = VertexTree::leaf;
                for (std::size_t level = 0; level < s.cut.places[k].level; ++level)
                    size *= VertexTree::forks;
                const std::size_t first = size * s.cut.places[k].index;
                const double exact =
                    sum(std::span(u).subspan(first, std::min(size, u.size() - first)));
                const auto weighed = static_cast<double>(own[k]);
                EXPECT_GE(weighed, 0.0);
                if (exact > 1e-12 * sum(u))
                    worst = std::max(worst, exact / weighed);
                deviation += std::abs(exact - weighed);
                total += exact;
            }
        }
    }
    EXPECT_LE(worst, 256.0);
    EXPECT_LT(deviation, 0.08 * total);
}

INSTANTIATE_TEST_SUITE_P(Kinds,
                         TreeDraws,
                         testing::Values(IlluminanceKind::planar,
                                         IlluminanceKind::cylindrical,
                                         IlluminanceKind::semi_cylindrical,
                                         IlluminanceKind::hemispherical,
                                         IlluminanceKind::mean_spherical));

/// Of one draw, as a share of what it stands for.
double variance_of_draws(std::vector<TreePoint> own) {
    std::vector<TreeDraw> drawn(own.size());
    TreeScratch scratch;
    double variance = 0.0;
    constexpr std::size_t rounds = 200;
    const RandomStream stream(4, StreamPurpose::subset, 0);
    for (std::size_t k = 0; k < rounds; ++k) {
        for (std::size_t p = 0; p < own.size(); ++p)
            own[p].offset = stream.uniform(p, static_cast<std::uint32_t>(k));
        draw_by_tree(
            tree_cache(), own, IlluminanceKind::planar, Weighting::balanced, scratch, drawn);
        for (std::size_t p = 0; p < own.size(); ++p) {
            const double full = sum(all_u(tree_cache(), own[p], IlluminanceKind::planar));
            variance += std::pow(drawn[p].share / full - 1.0, 2)
                        / static_cast<double>(rounds * own.size());
        }
    }
    return variance;
}

TEST(TreeDraws, VaryByLessThanTheModelOfEffortsSays) {
    const auto tile = make_tile(IlluminanceKind::planar);
    constexpr double most = 1.5e-3; // METHODS "Vertex tree"
    EXPECT_LT(variance_of_draws(make_points(tree_cache(), tile)), most);
    EXPECT_LT(variance_of_draws(make_points(tree_cache(), tile, false, 0.0)), most);
}

/// A tile of all kinds in runs, each point with a number of draws of its own.
std::vector<Receiver> make_mixed_tile() {
    constexpr std::array kinds{IlluminanceKind::planar,
                               IlluminanceKind::cylindrical,
                               IlluminanceKind::semi_cylindrical,
                               IlluminanceKind::hemispherical,
                               IlluminanceKind::mean_spherical};
    std::vector<Receiver> tile = make_tile(IlluminanceKind::planar);
    for (std::size_t i = 0; i < tile.size(); ++i)
        tile[i].kind = kinds[i / 4 % kinds.size()];
    return tile;
}

/// With rays: light at a tile, mean over offsets.
Estimate seen_light(const VertexCache& cache, std::span<const Receiver> tile, Weighting by) {
    LocalScratch scratch;
    return test::over_seeds([&](std::size_t seed) {
        const RandomStream stream(seed, StreamPurpose::subset, 0);
        double e = 0.0;
        for (std::uint32_t k = 0; k < 16; ++k) {
            std::vector<LocalPoint> points;
            for (std::size_t p = 0; p < tile.size(); ++p)
                points.push_back({&tile[p],
                                  clear_point(room(), tile[p]),
                                  stream.uniform(p, k),
                                  1 + p % 5,
                                  4.0});
            std::vector<Rgb> result(points.size());
            std::vector<double> by_draws(points.size(), 0.0);
            for (const LocalDraw& d :
                 gather_local_estimates(room(), cache, points, by, scratch, result)) {
                by_draws[d.point] += luminance_sum(d.light);
                EXPECT_LT(d.vertex, cache.size());
            }
            for (std::size_t p = 0; p < points.size(); ++p) {
                e += luminance_sum(result[p]);
                EXPECT_NEAR(by_draws[p], luminance_sum(result[p]), 1e-9 * by_draws[p]);
            }
        }
        return e;
    });
}

TEST(TreeDraws, GiveTheLightThatIsSeen) {
    const VertexCache all = make_cache(Weighing::all, 2048);
    const VertexCache tree = make_cache(Weighing::tree, 2048);
    for (const auto& tile : {make_tile(IlluminanceKind::planar), make_mixed_tile()})
        for (const Weighting by : {Weighting::balanced, Weighting::alone}) {
            const Estimate a = seen_light(all, tile, by);
            const Estimate b = seen_light(tree, tile, by);
            const Estimate difference{
                b.mean - a.mean, std::hypot(a.standard_error, b.standard_error), test::seeds};
            EXPECT_LT(std::abs(test::z_score(difference, 0.0)), test::z_limit);
            EXPECT_LT(difference.standard_error, 0.01 * a.mean);
        }
}

TEST(TreeDraws, ServeSmallCachesAndThoseWithBranches) {
    std::vector<VertexCache> caches;
    for (const std::size_t paths : {1U, 2U, 5U, 8U, 40U, 110U})
        caches.push_back(make_cache(Weighing::tree, paths));
    caches.push_back(make_cache(Weighing::tree, 1024, test::random_importance(room(), 3)));
    ASSERT_LT(caches.front().size(), VertexTree::leaf);
    ASSERT_FALSE(caches.back().picks.empty());
    for (const VertexCache& cache : caches) {
        const auto points = make_points(cache, make_tile(IlluminanceKind::mean_spherical));
        const Means m = mean_of_draws(cache, points, IlluminanceKind::mean_spherical, 4);
        EXPECT_LT(std::abs(m.all.mean - 1.0), test::z_limit * m.all.standard_error + 1e-6)
            << cache.size() << " vertices";
    }
}

TEST(VertexTree, HoldsAllVerticesOnEveryLevel) {
    const VertexCache& cache = tree_cache();
    std::vector<int> seen(cache.size(), 0);
    for (std::size_t i = 0; i < cache.size(); ++i)
        ++seen[cache.vertex_at[i]];
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
    double strength = 0.0;
    for (const VertexBlock& b : cache.blocks)
        for (const float s : b.strength)
            strength += static_cast<double>(s);
    for (const auto& level : cache.tree.levels) {
        double own = 0.0;
        for (const ClusterRow& row : level)
            for (const float s : row.strength)
                own += static_cast<double>(s);
        EXPECT_NEAR(own, strength, 1e-5 * strength);
    }
    EXPECT_GE(cache.tree.levels.size(), 3U);
}

TEST(VertexTree, IsNotThereWithoutVertices) {
    EXPECT_TRUE(build_vertex_tree({}, 0).empty());
    test::Builder b;
    const MaterialId black = b.add_diffuse(0.0);
    b.add_room({0, 0, 0}, {6, 5, 3}, black, black, black);
    b.add_panel({1.0, 1.0, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
    const Scene scene = b.build();
    const VertexCache cache = build_vertex_cache(scene,
                                                 Emission(scene),
                                                 PathRandomness(3, 0),
                                                 0,
                                                 64,
                                                 {64.0, 64.0},
                                                 {},
                                                 {},
                                                 Weighing::tree);
    EXPECT_TRUE(cache.empty() && cache.tree.empty());
    const Receiver point{{1, 1, 1}, UnitVector3(Vector3{0, 0, 1}), IlluminanceKind::planar};
    const LocalPoint local{&point, point.point};
    LocalScratch scratch;
    Rgb light;
    EXPECT_TRUE(gather_local_estimates(
                    scene, cache, {&local, 1}, Weighting::balanced, scratch, {&light, 1})
                    .empty());
}

} // namespace
} // namespace isolux
