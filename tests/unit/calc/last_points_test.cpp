#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/accumulator.h"
#include "isolux/calc/last_points.h"

namespace isolux {
namespace {

/// What a choice comes to: the light paths are walked for the longest of those who stay.
double cost_of(const std::vector<Finish>& points,
               const std::vector<std::size_t>& traced,
               double paths_cost) {
    double cost = 0.0;
    double longest = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (std::binary_search(traced.begin(), traced.end(), k)) {
            cost += points[k].traced;
            continue;
        }
        cost += points[k].units * points[k].unit_cost;
        longest = std::max(longest, points[k].units);
    }
    return cost + longest * paths_cost;
}

TEST(LastPoints, AreDividedAtTheLeastCostOfAllDivisions) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform;
    for (int round = 0; round < 300; ++round) {
        std::vector<Finish> points(1 + random() % 9);
        for (Finish& p : points)
            p = {std::ceil(20.0 * uniform(random)),
                 100.0 * uniform(random),
                 4000.0 * uniform(random)};
        const double paths_cost = 1000.0 * uniform(random);
        const double chosen = cost_of(points, choose_traced(points, paths_cost), paths_cost);
        for (unsigned set = 0; set < 1U << points.size(); ++set) {
            std::vector<std::size_t> traced;
            for (std::size_t k = 0; k < points.size(); ++k)
                if ((set >> k & 1U) != 0)
                    traced.push_back(k);
            EXPECT_LE(chosen, cost_of(points, traced, paths_cost) * (1.0 + 1e-12));
        }
    }
}

TEST(LastPoints, OfWhichThereAreNoneNeedNobody) { EXPECT_TRUE(choose_traced({}, 1.0).empty()); }

TEST(LastPoints, StayWhereTracingIsDear) {
    const std::vector<Finish> points(3, {1.0, 1.0, 1e6});
    EXPECT_TRUE(choose_traced(points, 100.0).empty());
}

TEST(LastPoints, NeedMoreTheFartherTheyAre) {
    EXPECT_DOUBLE_EQ(share_missing({4, 3.0}), 2.6);
    EXPECT_DOUBLE_EQ(share_missing({4, 1.0}), 0.25); // never nothing: they are open
    EXPECT_DOUBLE_EQ(share_missing({4, 0.2}), 0.25);
}

TEST(LastPoints, GrowNoMoreThanMostOfThemNeed) {
    EXPECT_DOUBLE_EQ(units_missing({4, 3.0}), 10.4);
    EXPECT_EQ(growth_for({}), 1.0);
    EXPECT_EQ(growth_for({0.25, 0.25, 0.25}), 1.0);
    // twice what four fifths of them need; who needs very much does not count
    EXPECT_EQ(growth_for({0.5, 3.0, 1.0, 0.25, 2.0, 1.5, 0.25, 1.0, 900.0, 0.5}), 4.0);
    EXPECT_EQ(growth_for({900.0, 1.0, 2.0, 0.5, 0.5}), 4.0);
    EXPECT_EQ(growth_for({7.0}), 14.0);
}

class TwoPoints : public testing::Test {
protected:
    TwoPoints() {
        surfaces[0].receivers.resize(2);
        sums.emplace(surfaces, 2);
    }

    /// Direct light of 1 lx and these amounts of indirect light, in both replicates.
    void add(double first, double second) {
        const std::vector<double> direct(4, 1.0);
        const std::vector<double> indirect{first, second, first, second};
        sums->add_unit(tile(), direct, indirect);
    }

    const Accumulator::Tile& tile() { return sums->tiles().front(); }

    double indirect(std::size_t p) { return sums->estimates(tile(), p).indirect.mean; }

    std::vector<CalculationSurface> surfaces{1};
    std::optional<Accumulator> sums;
};

TEST_F(TwoPoints, KeepTheSumsOfEveryEstimatorApart) {
    add(10.0, 20.0);
    sums->change_estimator(1);
    EXPECT_EQ(sums->indirect_units(1), 0U);
    EXPECT_EQ(sums->parked_units(1), 1U);
    add(12.0, 30.0);
    EXPECT_DOUBLE_EQ(indirect(0), 11.0);
    EXPECT_DOUBLE_EQ(indirect(1), 30.0);
    EXPECT_DOUBLE_EQ(sums->parked(1).mean, 20.0);
    sums->change_estimator(1); // and back
    add(11.0, 22.0);
    EXPECT_DOUBLE_EQ(indirect(1), 21.0);
    EXPECT_DOUBLE_EQ(sums->parked(1).mean, 30.0);
    EXPECT_EQ(sums->parked_units(0), 0U);
}

TEST_F(TwoPoints, RefineOnlyWhatIsOpen) {
    add(10.0, 20.0);
    sums->refine(0, false, false);
    sums->refine(1, true, false);
    EXPECT_EQ(sums->open_points(), 1U);
    add(99.0, 99.0);
    EXPECT_DOUBLE_EQ(indirect(0), 10.0);
    EXPECT_DOUBLE_EQ(indirect(1), 20.0);
    EXPECT_EQ(sums->direct_units(0), 1U);
    EXPECT_EQ(sums->direct_units(1), 2U);
    EXPECT_EQ(sums->indirect_units(1), 1U);
    EXPECT_TRUE(sums->is_open(tile()));
    sums->refine(1, false, false);
    EXPECT_FALSE(sums->is_open(tile()));
}

} // namespace
} // namespace isolux
