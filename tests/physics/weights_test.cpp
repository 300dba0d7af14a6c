// METHODS 7.2 rows 16 to 18: the weights of LE-MIS. An error planted in one of the two weights
// only must show; the counts of eq. (11) must be the best; subset and roulette change nothing.

#include <functional>

#include <gtest/gtest.h>

#include "isolux/transport/next_event.h"
#include "isolux/transport/preference.h"
#include "isolux/transport/response.h"

#include "support/furnace.h"
#include "support/small_engine.h"

namespace isolux {
namespace {

using test::SmallEngine;
using test::z_limit;
using test::z_score;

constexpr double rho = 0.6;
constexpr double pi = std::numbers::pi;
constexpr double exact = test::furnace_exitance * rho / (1.0 - rho); // reflected light only

/// The gather half once more, as plainly as it can be written: closed rooms of diffuse surfaces
/// only. `drops_cosine` plants an error: eq. (9) without its cosine.
double plain_gather(const SmallEngine& e,
                    const VertexCache& cache,
                    const Receiver& receiver,
                    std::size_t index,
                    std::uint32_t replicate,
                    bool drops_cosine) {
    const EffectiveCounts c = e.counts();
    const auto rays = static_cast<double>(e.directions);
    const PointRandomness random(5, StreamPurpose::test, replicate, index);
    double sum = 0.0;
    for (std::uint32_t s = 0; s < e.directions; ++s) {
        NumberSequence u(random, s);
        const double u1 = u.next();
        const UnitVector3 w = sample_response(receiver, u1, u.next());
        const double pdf = pdf_response(receiver, w);
        const auto hit = e.scene.caster.find_first_hit(receiver.point, w);
        if (!hit || !(pdf > 0.0))
            continue;
        const double cosine = drops_cosine ? 1.0 : -dot(hit->normal, w);
        const double p2 = pdf * cosine / (hit->distance * hit->distance);
        const Point3 y = e.scene.caster.offset_point(hit->position, hit->normal);
        const double u3 = u.next();
        const double u4 = u.next();
        const NextEvent event =
            estimate_next_event(e.scene, e.emission, y, hit->normal, u3, u4, u.next());
        const double n1_p1 = c.paths * event.path_density;
        const double n2_p2 = rays * c.gather_first * p2;
        double luminance =
            luminance_sum(event.illuminance) * rho / pi * n2_p2 / (n1_p1 + n2_p2);
        const auto pick =
            static_cast<std::size_t>(u.next() * static_cast<double>(cache.size()));
        const PathVertex& v = cache.vertices[pick];
        const Vector3 d = y - v.position;
        const double d2 = length_squared(d);
        const double cos_v = dot(v.normal, d) / std::sqrt(d2);
        const double cos_y = -dot(hit->normal, d) / std::sqrt(d2);
        if (cos_v > 0.0 && cos_y > 0.0 && e.scene.caster.transmittance(v.position, y) > 0.0) {
            const double p1 = rho * cos_v / pi * cos_y / d2;
            const double a = c.vertices * p1;
            const double b = rays * c.gather_later * p2 * preference(c.area * p1 / rho);
            luminance += static_cast<double>(cache.size()) / static_cast<double>(cache.paths)
                         * luminance_sum(v.radiant) * cos_v * cos_y / d2 * rho / pi * b
                         / (a + b);
        }
        sum += evaluate_response(receiver, w) / pdf * luminance;
    }
    return sum / rays;
}

/// As many light paths as gather rays, in effect, so that either weight counts.
class Weights : public testing::Test {
protected:
    Weights() {
        engine.paths = 128;
        engine.directions = 16;
        engine.batches = 128;
    }

