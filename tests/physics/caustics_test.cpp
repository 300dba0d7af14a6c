#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/walk_front.h"

#include "support/replicates.h"
#include "support/small_engine.h"
#include "support/test_scene.h"

/// METHODS eq. (145): light that mirrors throw on surfaces next to a point is left to the
/// point's own rays, and (146): how they find the luminaires in the mirrors.
namespace isolux {
namespace {

using test::SmallEngine;
using test::z_limit;
using test::z_score;

constexpr std::size_t replicates = 64;

/// Two walls that face each other mirror, a third one a little; a screen stands in the room.
/// Some of the light is that of a point source: over more mirrors than images are made for, no
/// ray finds it.
Scene mirrors_and_screen() {
    test::Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.15), 0.7}, Sides::both});
    const MaterialId gloss =
        b.add_material({"gloss", Opaque{Rgb::grey(0.4), 0.2}, Sides::both});
    b.add_quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, grey);
    b.add_quad({0, 0, 2.5}, {0, 3, 0}, {4, 0, 0}, grey);
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, mirror);
    b.add_quad({4, 0, 0}, {0, 0, 2.5}, {0, 3, 0}, mirror);
    b.add_quad({0, 0, 0}, {0, 0, 2.5}, {4, 0, 0}, gloss);
    b.add_quad({0, 3, 0}, {4, 0, 0}, {0, 0, 2.5}, grey);
    b.add_quad({1.4, 0.8, 0.3}, {0, 1.4, 0}, {0, 0, 1.2}, grey);
    b.add_quad({1.1, 0.8, 0.6}, {0.3, 0, 0}, {0, 1.4, 0}, b.add_diffuse(0.8)); // a shelf
    b.add_panel({2.4, 1.0, 2.4}, {0, 0.5, 0}, {0.5, 0, 0}, 3000.0);
    b.add_point({0.9, 2.0, 2.2}, b.add_isotropic_type(1500.0));
    return b.build();
}

/// The light of a point source comes down a narrow shaft of mirrors, most of it over more of
/// them than there are images for, into a bright corner that has a mirror across.
Scene point_in_a_shaft() {
    test::Builder b;
    const MaterialId bright = b.add_diffuse(0.8);
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.0), 0.97}, Sides::both});
    b.add_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, bright);
    b.add_quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, bright);
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, bright);
    b.add_quad({0.7, 0, 0}, {0, 0, 1}, {0, 1, 0}, mirror);
    const Point3 at{0.2, 0.2, 0.8};
    constexpr double wide = 0.2;
    constexpr double high = 1.5;
    b.add_quad(at, {wide, 0, 0}, {0, 0, high}, mirror);
    b.add_quad(at, {0, wide, 0}, {0, 0, high}, mirror);
    b.add_quad(at + Vector3{wide, 0, 0}, {0, wide, 0}, {0, 0, high}, mirror);
    b.add_quad(at + Vector3{0, wide, 0}, {wide, 0, 0}, {0, 0, high}, mirror);
    b.add_point({0.28, 0.31, 2.2}, b.add_isotropic_type(1500.0));
    return b.build();
}

/// In front of the screen and behind it, by the wall and over the floor.
std::vector<Receiver> points_nearby() {
    return {{{1.36, 1.2, 0.8}, UnitVector3({-1, 0, 0.5})},
            {{1.36, 1.8, 1.1}, UnitVector3({0, 0, 1})},
            {{1.44, 1.4, 0.7}, UnitVector3({1, 0, 0.2})},
            {{1.45, 1.7, 0.9}, UnitVector3({0, 0, 1}), IlluminanceKind::cylindrical},
            {{2.5, 2.96, 1.0}, UnitVector3({0, 1, 0})},
            {{3.0, 1.5, 0.04}, UnitVector3({0, 0, -1})},
            {{2.2, 1.5, 0.8}, UnitVector3({0, 0, 1})}};
}

/// Who does as (145) says.
struct Who {
    bool chains = true;
    bool rays = true;
    bool corners = false; ///< both do as (122) says
};

class Caustics : public testing::Test {
protected:
    explicit Caustics(Scene (*make_scene)() = mirrors_and_screen) : scene(make_scene()) {
        engine.paths = 1024;
        engine.directions = 16;
        engine.batches = 32;
    }

    [[nodiscard]] test::Sample
    run(Who who, std::uint64_t seed, Weighing weighing = Weighing::all) const {
        EffectiveCounts counts = engine.counts();
        counts.images = &engine.images;
        counts.caustic = who.corners ? 0.15 : 0.5;
        counts.corner = who.corners ? 0.5 : 0.0;
        return engine.sample(
            points, replicates, [&](std::uint32_t r, std::vector<double>& row) {
                const VertexCache cache = build_vertex_cache(engine.scene,
                                                             engine.emission,
                                                             PathRandomness(seed, r),
                                                             0,
                                                             engine.paths,
                                                             counts,
                                                             {},
                                                             {},
                                                             weighing);
                std::vector<Rgb> sums(points.size());
                gather_locally(cache, who, seed, r, sums);
                gather_by_rays(cache, counts, who, seed, r, sums);
                for (std::size_t i = 0; i < points.size(); ++i)
                    row[i] += luminance_sum(sums[i]);
            });
    }

