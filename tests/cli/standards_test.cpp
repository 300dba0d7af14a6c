#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace isolux::test {
namespace {

using testing::HasSubstr;

TEST(StandardsVerb, ListsStandardsAndPlaces) {
    const Ran ran = run_program({"standards"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_THAT(ran.out, HasSubstr("EN 12464-1:2021"));
    EXPECT_THAT(ran.out, HasSubstr("EN 1838:2013"));
    EXPECT_THAT(ran.out, HasSubstr("  Offices\n"));
}

TEST(StandardsVerb, FindsRowsThatHoldEveryWord) {
    const Ran ran = run_program({"standards", "office", "WRITING"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_THAT(ran.out, HasSubstr("34.2"));
    EXPECT_THAT(ran.out, HasSubstr("Em 500 (1000), U0 0.6"));
    EXPECT_THAT(ran.out, HasSubstr("recalled"));
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("34.1 ")));
}

TEST(StandardsVerb, SaysWhereNothingIsFound) {
    const Ran ran = run_program({"standards", "submarine"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux standards: no row holds 'submarine'. `isolux standards` lists the "
              "places\n");
}

TEST(StandardsVerb, ReadsATableOfTheUsersOwn) {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("t.json", R"({"isolux_standard": 1, "name": "Brief"})");
    const Ran ran = run_program({"standards", "all", "--file", file});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("the key \"rows\" is missing (a standard needs it)"));
}

} // namespace
} // namespace isolux::test
