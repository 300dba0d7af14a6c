#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "golden/expected_table.h"
#include "support/sample_results.h"

namespace isolux::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ExpectedTable, ReadsWhatTheSummaryWriterWrites) {
    const Results results = make_results();
    const Table table = read_table(to_summary_csv(results), "expected.csv");
    ASSERT_EQ(table.size(), 10U);
    const Estimate e = table.at({"faces 机房", "U0"});
    EXPECT_EQ(e.mean, results.surfaces[1].summary.uniformity.mean);
    EXPECT_EQ(e.standard_error, results.surfaces[1].summary.uniformity.standard_error);
    EXPECT_EQ(e.samples, 16U);
}

TEST(ExpectedTable, AcceptsWhatTheErrorsExplain) {
    const Table expected{{{"desk", "mean"}, {500.0, 1.0, 16}}, {{"desk", "U0"}, {0.6, 0.0, 1}}};
    Table found = expected;
    EXPECT_THAT(disagreements(found, expected), IsEmpty());
    found[{"desk", "mean"}] = {505.0, 1.0, 16}; // 3.5 combined errors
    found[{"desk", "U0"}].mean += 1e-11;
    EXPECT_THAT(disagreements(found, expected), IsEmpty());
}

TEST(ExpectedTable, NoticesABiasOfTenErrors) {
    const Table expected{{{"desk", "mean"}, {500.0, 1.0, 16}}};
    EXPECT_THAT(disagreements({{{"desk", "mean"}, {514.5, 1.0, 16}}}, expected),
                ElementsAre("desk, mean: 514.5 +- 1 found, 500 +- 1 expected"));
}

TEST(ExpectedTable, NoticesEveryDifferenceOfDeterministicValues) {
    EXPECT_THAT(disagreements({{{"desk", "U0"}, {0.6000001, 0.0, 1}}},
                              {{{"desk", "U0"}, {0.6, 0.0, 1}}}),
                testing::SizeIs(1));
}

TEST(ExpectedTable, NoticesMissingAndUnexpectedRows) {
    EXPECT_THAT(
        disagreements({{{"a", "mean"}, {1, 0, 1}}}, {{{"b", "mean"}, {1, 0, 1}}}),
        ElementsAre("b, mean: expected, but not calculated", "a, mean: not in expected.csv"));
}

TEST(ExpectedTable, NamesTheLineOfWhatIsNoNumber) {
    try {
        static_cast<void>(read_table("surface,quantity\ndesk,mean,lx,x,0,0,0,16\n", "e.csv"));
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "e.csv:2: 'x' is not a number");
    }
}

} // namespace
} // namespace isolux::test