    void gather_locally(const VertexCache& cache,
                        const Who& who,
                        std::uint64_t seed,
                        std::uint32_t replicate,
                        std::vector<Rgb>& sums) const {
        const RandomStream subset(seed, StreamPurpose::subset, replicate);
        std::vector<LocalPoint> locals;
        for (std::size_t i = 0; i < points.size(); ++i)
            locals.push_back({&points[i],
                              clear_point(engine.scene, points[i]),
                              subset.uniform(i, 0),
                              engine.draws,
                              static_cast<double>(engine.directions),
                              who.corners,
                              who.chains});
        LocalScratch scratch;
        gather_local_estimates(engine.scene, cache, locals, Weighting::balanced, scratch, sums);
    }

    void gather_by_rays(const VertexCache& cache,
                        const EffectiveCounts& counts,
                        const Who& who,
                        std::uint64_t seed,
                        std::uint32_t replicate,
                        std::vector<Rgb>& sums) const {
        std::vector<RayPoint> senders;
        for (std::size_t i = 0; i < points.size(); ++i)
            senders.push_back({&points[i],
                               clear_point(engine.scene, points[i]),
                               {seed, StreamPurpose::gather, replicate, i},
                               engine.directions,
                               0,
                               who.corners,
                               true,
                               who.rays});
        WalkFront front;
        front.start(engine.scene, engine.emission, engine.images, senders);
        front.share_with(cache, counts);
        front.add_gathering();
        front.run({sums, nullptr, {}, {}});
    }

    Scene scene;
    SmallEngine engine{scene};
    std::vector<Receiver> points = points_nearby();
};

TEST_F(Caustics, LeftToRaysKeepTheMean) {
    const test::Sample left = run({}, 1);
    const test::Sample kept = run({false, false}, 2);
    for (std::uint32_t k = 0; k < 8; ++k) {
        const Estimate a = left.projection(k);
        const Estimate b = kept.projection(k);
        EXPECT_LT(std::abs(z_score(a, b)), z_limit)
            << k << ": " << a.mean << " +- " << a.standard_error << ", " << b.mean << " +- "
            << b.standard_error;
    }
    // Power: 3 % of the mean would be seen.
    const double error = std::hypot(left.mean().standard_error, kept.mean().standard_error);
    EXPECT_LT(z_limit * error, 0.03 * kept.mean().mean);
}

/// One ray then looks for both.
TEST_F(Caustics, InCornersKeepTheMean) {
    const test::Sample both = run({true, true, true}, 9);
    const test::Sample one = run({}, 1);
    for (std::uint32_t k = 0; k < 8; ++k)
        EXPECT_LT(std::abs(z_score(both.projection(k), one.projection(k))), z_limit) << k;
    const double error = std::hypot(both.mean().standard_error, one.mean().standard_error);
    EXPECT_LT(z_limit * error, 0.03 * one.mean().mean);
}

class HiddenCaustics : public Caustics {
protected:
    HiddenCaustics() : Caustics(point_in_a_shaft) {
        engine.paths = 64; // few, so that gather rays would have a share
        engine.directions = 32;
        engine.batches = 192;
        points = {{{0.04, 0.3, 0.03}, UnitVector3({0, 0, 1})},
                  {{0.03, 0.2, 0.1}, UnitVector3({1, 0, 0})},
                  {{0.2, 0.04, 0.05}, UnitVector3({0, -1, 0})}};
    }
};

TEST_F(HiddenCaustics, OfAPointSourceThatRaysDoNotFindStayWithTheChains) {
    const Estimate kept = run({false, false}, 2).mean();
    for (const bool corners : {false, true}) {
        const Estimate left = run({true, true, corners}, 1).mean();
        EXPECT_LT(std::abs(z_score(left, kept)), z_limit)
            << corners << ' ' << left.mean << " +- " << left.standard_error << ", " << kept.mean
            << " +- " << kept.standard_error;
        EXPECT_LT(std::hypot(left.standard_error, kept.standard_error), 0.012 * kept.mean);
    }
}

TEST_F(Caustics, LeftToRaysKeepTheMeanInATree) {
    const Estimate a = run({}, 3, Weighing::tree).mean();
    const Estimate b = run({}, 1).mean();
    EXPECT_LT(std::abs(z_score(a, b)), z_limit) << a.mean << " and " << b.mean;
}

TEST_F(Caustics, LeftByChainsAloneAreMissed) {
    const Estimate both = run({}, 1).mean();
    const Estimate lost = run({true, false}, 4).mean();
    EXPECT_LT(z_score(lost, both), -z_limit) << lost.mean << " and " << both.mean;
    const Estimate in_a_tree = run({true, false}, 5, Weighing::tree).mean();
    EXPECT_LT(std::abs(z_score(in_a_tree, lost)), z_limit)
        << in_a_tree.mean << " and " << lost.mean;
}

TEST_F(Caustics, TakenByRaysAsWellCountTwice) {
    const Estimate both = run({}, 1).mean();
    const Estimate twice = run({false, true}, 6).mean();
    EXPECT_GT(z_score(twice, both), z_limit) << twice.mean << " and " << both.mean;
}

/// What it is for.
TEST_F(Caustics, LeftToRaysVaryLess) {
    const test::Sample left = run({}, 7);
    const test::Sample kept = run({false, false}, 8);
    double ratio = 0.0;
    constexpr std::size_t by_the_screen = 4;
    for (std::size_t i = 0; i < by_the_screen; ++i) {
        const Estimate a = left.point(i);
        const Estimate b = kept.point(i);
        RecordProperty("ratio_" + std::to_string(i),
                       std::to_string(std::pow(b.standard_error / a.standard_error, 2)));
        ratio += std::log(b.standard_error / a.standard_error) / by_the_screen;
    }
    EXPECT_GT(std::exp(2.0 * ratio), 1.5);
}

} // namespace
} // namespace isolux
