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

TEST(StandardsVerb, FindsRowsByTheirEverydayNames) {
    for (const char* word : {"blackboard", "Whiteboard", "chalkboard"}) {
        const Ran ran = run_program({"standards", word});
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_THAT(ran.out, HasSubstr("44.4")) << word;
        EXPECT_THAT(ran.out, HasSubstr("Black, green and white boards")) << word;
    }
}

TEST(StandardsVerb, FindsTheEverydayNamesOfATableOfTheUsersOwn) {
    const TemporaryFolder folder;
    const std::string table = R"({"isolux_standard": 1, "name": "Brief",
        "sources": [{"key": "k", "text": "client"}],
        "columns": [{"symbol": "Em", "quantity": "illuminance", "area": "task", "statistic": "mean",
          "sense": "at least", "unit": "lx", "clause": "3", "name": "mean"}],
        "rows": [{"id": "7", "clause": "3", "task": "Sitting", "also": ["sofa", "armchair"],
          "limits": {"Em": 300}, "source": "k"}]})";
    Ran ran = run_program({"standards", "sofa", "--file", folder.write("t.json", table)});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("Sitting"));
    std::string wrong = table;
    wrong.replace(wrong.find("[\"sofa\", \"armchair\"]"), 20, "\"sofa\"");
    ran = run_program({"standards", "sofa", "--file", folder.write("w.json", wrong)});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("#/rows/0/also: a list is expected here"));
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