    Scene scene = test::furnace(rho).build();
    SmallEngine engine{scene};
    std::vector<Receiver> points = test::furnace_points(12);
};

/// Independent values behind every z.
constexpr std::size_t replicates = 64;

TEST_F(Weights, AsTheyAreGiveTheFurnace) {
    const Estimate e = engine.run(points, replicates, 1).mean();
    EXPECT_LT(std::abs(z_score(e, exact)), z_limit) << e.mean << " +- " << e.standard_error;
    // Power: an error of half a percent would be 12 standard errors.
    EXPECT_LT(12.0 * e.standard_error, 0.005 * exact);
}

TEST_F(Weights, CountScaledInOneWeightIsSeen) {
    EffectiveCounts planted = engine.counts();
    planted.vertices *= 4.0;
    planted.paths *= 4.0;
    const Estimate e = engine.run(points, replicates, 2, planted, engine.counts()).mean();
    EXPECT_GT(std::abs(z_score(e, exact)), z_limit) << e.mean << " +- " << e.standard_error;
}

TEST_F(Weights, SurvivalLeftOutOfOneDensityIsSeen) {
    EffectiveCounts planted = engine.counts();
    planted.vertices /= rho; // the survival of every chain in this room
    const Estimate e = engine.run(points, replicates, 3, planted, engine.counts()).mean();
    EXPECT_GT(std::abs(z_score(e, exact)), z_limit) << e.mean << " +- " << e.standard_error;
}

TEST_F(Weights, PreferenceLeftOutOfOneWeightIsSeen) {
    EffectiveCounts planted = engine.counts();
    planted.area = 0.0; // as if the gather rays drew their vertices evenly
    const Estimate e = engine.run(points, replicates, 5, planted, engine.counts()).mean();
    EXPECT_GT(std::abs(z_score(e, exact)), z_limit) << e.mean << " +- " << e.standard_error;
}

TEST_F(Weights, CosineDroppedFromOneDensityIsSeen) {
    const auto with = [&](bool drops_cosine) {
        return engine
            .sample(points,
                    replicates,
                    [&](std::uint32_t r, std::vector<double>& row) {
                        const VertexCache cache = engine.cache(4, r, engine.counts());
                        for (std::size_t i = 0; i < points.size(); ++i)
                            row[i] +=
                                engine.local(cache, points[i], i, 4, r)
                                + plain_gather(engine, cache, points[i], i, r, drops_cosine);
                    })
            .mean();
    };
    const Estimate right = with(false);
    EXPECT_LT(std::abs(z_score(right, exact)), z_limit)
        << right.mean << " +- " << right.standard_error;
    const Estimate wrong = with(true);
    EXPECT_GT(std::abs(z_score(wrong, exact)), z_limit)
        << wrong.mean << " +- " << wrong.standard_error;
}

TEST_F(Weights, TakeAConstantNumberOfVerticesNeverThePathsOwn) {
    // One path, one gather ray: the count that a batch turned out to have is too high where its
    // chain went on, and both weights together then add up to more than one.
    engine.paths = 1;
    engine.directions = 1;
    engine.batches = 2048;
    points.resize(4);
    const auto with = [&](bool takes_own_count) {
        return engine
            .sample(points,
                    replicates,
                    [&](std::uint32_t number, std::vector<double>& row) {
                        EffectiveCounts counts = engine.counts();
                        if (takes_own_count)
                            counts.vertices = std::max(
                                1e-9,
                                static_cast<double>(engine.cache(6, number, counts).size()));
                        const VertexCache cache = engine.cache(6, number, counts);
                        for (std::size_t i = 0; i < points.size(); ++i)
                            row[i] += engine.local(cache, points[i], i, 6, number)
                                      + engine.gathered(cache, counts, points[i], i, 6, number);
                    })
            .mean();
    };
    const Estimate constant = with(false);
    EXPECT_LT(std::abs(z_score(constant, exact)), z_limit)
        << constant.mean << " +- " << constant.standard_error;
    const Estimate own = with(true);
    EXPECT_GT(z_score(own, exact), z_limit) << own.mean << " +- " << own.standard_error;
    RecordProperty("bias_of_own_count", std::to_string(own.mean / exact - 1.0));
}

// ---- subset and roulette in a room with things in the way
// ------------------------------------

Scene furnished(double reflectance) {
    test::Builder b;
    const auto wall = b.add_diffuse(reflectance);
    b.add_room({0, 0, 0}, {5, 4, 3}, wall, wall, wall);
    b.add_quad({2.5, 0.0, 0}, {0, 2.5, 0}, {0, 0, 2}, wall); // a screen
    b.add_quad({1, 1, 0.74}, {1.2, 0, 0}, {0, 0.8, 0}, wall);
    b.add_panel({0.8, 1.5, 2.95}, {0, 0.6, 0}, {0.6, 0, 0}, 4000);
    b.add_point({4.2, 3.2, 2.2}, b.add_isotropic_type(800));
    return b.build();
}

std::vector<Receiver> open_points() {
    std::vector<Receiver> points;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j)
            points.push_back({{0.7 + 1.2 * i, 0.6 + 1.3 * j, 0.85}, UnitVector3({0, 0, 1})});
    return points;
}

/// Upright, facing the room, 5 to 30 cm from walls.
std::vector<Receiver> points_near_walls() {
    std::vector<Receiver> points;
    for (int i = 0; i < 6; ++i) {
        points.push_back({{0.4 + 0.8 * i, 0.05 + 0.05 * i, 1.2}, UnitVector3({1, 0, 0})});
        points.push_back({{0.05 + 0.05 * i, 0.5 + 0.6 * i, 0.9}, UnitVector3({0, 0, 1})});
    }
    return points;
}

/// METHODS eq. (5) times w1 of eq. (10), for a plane, in double precision.
double
weighed(const PathVertex& v, const Point3& at, const UnitVector3& axis, const SmallEngine& e) {
    const EffectiveCounts c = e.counts();
    const Vector3 d = v.position - at;
    const double d2 = length_squared(d);
    const double cos_x = dot(axis, d) / std::sqrt(d2);
    const double cos_v = -dot(v.normal, d) / std::sqrt(d2);
    if (cos_x <= 0.0 || cos_v <= 0.0)
        return 0.0;
    const double n1 = v.is_first ? c.paths : c.vertices;
    // All surfaces are alike: every vertex has the continuation of the one before.
    const double n2 =
        static_cast<double>(e.directions)
        * (v.is_first ? c.gather_first
                      : c.gather_later * preference(c.area * v.density / v.continuation));
    const double chain = n1 * v.density;
    const double share = chain / (chain + n2 * cos_x / pi * cos_v / d2);
    return luminance_sum(v.radiant) * cos_x * cos_v / d2 * share;
}

TEST(Subset, OfOneEightOrSixteenVerticesHasTheMeanOfAll) {
    const Scene scene = furnished(0.5);
    SmallEngine engine(scene);
    const auto points = open_points();
    const auto by_draws = [&](std::size_t draws, std::uint64_t seed) {
        engine.draws = draws;
        return engine.sample(
            points, replicates, [&](std::uint32_t r, std::vector<double>& row) {
                const VertexCache cache = engine.cache(seed, r, engine.counts());
                for (std::size_t i = 0; i < points.size(); ++i)
                    row[i] += engine.local(cache, points[i], i, seed, r);
            });
    };
    // Every vertex looked at.
    const test::Sample all =
        engine.sample(points, replicates, [&](std::uint32_t r, std::vector<double>& row) {
            const VertexCache cache = engine.cache(10, r, engine.counts());
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Point3 at = clear_point(scene, points[i]);
                for (const PathVertex& v : cache.vertices)
                    row[i] += weighed(v, at, points[i].axis, engine)
                              * scene.caster.transmittance(at, v.position)
                              / static_cast<double>(cache.paths);
            }
        });
    for (const std::size_t draws : {1U, 8U, 16U}) {
        const test::Sample some = by_draws(draws, 10 + draws);
        for (std::uint32_t k = 0; k < 8; ++k)
            EXPECT_LT(std::abs(z_score(some.projection(k), all.projection(k))), z_limit)
                << draws << " draws, combination " << k;
        EXPECT_LT(some.mean().standard_error, 0.02 * some.mean().mean);
    }
}

