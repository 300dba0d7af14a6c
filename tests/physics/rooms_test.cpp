// METHODS 7.2 rows 12, 13 and 23: points next to an edge, a room against radiosity, and how
// often the intervals of runs that stopped by themselves hold the truth.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/box_radiosity.h"
#include "support/furnace.h"
#include "support/replicates.h"

namespace isolux {
namespace {

using test::z_limit;
using test::z_score;

constexpr double pi = std::numbers::pi;
const UnitVector3 up = UnitVector3::from_unit({0, 0, 1});

// ---- row 12
// -----------------------------------------------------------------------------------

/// Excess kurtosis of the replicates of one run, Fisher's G2: without bias for normal ones.
double excess_kurtosis(const test::Sample& s, std::size_t point) {
    const double mean = s.point(point).mean;
    double second = 0.0;
    double fourth = 0.0;
    for (const auto& row : s.rows) {
        const double d = row[point] - mean;
        second += d * d;
        fourth += d * d * d * d;
    }
    const auto n = static_cast<double>(s.rows.size());
    const double g2 = n * fourth / (second * second) - 3.0;
    return (n - 1) / ((n - 2) * (n - 3)) * ((n + 1) * g2 + 6.0);
}

TEST(Corner, IsExactFromAMillimetreToHalfAMetreFromABrightWall) {
    constexpr double rho = 0.6;
    const Scene scene = test::furnace(rho).build();
    std::vector<Receiver> points;
    for (const double h : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 0.5})
        points.push_back({{h, 1.1, 0.0}, up});
    const double exact = test::furnace_exitance / (1.0 - rho);
    const auto s = test::sample(scene, points, Estimator::automatic, 16, 51);
    // Kurtosis within runs: their pilots may choose different efforts, and a mixture of narrow
    // and wide normal replicates has a high kurtosis, too.
    constexpr std::uint64_t runs = 48;
    std::vector<double> kurtosis(points.size(), 3.0);
    for (std::uint64_t seed = 151; seed < 151 + runs; ++seed) {
        const auto run = test::sample(scene, points, Estimator::automatic, 16, seed, 1);
        for (std::size_t p = 0; p < points.size(); ++p)
            kurtosis[p] += excess_kurtosis(run, p) / runs;
    }
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Estimate e = s.point(p);
        EXPECT_LT(std::abs(z_score(e, exact)), z_limit)
            << points[p].point.x << " m: " << e.mean << " +- " << e.standard_error;
        EXPECT_LT(kurtosis[p], 6.0) << points[p].point.x << " m";
        EXPECT_LT(e.standard_error, 0.01 * exact);
    }
    // LE-MIS without the rule, for contrast: the measure sees heavy tails.
    const std::vector<Receiver> nearest{points.begin(), points.begin() + 2};
    double pure = 3.0;
    for (std::uint64_t seed = 151; seed < 151 + runs; ++seed)
        pure +=
            excess_kurtosis(
                test::sample(scene, nearest, Estimator::local_estimation_mis, 1, seed, 1), 1)
            / runs;
    EXPECT_GT(pure, 6.0);
}

// ---- row 13
// -----------------------------------------------------------------------------------

