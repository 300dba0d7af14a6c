#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/transport/light_grid.h"

#include "support/random_luminaires.h"
#include "support/statistics.h"

namespace isolux {
namespace {

using test::NormalDraws;

/// Frequencies against probabilities, chi-square with a false alarm of 1e-8. Where neither part
/// of a node can light the place although the node's looser bound says so, nobody is picked.
TEST(LightGrid, PicksWithTheProbabilitiesItTells) {
    NormalDraws random(3);
    const Scene scene = test::random_scene(random, 100, 10.0);
    const LightGrid grid(scene);
    for (int i = 0; i < 5; ++i) {
        const Point3 place = test::random_point(random, 12.0);
        constexpr int draws = 200000;
        std::vector<double> counts(101, 0.0); // the last one: nobody
        for (int k = 0; k < draws; ++k) {
            const LightTree::Pick pick = grid.pick(place, random.uniform());
            counts[pick.probability > 0.0 ? pick.luminaire : 100] += 1.0;
            if (pick.probability > 0.0) {
                ASSERT_NEAR(pick.probability, grid.probability(place, pick.luminaire), 1e-12);
            }
        }
        std::vector<double> probabilities;
        double nobody = 1.0;
        for (std::size_t l = 0; l < 100; ++l) {
            probabilities.push_back(grid.probability(place, l));
            nobody -= probabilities.back();
        }
        EXPECT_GT(nobody, -1e-12);
        probabilities.push_back(nobody);
        std::vector<double> observed{0.0}; // the rare ones together
        std::vector<double> expected{0.0};
        for (std::size_t l = 0; l < counts.size(); ++l) {
            const double mean = draws * probabilities[l];
            if (mean >= 5.0) {
                observed.push_back(counts[l]);
                expected.push_back(mean);
            } else {
                observed[0] += counts[l];
                expected[0] += mean;
            }
        }
        if (expected[0] < 5.0) {
            EXPECT_LT(observed[0], 40.0);
            observed.erase(observed.begin());
            expected.erase(expected.begin());
        }
        EXPECT_GT(test::chi_square_tail(observed, expected), test::chi_square_false_alarm);
    }
}

/// Twenty by fifteen points of light, 2 m apart.
Scene hall_of_points() {
    test::Builder b;
    const auto type = b.add_isotropic_type(1000);
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 15; ++j)
            b.add_point({2.0 * i, 2.0 * j, 3.0}, type);
    return b.build();
}

/// What a draw is worth, light over probability, never is far more than all of the light,
/// wherever a place lies among the tree's boxes, and varies far less than draws by the tree
/// alone do.
TEST(LightGrid, DrawsAsThereIsLight) {
    const Scene scene = hall_of_points();
    const LightGrid grid(scene);
    NormalDraws random(9);
    double worst = 0.0;
    double variance = 0.0;
    double variance_by_tree = 0.0;
    constexpr int places = 200;
    for (int k = 0; k < places; ++k) {
        const Point3 place{40.0 * random.uniform(), 30.0 * random.uniform(), 0.75};
        std::vector<double> light;
        double all = 0.0;
        for (const Luminaire& l : scene.luminaires) {
            light.push_back(1.0
                            / length_squared(place - l.placement.world_from_luminaire.origin));
            all += light.back();
        }
        double square = 0.0;
        double square_by_tree = 0.0;
        for (std::size_t l = 0; l < light.size(); ++l) {
            const double share = light[l] / all;
            const double p = grid.probability(place, l);
            worst = std::max(worst, share / p);
            square += share * share / p;
            square_by_tree += share * share / grid.tree().probability(0, place, l);
        }
        variance += (square - 1.0) / places;
        variance_by_tree += (square_by_tree - 1.0) / places;
    }
    EXPECT_LT(worst, 10.0);
    EXPECT_LT(variance, 0.25);
    EXPECT_LT(variance, 0.1 * variance_by_tree);
}

/// Luminaires in one place, most of them off: who shines is drawn, evenly.
TEST(LightGrid, KnowsLuminairesInOnePlace) {
    test::Builder b;
    const auto type = b.add_isotropic_type(1000);
    for (int i = 0; i < 80; ++i) {
        b.add_point({1.0, 2.0, 3.0}, type);
        if (i % 8 != 0)
            b.luminaires.back().flux = Lumen(0.0);
    }
    const Scene scene = b.build();
    const LightGrid grid(scene);
    for (const Point3& place : {Point3{1, 2, 3}, Point3{1, 2, 0}, Point3{-50, 7, 1e4}}) {
        for (int k = 0; k < 100; ++k)
            EXPECT_EQ(grid.pick(place, (k + 0.5) / 100).luminaire % 8, 0U);
        for (std::size_t l = 0; l < 80; ++l)
            EXPECT_NEAR(grid.probability(place, l), l % 8 == 0 ? 0.1 : 0.0, 1e-6) << l;
    }
}

/// Nothing shines, or one luminaire alone.
TEST(LightGrid, KnowsDarkness) {
    test::Builder dark;
    dark.add_point({0, 0, 3}, dark.add_isotropic_type(1000));
    test::Builder one = dark;
    dark.luminaires.back().flux = Lumen(0.0);
    const Point3 place{1, 1, 0};
    const LightGrid nothing(dark.build());
    EXPECT_EQ(nothing.pick(place, 0.5).probability, 0.0);
    EXPECT_EQ(nothing.probability(place, 0), 0.0);
    const LightGrid alone(one.build());
    EXPECT_EQ(alone.pick(place, 0.5).probability, 1.0);
    EXPECT_EQ(alone.probability(place, 0), 1.0);
}

} // namespace
} // namespace isolux