TEST(RouletteBounds, LeaveTheMeanAlone) {
    const Scene scene =
        furnished(0.2); // dark enough that a floor of 0.5 lets paths live longer
    SmallEngine engine(scene);
    engine.paths = 1024;
    const auto points = open_points();
    std::vector<test::Sample> samples;
    for (const double least : {0.05, 0.5, 0.0}) {
        engine.roulette.least = least;
        samples.push_back(engine.run(points, replicates, 20 + samples.size()));
    }
    for (std::uint32_t k = 0; k < 8; ++k) {
        EXPECT_LT(std::abs(z_score(samples[1].projection(k), samples[0].projection(k))),
                  z_limit)
            << k;
        EXPECT_LT(std::abs(z_score(samples[2].projection(k), samples[0].projection(k))),
                  z_limit)
            << k;
    }
    for (const test::Sample& s : samples)
        EXPECT_LT(s.mean().standard_error, 0.005 * s.mean().mean);
}

// ---- row 17b
// ----------------------------------------------------------------------------------

/// Mean over the points of the variance between replicates, relative to the mean.
double relative_variance(const test::Sample& s) {
    double sum = 0.0;
    for (std::size_t p = 0; p < s.points; ++p) {
        const Estimate e = s.point(p);
        const double relative = e.standard_error / e.mean;
        sum += relative * relative * static_cast<double>(e.samples);
    }
    return sum / static_cast<double>(s.points);
}