TEST(Room, AgreesWithRadiosity) {
    // 4 m x 6 m x 3 m, reflectances 0.2, 0.7, 0.5, one isotropic source off the middle.
    const Point3 size{4, 6, 3};
    const Point3 source{1.8, 2.6, 2.0};
    constexpr double flux = 5000.0;
    test::Builder b;
    b.add_room({0, 0, 0}, size, b.add_diffuse(0.2), b.add_diffuse(0.7), b.add_diffuse(0.5));
    b.add_point(source, b.add_isotropic_type(flux));
    const Scene scene = b.build();
    const std::vector<Receiver> points{{{2, 3, 0.75}, up},
                                       {{0.6, 0.9, 0.75}, up},
                                       {{3.3, 5.2, 0.75}, up},
                                       {{2, 5.99, 1.5}, UnitVector3({0, -1, 0})},
                                       {{1, 3, 2.9}, UnitVector3({0, 0, -1})},
                                       {{3, 1.5, 1.2}, UnitVector3({1, 1, 0})}};
    const auto direct = [&](const Point3& p, const UnitVector3& n) {
        const Vector3 d = source - p;
        const double l2 = length_squared(d);
        return std::max(0.0, flux / (4.0 * pi) * dot(n, d) / (l2 * std::sqrt(l2)));
    };
    // Three meshes; the error of constant patches falls with the square of their size, that of
    // the rest with the next power: both are taken out.
    const std::array<double, 3> rho{0.2, 0.7, 0.5};
    const test::BoxRadiosity coarse(size, rho, direct, 2);
    const test::BoxRadiosity middle(size, rho, direct, 3);
    const test::BoxRadiosity fine(size, rho, direct, 4);
    const auto s = test::sample(scene, points, Estimator::automatic, 64, 61);
    for (std::size_t p = 0; p < points.size(); ++p) {
        const auto& [at, n, kind, reference] = points[p];
        const double a = coarse.reflected(at, n);
        const double m = middle.reflected(at, n);
        const double f = fine.reflected(at, n);
        // value + c2 h^2 + c3 h^3 through h = 1/2, 1/3, 1/4
        const double by_two = (16.0 * f - 9.0 * m) / 7.0;    // removes h^2 from the finer two
        const double by_two_too = (9.0 * m - 4.0 * a) / 5.0; // and from the coarser two
        const double q_fine = (16.0 / 64.0 - 9.0 / 27.0) / 7.0;
        const double q_coarse = (9.0 / 27.0 - 4.0 / 8.0) / 5.0;
        const double reflected =
            (q_coarse * by_two - q_fine * by_two_too) / (q_coarse - q_fine);
        const double truth = direct(at, n) + reflected;
        // What the extrapolation itself may miss.
        EXPECT_LT(std::abs(reflected - by_two), 5e-4 * truth) << p;
        const Estimate e = s.point(p);
        EXPECT_LT(std::abs(e.mean - truth), z_limit * e.standard_error + 2e-4 * truth)
            << p << ": " << e.mean << " +- " << e.standard_error << ", radiosity " << truth;
        EXPECT_LT(e.standard_error, 0.002 * truth) << p;
    }
}

// ---- row 23
// -----------------------------------------------------------------------------------

TEST(Stopping, IntervalsOfRunsThatStoppedByThemselvesHoldTheTruth) {
    constexpr double rho = 0.6;
    const Scene scene = test::furnace(rho).build();
    CalculationSurface surface;
    surface.receivers = test::furnace_points(3);
    const double exact = test::furnace_exitance / (1.0 - rho);
    constexpr std::size_t runs = 400;
    std::vector<std::size_t> covered(surface.receivers.size(), 0);
    std::vector<std::size_t> kept(surface.receivers.size(), 0);
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        Settings settings;
        settings.seed = seed;
        settings.tolerance = 0.05;
        const Results r = calculate(scene, {&surface, 1}, settings);
        for (std::size_t p = 0; p < covered.size(); ++p) {
            const Estimate e = r.surfaces.front().points[p].total;
            covered[p] += confidence_interval(e, 0.95).contains(exact) ? 1U : 0U;
            kept[p] += std::abs(e.mean - exact) <= 0.05 * e.mean ? 1U : 0U;
        }
    }
    for (std::size_t p = 0; p < covered.size(); ++p) {
        EXPECT_GE(covered[p], 352U) << p; // tails 1e-8 and 3e-8, METHODS 7.1
        EXPECT_LE(covered[p], 398U) << p;
        EXPECT_GE(kept[p], 380U) << p; // promised for 95 %, asked for more than that
    }
}

} // namespace
} // namespace isolux
