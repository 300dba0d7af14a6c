#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "isolux/measure/requirement.h"
#include "isolux/measure/standard.h"

#include "support/normal_draws.h"

namespace isolux {
namespace {

Verdict verdict_of(Sense sense, double limit, double value, Interval interval) {
    Verdict v;
    v.requirement.sense = sense;
    v.requirement.limit = limit;
    v.value = {value, 1.0, 16};
    v.interval = interval;
    decide(v);
    return v;
}

TEST(Verdict, PassesWhereTheWholeIntervalIsOnTheRightSide) {
    const Verdict v = verdict_of(Sense::at_least, 500, 510, {502, 518});
    EXPECT_EQ(v.decision, Decision::pass);
    EXPECT_EQ(v.margin, 10.0);
    EXPECT_EQ(v.least_margin, 2.0);
    EXPECT_EQ(verdict_of(Sense::at_most, 19, 18, {17.5, 18.5}).decision, Decision::pass);
    EXPECT_EQ(verdict_of(Sense::at_most, 19, 18, {17.5, 18.5}).least_margin, 0.5);
}

TEST(Verdict, FailsWhereTheWholeIntervalIsOnTheWrongSide) {
    EXPECT_EQ(verdict_of(Sense::at_least, 500, 490, {482, 498}).decision, Decision::fail);
    EXPECT_EQ(verdict_of(Sense::at_most, 19, 20, {19.5, 20.5}).decision, Decision::fail);
    EXPECT_EQ(verdict_of(Sense::at_most, 19, 20, {19.5, 20.5}).margin, -1.0);
}

TEST(Verdict, IsUndecidedWhereTheIntervalStraddlesTheLimit) {
    EXPECT_EQ(verdict_of(Sense::at_least, 500, 501, {498, 504}).decision, Decision::undecided);
    EXPECT_EQ(verdict_of(Sense::at_most, 19, 19.2, {18.9, 19.5}).decision, Decision::undecided);
}

TEST(Verdict, DoesNotFailAnExactValueForRounding) {
    EXPECT_EQ(
        verdict_of(Sense::at_least, 500, 500 - 1e-10, {500 - 1e-10, 500 - 1e-10}).decision,
        Decision::pass);
    EXPECT_EQ(verdict_of(Sense::at_least, 500, 500 - 1e-5, {500 - 1e-5, 500 - 1e-5}).decision,
              Decision::fail);
}

TEST(DecisionInterval, WidensWithEveryLookAndIsAPointForExactValues) {
    const Estimate e{100.0, 1.0, 16};
    const Interval one = decision_interval(e, 0.95, 1);
    const Interval two = decision_interval(e, 0.95, 2);
    EXPECT_NEAR(one.upper - 100.0, student_quantile(1 - 0.05 * 6 / (M_PI * M_PI), 15), 1e-12);
    EXPECT_NEAR(
        two.upper - 100.0, student_quantile(1 - 0.05 * 6 / (M_PI * M_PI) / 4, 15), 1e-12);
    EXPECT_EQ(decision_interval({100.0, 0.0, 1}, 0.95, 1).lower, 100.0);
}

/// A value at the limit itself: each firm verdict is wrong for a truth just beside it. Sixteen
/// normal replicates, a second look with twice the data where the first is undecided.
TEST(DecisionInterval, KeepsFirmVerdictsRareAtTheLimitHoweverOftenItLooks) {
    test::NormalDraws normal(20260101);
    constexpr int runs = 4000;
    int firm = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<double> sums(16, 0.0);
        for (std::size_t look = 1, units = 1; look <= 4; ++look, units *= 2) {
            for (double& s : sums)
                for (std::size_t u = look == 1 ? 0 : units / 2; u < units; ++u)
                    s += normal();
            std::vector<double> means;
            for (const double s : sums)
                means.push_back(500.0 + s / static_cast<double>(units));
            Verdict v;
            v.requirement.limit = 500.0;
            v.value = estimate_from_replicates(means);
            v.interval = decision_interval(v.value, 0.95, look);
            decide(v);
            if (v.decision != Decision::undecided) {
                ++firm;
                break;
            }
        }
    }
    // 5 % plus three standard deviations of the count (false alarm 0.13 %)
    EXPECT_LT(firm, runs * 0.05 + 3 * std::sqrt(runs * 0.05 * 0.95));
    EXPECT_GT(firm, 0);
}

TEST(Standard, ReplacesTheIlluminanceOnlyWhereModifiedValuesAreWanted) {
    Standard s{"S", "", {}, {{"recalled", "from memory"}, {"x", "seen"}}, {}, {}};
    StandardColumn em;
    em.form.symbol = "Em";
    em.form.clause = "5";
    StandardColumn raised = em;
    raised.form.symbol = "Em+";
    raised.raises = "Em";
    StandardColumn with = em;
    with.form.symbol = "U";
    with.with = "Em";
    with.limit = 0.1;
    with.source = "x";
    s.columns = {em, raised, with};
    s.rows = {{"1",
               "T1",
               "",
               "work",
               {{"Em", 500}, {"Em+", 1000}},
               "recalled",
               {{"Em+", "x"}},
               "",
               {}}};
    const auto plain = requirements_of(s, s.rows[0], RowLevel::required);
    const auto modified = requirements_of(s, s.rows[0], RowLevel::modified);
    ASSERT_EQ(plain.size(), 2U);
    ASSERT_EQ(modified.size(), 2U);
    EXPECT_EQ(plain[0].limit, 500.0);
    EXPECT_TRUE(plain[0].is_recalled);
    EXPECT_EQ(plain[0].clause, "5; T1");
    EXPECT_EQ(modified[0].limit, 1000.0);
    EXPECT_FALSE(modified[0].is_recalled);
    EXPECT_EQ(plain[1].symbol, "U");
    EXPECT_EQ(plain[1].source, "seen");
}

} // namespace
} // namespace isolux
