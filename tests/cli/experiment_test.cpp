#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace isolux::test {
namespace {

using ::testing::HasSubstr;

std::string complaint(const std::vector<std::string>& arguments) {
    const Ran ran = run_program(arguments);
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    return ran.err;
}

TEST(ExperimentVerb, ComparesEveryMethodWithTheSeries) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"experiment",
                                 "sobolev",
                                 "--work",
                                 "0.05",
                                 "--r",
                                 "0,0.5,2",
                                 "--json",
                                 "-o",
                                 folder.path("out")});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json j = nlohmann::json::parse(ran.out);
    EXPECT_EQ(j["places"].size(), 6U);
    ASSERT_EQ(j["methods"].size(), 7U);
    for (const auto& method : j["methods"]) {
        // Each is right within its own errors: two-sided 2e-9 a place, 15 degrees of freedom.
        EXPECT_LT(method["worst_z"].get<double>(), 12.7) << method["name"];
        EXPECT_GT(method["cpu_seconds_to_1_percent"].get<double>(), 0.0) << method["name"];
        EXPECT_EQ(method["values"].size(), 6U);
    }
    EXPECT_GT(j["local_estimation_over_counting"]["without_scene"].get<double>(), 1.0);
    EXPECT_EQ(read_text(folder.path("out/sobolev.json")), ran.out);
    EXPECT_THAT(read_text(folder.path("out/sobolev.csv")), HasSubstr("plane,r_m,series_lx"));
    EXPECT_THAT(read_text(folder.path("out/sobolev.svg")),
                HasSubstr("Deviation from the series on plane 2"));
    EXPECT_EQ(read_text(folder.path("out/sobolev.png")).substr(1, 3), "PNG");
}

TEST(ExperimentVerb, PrintsATableAndSaysWhatTheRatioIsWorth) {
    const Ran ran =
        run_program({"experiment", "sobolev", "--work", "0.01", "--r", "0.5", "--quiet"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("Two infinite planes 1 m apart, reflectances 0.5 (1) and "));
    EXPECT_THAT(ran.out, HasSubstr("times counting"));
    EXPECT_THAT(ran.out, HasSubstr("reports 80 to 90 times"));
}

TEST(ExperimentVerb, NamesWhatIsWrong) {
    EXPECT_EQ(complaint({"experiment"}),
              "error: isolux experiment: no experiment is named. Known are sobolev: `isolux "
              "experiment --help`\n");
    EXPECT_EQ(complaint({"experiment", "sobolev", "--rho1", "1"}),
              "error: --rho1: 1 is not between 0 and 1 (light that nothing or everything "
              "absorbs has no walk)\n");
    EXPECT_EQ(complaint({"experiment", "sobolev", "--h1", "1"}),
              "error: --h1: 1 is not between 0 and 1 (metres, inside)\n");
    EXPECT_EQ(complaint({"experiment", "sobolev", "--r", "0,x"}),
              "error: --r: 'x' is not a number\n");
    EXPECT_EQ(complaint({"experiment", "sobolev", "--r", "11"}),
              "error: --r: 11 m is not between 0 and 10 separations (the traced planes are "
              "finite)\n");
}

} // namespace
} // namespace isolux::test
