// METHODS (139): a vertex chosen by what it would add stands for all of them.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/bench_rooms.h"
#include "isolux/transport/preference.h"
#include "isolux/transport/vertex_choice.h"

#include "support/random_importance.h"
#include "support/small_engine.h"

namespace isolux {
namespace {

using test::SmallEngine;

struct Office {
    BenchRoom room = make_bench_room("furnished-office");
    Scene scene = build_scene(std::move(room.scene));
    SmallEngine engine{scene};
    LitPlace place{{2.1, 2.3, 1e-4}, UnitVector3(Vector3{0, 0, 1}), 0.02, 0.0};

    VertexCache cache(const PathImportance& importance = {},
                      std::uint32_t replicate = 0) const {
        return build_vertex_cache(scene,
                                  engine.emission,
                                  PathRandomness(5, replicate),
                                  0,
                                  512,
                                  {512.0, 2000.0, 1.0, 1.0, 0.3},
                                  importance);
    }
};

/// Unshadowed light of a vertex at a place, weighted as gathered light is.
double light_of(const PathVertex& v, const LitPlace& y) {
    const Vector3 d = y.at - v.position;
    const double d2 = length_squared(d);
    const double cosines = dot(v.normal, d) * -dot(y.normal, d);
    if (dot(v.normal, d) <= 0.0 || dot(y.normal, d) >= 0.0 || d2 < y.nearest * y.nearest)
        return 0.0;
    const double g = cosines / (d2 * d2);
    const double departure = g / std::numbers::pi;
    return luminance_sum(v.radiant) * g
           / (1.0 + y.rival * v.continuation * departure / preference(y.area * departure));
}

/// Some vertices count, as if the others were hidden.
double seen_light(const VertexCache& c, std::size_t vertex, const LitPlace& y) {
    return vertex % 3 == 0 ? 0.0 : light_of(c.vertices[vertex], y);
}

struct Mean {
    double value = 0.0;
    double standard_error = 0.0;
};

/// Over many choices. @param odds_count  false: as if the choice had been an even one
Mean mean_over_choices(const VertexCache& c,
                       const LitPlace& y,
                       std::size_t n = 200000,
                       bool odds_count = true) {
    const RandomStream random(11, StreamPurpose::test, 0);
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto chosen = choose_vertex(c, y, random.uniform(i, 0), random.uniform(i, 1));
        if (!chosen)
            continue;
        const double share = odds_count ? chosen->share : c.share_of(chosen->vertex);
        const double x = share * seen_light(c, chosen->vertex, y);
        sum += x;
        squares += x * x;
    }
    const auto all = static_cast<double>(n);
    const double mean = sum / all;
    return {mean, std::sqrt((squares / all - mean * mean) / all)};
}

double exact(const VertexCache& c, const LitPlace& y) {
    double sum = 0.0;
    for (std::size_t v = 0; v < c.size(); ++v)
        sum += seen_light(c, v, y);
    return sum / static_cast<double>(c.paths);
}

/// Chance of a false alarm: 1e-6.
constexpr double limit = 4.9;

TEST(VertexChoice, StandsForAllVerticesWhoeverIsHidden) {
    const Office o;
    const VertexCache c = o.cache();
    const Mean m = mean_over_choices(c, o.place);
    ASSERT_GT(m.value, 0.0);
    EXPECT_LT(std::abs(m.value - exact(c, o.place)), limit * m.standard_error);
}

TEST(VertexChoice, StandsForAllVerticesWhereImportanceDrewMore) {
    const Office o;
    const PathImportance importance = test::random_importance(o.scene, 3);
    // Picks are systematic: their mean is that of all vertices over many caches.
    std::vector<double> differences;
    double all = 0.0;
    for (std::uint32_t replicate = 0; replicate < 64; ++replicate) {
        const VertexCache c = o.cache(importance, replicate);
        ASSERT_FALSE(c.picks.empty());
        differences.push_back(mean_over_choices(c, o.place, 4000).value - exact(c, o.place));
        all += exact(c, o.place) / 64.0;
    }
    const Estimate e = estimate_from_replicates(differences);
    EXPECT_LT(std::abs(e.mean), 5.9 * e.standard_error); // t of 63, false alarms: 2e-7
    EXPECT_LT(e.standard_error, 0.02 * all);
}

// A planted error: the odds of the choice left out.
TEST(VertexChoice, NeedsItsOdds) {
    const Office o;
    const VertexCache c = o.cache();
    const Mean m = mean_over_choices(c, o.place, 200000, false);
    EXPECT_GT(std::abs(m.value - exact(c, o.place)), 10.0 * m.standard_error);
}

TEST(VertexChoice, VariesLessThanAnEvenDraw) {
    const Office o;
    const VertexCache c = o.cache();
    constexpr std::size_t n = 200000;
    double squares = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t v = c.offer(i % c.offered());
        squares += std::pow(c.share_of(v) * seen_light(c, v, o.place), 2);
    }
    const double mean = exact(c, o.place);
    const double even = std::sqrt((squares / n - mean * mean) / n);
    EXPECT_LT(mean_over_choices(c, o.place).standard_error, 0.5 * even);
}

