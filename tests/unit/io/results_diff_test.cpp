#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/results_diff.h"

#include "support/sample_results.h"

namespace isolux {
namespace {

ResultsDocument make_document() {
    Project project;
    project.name = "Office";
    project.file = {"office.json", std::string(64, 'a')};
    project.inputs = {{"a.ies", std::string(64, 'b')}, {"c.ies", std::string(64, 'c')}};
    return make_results_document(project, {}, test::make_results());
}

TEST(ResultsDiff, FindsNothingBetweenEqualResults) {
    const ResultsDiff d = compare_results(make_document(), make_document());
    EXPECT_FALSE(d.has_changes());
    EXPECT_TRUE(d.inputs.empty());
    EXPECT_EQ(d.compared, 2U * 5U + 4U + 2U + 1U); // statistics, points, one rating
}

TEST(ResultsDiff, ListsInputsThatDiffer) {
    ResultsDocument b = make_document();
    b.seed = 2;
    b.inputs = {{"a.ies", std::string(64, 'd')}, {"e.ies", std::string(64, 'c')}};
    b.project.sha256 = std::string(64, 'f');
    const ResultsDiff d = compare_results(make_document(), b);
    EXPECT_THAT(d.inputs,
                testing::ElementsAre("seed: 1 -> 2",
                                     "project file: contents differ",
                                     "file a.ies: contents differ",
                                     "file e.ies: only in the second",
                                     "file c.ies: only in the first"));
    EXPECT_FALSE(d.has_changes());
}

TEST(ResultsDiff, LeavesDifferencesWithinTheErrorsAlone) {
    ResultsDocument b = make_document();
    SurfaceSummary& s = b.results.surfaces[0].summary;
    s.mean.mean += 3.0 * s.mean.standard_error; // among fifteen values no wonder
    EXPECT_FALSE(compare_results(make_document(), b).has_changes());
    s.mean.mean += 20.0 * s.mean.standard_error;
    const ResultsDiff d = compare_results(make_document(), b);
    ASSERT_EQ(d.values.size(), 1U);
    EXPECT_EQ(d.values[0].what, "Em");
    EXPECT_EQ(d.values[0].where, "office/work \"plane\", 1");
}

TEST(ResultsDiff, CountsThePointsOfASurfaceThatMovedAndShowsTheFurthest) {
    ResultsDocument b = make_document();
    b.results.surfaces[0].points[1].total.mean += 50.0;
    b.results.surfaces[0].points[2].total.mean += 90.0;
    const ResultsDiff d = compare_results(make_document(), b);
    ASSERT_EQ(d.values.size(), 1U);
    EXPECT_THAT(d.values[0].what, testing::StartsWith("2 of "));
    EXPECT_EQ(d.values[0].after.mean, b.results.surfaces[0].points[2].total.mean);
}

TEST(ResultsDiff, ComparesVerdictsByTheirWord) {
    ResultsDocument b = make_document();
    b.results.verdicts[0].decision = Decision::undecided;
    b.results.verdicts.pop_back();
    const ResultsDiff d = compare_results(make_document(), b);
    ASSERT_EQ(d.verdicts.size(), 2U);
    EXPECT_EQ(d.verdicts[0].what, "EN 1:2021 34.2 Em");
    EXPECT_EQ(d.verdicts[0].before, "pass");
    EXPECT_EQ(d.verdicts[0].after, "undecided");
}

TEST(ResultsDiff, NamesWhatOnlyOneOfThemHas) {
    ResultsDocument b = make_document();
    b.results.surfaces[1].surface.name = "noses";
    b.results.observers.clear();
    const ResultsDiff d = compare_results(make_document(), b);
    EXPECT_THAT(d.missing,
                testing::UnorderedElementsAre(testing::HasSubstr("only in the first"),
                                              "surface noses: only in the second",
                                              "observers desk: only in the first"));
    EXPECT_TRUE(d.has_changes());
}

} // namespace
} // namespace isolux
