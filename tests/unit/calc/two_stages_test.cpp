#include <cmath>

#include <gtest/gtest.h>

#include "isolux/calc/two_stages.h"

#include "support/furnace.h"

namespace isolux {
namespace {

TEST(TwoStages, WorkFollowsFromThePilotsSpread) {
    // 1 % standard error of the pilot, asked for 1 % at t = 2.131: s_up / s = sqrt(15/8.5468).
    const double ratio = 2.1314495 * std::sqrt(15.0 / 8.546756);
    EXPECT_NEAR(
        units_for({100.0, 1.0, 16}, 0.01, 0.0, 2.1314495), std::pow(ratio, 2.0 / 1.3), 1e-9);
    // Never less than one unit, and a dark point is held to the floor.
    EXPECT_EQ(units_for({100.0, 1e-6, 16}, 0.01, 0.0, 2.13), 1.0);
    EXPECT_EQ(units_for({0.0, 0.0, 16}, 0.01, 0.0, 2.13), 1.0);
    EXPECT_LT(units_for({1.0, 1.0, 16}, 0.01, 50.0, 2.13),
              units_for({1.0, 1.0, 16}, 0.01, 1.0, 2.13));
}

TEST(TwoStages, KeepTheToleranceAndTheTruth) {
    constexpr double rho = 0.5;
    const Scene scene = test::furnace(rho).build();
    CalculationSurface surface;
    surface.receivers = test::furnace_points(6);
    Settings settings;
    settings.tolerance = 0.02;
    settings.stopping = Stopping::two_stages;
    const double exact = test::furnace_exitance / (1.0 - rho);
    std::size_t inside = 0;
    std::size_t converged = 0;
    constexpr std::size_t runs = 20;
    for (settings.seed = 1; settings.seed <= runs; ++settings.seed) {
        const Results r = calculate(scene, {&surface, 1}, settings);
        converged += r.converged ? 1U : 0U;
        for (const PointResult& p : r.surfaces.front().points)
            inside += std::abs(p.total.mean - exact) <= 0.02 * exact ? 1U : 0U;
    }
    EXPECT_GE(converged, runs - 8);
    EXPECT_GE(inside, 6 * runs - 6);
    // The same seed, the same bits.
    settings.seed = 3;
    EXPECT_EQ(calculate(scene, {&surface, 1}, settings).surfaces.front().replicates.values,
              calculate(scene, {&surface, 1}, settings).surfaces.front().replicates.values);
}

} // namespace
} // namespace isolux
