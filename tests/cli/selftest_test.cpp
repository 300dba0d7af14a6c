#include <gtest/gtest.h>

#include "cli/program.h"

namespace isolux::test {
namespace {

TEST(SelftestVerb, PrintsATableOfRows) {
    const Ran ran = run_program({"selftest", "--only", "Lambertian disc"});
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
    for (const char* text : {"case             quantity",
                             "std. error",
                             "reference",
                             "pass",
                             "exact",
                             "4 of 4 rows passed"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
    EXPECT_EQ(ran.err, "");
}

TEST(SelftestVerb, ComparesStatisticalRowsByZ) {
    const Ran ran = run_program({"selftest", "--only", "sphere"});
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
    for (const char* text : {"reflected light at z",
                             "flux absorbed",
                             "A row passes if |z| is below",
                             "10 of 10 rows passed"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
}

TEST(SelftestVerb, PrintsJson) {
    const Ran ran = run_program({"selftest", "--only", "inverse square", "--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
    EXPECT_TRUE(
        ran.out.starts_with("{\n  \"isolux_selftest\": 1,\n  \"version\": \"" ISOLUX_VERSION
                            "\",\n  \"seed\": 1,\n  \"passed\": true,\n"))
        << ran.out.substr(0, 200);
    for (const char* key :
         {"case", "quantity", "unit", "computed", "standard_error", "reference", "z", "pass"})
        EXPECT_NE(ran.out.find("\"" + std::string(key) + "\": "), std::string::npos) << key;
}

TEST(SelftestVerb, LeavesItsOutcomeInAFolder) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"selftest", "--json", "-o", folder.path("new")});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(read_text(folder.path("new/selftest.json")), ran.out);
}

TEST(SelftestVerb, ListsCasesWhenNoneIsMeant) {
    const Ran ran = run_program({"selftest", "--only", "radiosity"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_TRUE(
        ran.err.starts_with("error: --only: no case is called 'radiosity'. Cases: inverse "
                            "square and cosine law; "))
        << ran.err;
}

TEST(SelftestVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"selftest", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"Usage: isolux selftest", "--json", "--seed", "Examples:"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text;
}

} // namespace
} // namespace isolux::test