// From one hand every vertex brings the same, weights of METHODS eq. (10) and (144) included:
// the chance of each is exactly in proportion.
TEST(VertexChoice, IsInProportionToTheWeightedLight) {
    Office o;
    const VertexCache c = o.cache();
    for (const double area : {0.0, 30.0, 300.0}) {
        o.place.area = area;
        for (const double hand : {0.1, 0.5, 0.9}) {
            double lowest = std::numeric_limits<double>::max();
            double highest = 0.0;
            std::set<std::size_t> chosen;
            for (int k = 0; k < 200; ++k) {
                const auto v = choose_vertex(c, o.place, hand, (k + 0.5) / 200.0);
                ASSERT_TRUE(v);
                const double light = v->share * light_of(c.vertices[v->vertex], o.place);
                lowest = std::min(lowest, light);
                highest = std::max(highest, light);
                chosen.insert(v->vertex);
            }
            EXPECT_GT(chosen.size(), 3U);
            EXPECT_LT(highest, 1.0001 * lowest) << area << " " << hand;
        }
    }
}

TEST(VertexChoice, StandsForAFewThatDoNotFillAHand) {
    const Office o;
    for (const std::size_t paths : {3U, 10U}) {
        const VertexCache c = build_vertex_cache(
            o.scene, o.engine.emission, PathRandomness(6, 1), 0, paths, {1.0, 4.0});
        ASSERT_NE(c.size() % VertexHand::size, 0U);
        const Mean m = mean_over_choices(c, o.place);
        EXPECT_LE(std::abs(m.value - exact(c, o.place)), limit * m.standard_error) << paths;
    }
}

TEST(VertexChoice, LeavesNearVerticesOut) {
    Office o;
    const VertexCache c = o.cache();
    o.place.at = {2.1, 0.05, 0.05}; // in the corner of floor and wall
    o.place.nearest = 1.5;
    std::size_t near = 0;
    for (const PathVertex& v : c.vertices)
        near += length_squared(v.position - o.place.at) < 1.5 * 1.5 ? 1U : 0U;
    ASSERT_GT(near, 20U);
    const RandomStream random(12, StreamPurpose::test, 0);
    for (std::size_t i = 0; i < 20000; ++i) {
        const auto v = choose_vertex(c, o.place, random.uniform(i, 0), random.uniform(i, 1));
        if (!v)
            continue;
        ASSERT_GE(length_squared(c.vertices[v->vertex].position - o.place.at),
                  0.999 * 1.5 * 1.5);
    }
    const Mean m = mean_over_choices(c, o.place);
    EXPECT_LT(std::abs(m.value - exact(c, o.place)), limit * m.standard_error);
}

TEST(VertexChoice, FindsNothingWhereNothingLights) {
    Office o;
    const VertexCache c = o.cache();
    o.place.at.z = -0.5; // under the floor, facing down
    o.place.normal = UnitVector3(Vector3{0, 0, -1});
    EXPECT_FALSE(choose_vertex(c, o.place, 0.3, 0.6));
    EXPECT_FALSE(choose_vertex(VertexCache{}, o.place, 0.3, 0.6));
    fetch_hand(VertexCache{}, 0.3); // nor a crash
}

} // namespace
} // namespace isolux