TEST(Preference, MakesPointsNearWallsVaryLess) {
    const Scene scene = furnished(0.6);
    SmallEngine engine(scene);
    constexpr std::size_t many = 512;
    engine.directions = 16;
    EffectiveCounts even = engine.counts();
    even.area = 0.0;
    // Equal seeds, and the same choice among the same vertices: what differs is the weights.
    const std::vector<Receiver> points = points_near_walls();
    const double with =
        relative_variance(engine.run(points, many, 40, engine.counts(), engine.counts()));
    const double without = relative_variance(engine.run(points, many, 40, even, even));
    EXPECT_LT(with, without / 1.25);
    RecordProperty("ratio", std::to_string(without / with));
}

TEST(EffectiveCountsOfEquationEleven, AreTheBestOnOpenPointsAndNearWalls) {
    const Scene scene = furnished(0.6);
    SmallEngine engine(scene);
    constexpr std::size_t many = 512;
    const std::array sets{open_points(), points_near_walls()};
    const auto variances = [&](double first, double later) {
        std::array<double, 2> v{};
        for (std::size_t s = 0; s < sets.size(); ++s) {
            EffectiveCounts counts = engine.counts();
            counts.paths *= first;
            counts.vertices *= later;
            // Equal seeds: what differs is the counts alone.
            const test::Sample sample = engine.run(sets[s], many, 30 + s, counts, counts);
            v[s] = relative_variance(sample);
        }
        return v;
    };
    const std::array<double, 2> one = variances(1.0, 1.0);
    for (const auto& [first, later] : {std::pair{16.0, 1.0},
                                       std::pair{1.0 / 16.0, 1.0},
                                       std::pair{1.0, 16.0},
                                       std::pair{1.0, 1.0 / 16.0}}) {
        const std::array<double, 2> scaled = variances(first, later);
        const double open = scaled[0] / one[0];
        const double near = scaled[1] / one[1];
        // Scale 1 is within a tenth of the best, and a wrong scale is seen on one of the sets.
        EXPECT_GT(open, 1.0 / 1.1) << first << " " << later;
        EXPECT_GT(near, 1.0 / 1.1) << first << " " << later;
        EXPECT_GT(std::max(open, near), 1.15) << first << " " << later;
        RecordProperty("ratios_" + std::to_string(first) + "_" + std::to_string(later),
                       std::to_string(open) + " " + std::to_string(near));
        std::printf("n1 scaled by %g (k = 2) and %g: variance times %.3f on open points, %.3f "
                    "near walls\n",
                    first,
                    later,
                    open,
                    near);
    }
}

} // namespace
} // namespace isolux
