#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/estimate.h"

#include "support/normal_draws.h"

namespace isolux {
namespace {

TEST(EstimateFromReplicates, GivesMeanAndStandardError) {
    const Estimate e = estimate_from_replicates(std::vector<double>{1, 2, 3, 6});
    EXPECT_DOUBLE_EQ(e.mean, 3.0);
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(14.0 / 3.0 / 4.0));
    EXPECT_EQ(e.samples, 4U);
}

TEST(EstimateFromReplicates, TakesOneAndNone) {
    EXPECT_EQ(estimate_from_replicates(std::vector<double>{5}).standard_error, 0.0);
    EXPECT_EQ(estimate_from_replicates(std::vector<double>{5}).samples, 1U);
    EXPECT_EQ(estimate_from_replicates({}).samples, 0U);
}

TEST(EstimateFromReplicates, KeepsItsDigitsFarFromZero) {
    // The textbook formula (sum of squares minus square of sum) would lose them all.
    const Estimate e = estimate_from_replicates(std::vector<double>{1e9, 1e9 + 1, 1e9 + 2});
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(1.0 / 3.0));
}

TEST(StudentQuantile, MatchesPrintedTables) {
    EXPECT_NEAR(student_quantile(0.95, 1), 12.706, 5e-4);
    EXPECT_NEAR(student_quantile(0.95, 15), 2.131, 5e-4);
    EXPECT_NEAR(student_quantile(0.99, 10), 3.169, 5e-4);
    EXPECT_NEAR(student_quantile(0.95, 1e7), 1.95996, 5e-5);
}

TEST(ConfidenceInterval, IsStudentsAndCollapsesForDeterministicValues) {
    const Interval i = confidence_interval({100.0, 2.0, 16}, 0.95);
    EXPECT_NEAR(i.upper - 100.0, 2.0 * 2.13145, 1e-4);
    EXPECT_DOUBLE_EQ(100.0 - i.lower, i.upper - 100.0);
    EXPECT_EQ(confidence_interval({7.0, 0.0, 16}, 0.95).lower, 7.0);
    EXPECT_EQ(confidence_interval({7.0, 0.0, 1}, 0.95).upper, 7.0);
}

TEST(ConfidenceInterval, CoversTheTruthAsOftenAsItSays) {
    // 400 runs: 360..394 has tails of 1.4e-5 and 5e-5 (METHODS, statistical protocol).
    test::NormalDraws normal(3);
    int covered = 0;
    for (int run = 0; run < 400; ++run) {
        std::vector<double> y;
        for (int r = 0; r < 16; ++r)
            y.push_back(50.0 + 3.0 * normal());
        covered +=
            confidence_interval(estimate_from_replicates(y), 0.95).contains(50.0) ? 1 : 0;
    }
    EXPECT_GE(covered, 360);
    EXPECT_LE(covered, 394);
}

} // namespace
} // namespace isolux
