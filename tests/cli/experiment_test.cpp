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

TEST(ExperimentVerb, MeasuresWhatTheFilterIsWorth) {
    for (const std::string name : {"soft-shadow", "indirect", "lens"}) {
        const TemporaryFolder folder;
        const Ran ran = run_program({"experiment",
                                     name,
                                     "--size",
                                     "24",
                                     "--spp",
                                     "8",
                                     "--seeds",
                                     "2",
                                     "--reference",
                                     "16",
                                     "--json",
                                     "-o",
                                     folder.path("out")});
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
        const nlohmann::json j = nlohmann::json::parse(ran.out);
        ASSERT_EQ(j["runs"].size(), 2U);
        for (const auto& run : j["runs"]) {
            ASSERT_EQ(run["unfiltered"].size(), 4U);
            // A fourth of the samples of the last is far noisier than the last.
            EXPECT_GT(run["unfiltered"][0]["relative_mse"].get<double>(),
                      run["unfiltered"][3]["relative_mse"].get<double>())
                << name;
            EXPECT_GT(run["equal_samples"].get<double>(), 0.0) << name;
        }
        EXPECT_LT(j["reference_noise"].get<double>(), 0.1) << name;
        const std::string stem = folder.path("out/" + name);
        EXPECT_EQ(read_text(stem + ".json"), ran.out);
        EXPECT_THAT(read_text(stem + ".csv"), HasSubstr("seed,picture,samples,relative_mse"));
        EXPECT_THAT(read_text(stem + ".svg"), HasSubstr("Error over samples"));
    }
}

// Points of a pixel that a lens smears over an edge were once taken for points far from it:
// single samples a thousand times too bright made the error of one seed many times that of
// another.
TEST(ExperimentVerb, FindsTheSameNoiseThroughALensForEverySeed) {
    const Ran ran = run_program(
        {"experiment", "lens", "--size", "48", "--spp", "8", "--seeds", "2", "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json j = nlohmann::json::parse(ran.out);
    for (std::size_t k = 0; k < 4; ++k) {
        const auto error = [&](std::size_t seed) {
            return j["runs"][seed]["unfiltered"][k]["relative_mse"].get<double>();
        };
        EXPECT_LT(error(0), 2.0 * error(1)) << k;
        EXPECT_LT(error(1), 2.0 * error(0)) << k;
    }
}

TEST(ExperimentVerb, SaysHowManyTimesTheSamplesAreSpared) {
    const Ran ran = run_program({"experiment",
                                 "indirect",
                                 "--size",
                                 "24",
                                 "--spp",
                                 "4",
                                 "--seeds",
                                 "2",
                                 "--reference",
                                 "32",
                                 "--quiet"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("24 x 24 pixels, filtered at 4 rays a pixel, 2 seeds"));
    EXPECT_THAT(ran.out, HasSubstr("times the CPU seconds (the aim is 15 times at 512 x 512)"));
}

TEST(ExperimentVerb, FollowsNoisyAndDenoisedPictures) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"experiment",
                                 "denoise",
                                 "--size",
                                 "24",
                                 "--steps",
                                 "3",
                                 "--spp",
                                 "2",
                                 "--seeds",
                                 "2",
                                 "-o",
                                 folder.path("out"),
                                 "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json j = nlohmann::json::parse(ran.out);
    ASSERT_EQ(j["steps"].size(), 3U);
    EXPECT_EQ(j["steps"][2]["samples"], 6);
    EXPECT_EQ(j["filters"][0]["name"], "axis-aligned");
    const auto& first = j["steps"][0]["filters"][0];
    EXPECT_EQ(first["similarity_to_first_percent"]["mean"], 100.0);
    EXPECT_LT(first["similarity_to_own_percent"]["mean"], 100.0);
    EXPECT_LT(j["steps"][2]["relative_mse"]["mean"].get<double>(),
              j["steps"][0]["relative_mse"]["mean"].get<double>());
    EXPECT_EQ(read_text(folder.path("out/denoise.json")), ran.out);
    EXPECT_THAT(read_text(folder.path("out/denoise.csv")), HasSubstr("samples,filter,"));
    EXPECT_THAT(read_text(folder.path("out/denoise.svg")), HasSubstr("against the reference"));
}

TEST(ExperimentVerb, NamesWhatIsWrong) {
    EXPECT_EQ(complaint({"experiment", "lens", "--size", "8"}),
              "error: --size: 8 is out of range (16 to 2048)\n");
    EXPECT_EQ(complaint({"experiment", "denoise", "--steps", "1"}),
              "error: --steps: 1 is out of range (2 to 1000)\n");
    EXPECT_THAT(complaint({"experiment",
                           "indirect",
                           "--size",
                           "16",
                           "--spp",
                           "16",
                           "--seeds",
                           "4",
                           "--reference",
                           "1"}),
                HasSubstr("error: --reference: the reference's own noise may be "));
    EXPECT_EQ(complaint({"experiment"}),
              "error: isolux experiment: no experiment is named. Known are sobolev, denoise, "
              "soft-shadow, indirect, lens: `isolux experiment --help`\n");
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
