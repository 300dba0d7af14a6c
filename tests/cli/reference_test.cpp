#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace isolux::test {
namespace {

using ::testing::HasSubstr;

Ran sobolev(std::vector<std::string> more) {
    std::vector<std::string> arguments{"reference", "sobolev"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
}

/// The one error line that these options give.
std::string complaint(const std::vector<std::string>& arguments) {
    const Ran ran = run_program(arguments);
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    return ran.err;
}

TEST(ReferenceVerb, PrintsSobolevsProblemOnBothPlanes) {
    const Ran ran = sobolev({"--rho1",
                             "0.3",
                             "--rho2",
                             "0.6",
                             "--h1",
                             "0.8",
                             "--separation",
                             "2",
                             "--r",
                             "0,1,10"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(
        ran.out,
        HasSubstr("Two infinite planes 2 m apart, reflectances 0.3 (1) and 0.6 (2); 1000 lm, "
                  "isotropic, 0.8 m from plane 1\n"));
    EXPECT_THAT(ran.out, HasSubstr("134.45"));  // E1 at r = 0: 134.454 lx
    EXPECT_THAT(ran.out, HasSubstr("62.326"));  // E2 at r = 0: 62.3269 lx
    EXPECT_THAT(ran.out, HasSubstr("0.24936")); // E1 at r = 10 m: 0.249369 lx
}

TEST(ReferenceVerb, PrintsJsonWithAllDigits) {
    const Ran ran =
        sobolev({"--rho1=0.3", "--rho2=0.6", "--h1=0.8", "--separation=2", "--r=1", "--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json j = nlohmann::json::parse(ran.out);
    EXPECT_EQ(j["problem"], "sobolev");
    EXPECT_EQ(j["separation_m"], 2.0);
    EXPECT_EQ(j["points"].size(), 1u);
    EXPECT_NEAR(j["points"][0]["E1_lx"].get<double>(), 38.9413, 0.55e-4);
    EXPECT_NEAR(j["points"][0]["E2_lx"].get<double>(), 30.8662, 0.55e-4);
    // direct: I h/(h2 + r2)^(3/2) with I = 1000/(4 pi)
    EXPECT_NEAR(j["points"][0]["E1_direct_lx"].get<double>(),
                1000.0 / (4.0 * std::numbers::pi) * 0.8 / std::pow(1.64, 1.5),
                1e-12);
}

TEST(ReferenceVerb, PrintsTheIntegratingSphere) {
    const Ran ran = run_program(
        {"reference", "sphere", "--rho", "0.8", "--source-offset", "0.5", "--angles", "0,90"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("Reflected light everywhere: 318.309886 lx"));
    EXPECT_THAT(ran.out, HasSubstr("636.619772"));
    EXPECT_THAT(ran.out, HasSubstr("375.25"));
    const Ran json = run_program({"reference",
                                  "sphere",
                                  "--radius=1",
                                  "--rho=0.8",
                                  "--flux=1000",
                                  "--angles=77",
                                  "--json"});
    EXPECT_NEAR(
        nlohmann::json::parse(json.out)["points"][0]["E_lx"].get<double>(), 397.88736, 0.55e-5);
}

TEST(ReferenceVerb, ShowsExamplesInItsHelp) {
    EXPECT_THAT(run_program({"reference", "--help"}).out,
                HasSubstr("isolux reference sphere --rho 0.8"));
    const Ran ran = sobolev({"--help"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_THAT(ran.out, HasSubstr("Usage: isolux reference sobolev [OPTIONS]"));
    EXPECT_THAT(ran.out, HasSubstr("Examples:"));
    EXPECT_THAT(run_program({"reference", "sphere", "--help"}).out, HasSubstr("Examples:"));
}

TEST(ReferenceVerb, ChecksWhatSobolevsProblemNeeds) {
    const auto error = [](std::vector<std::string> more) {
        std::vector<std::string> arguments{"reference", "sobolev"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return complaint(arguments);
    };
    EXPECT_EQ(
        error({"--rho1=0.5", "--h1=0.5"}),
        "error: isolux reference sobolev: --rho2 is required. See `isolux reference sobolev "
        "--help`\n");
    EXPECT_EQ(error({"--rho1=50", "--rho2=0.5", "--h1=0.5"}),
              "error: --rho1: 50 is not a reflectance (0 to 1). Did you mean 0.5?\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=-0.5", "--h1=0.5"}),
              "error: --rho2: -0.5 is not a reflectance (0 to 1)\n");
    EXPECT_EQ(error({"--rho1=half", "--rho2=0.5", "--h1=0.5"}),
              "error: --rho1: 'half' is not a number\n");
    EXPECT_EQ(
        error({"--rho1=1", "--rho2=1", "--h1=0.5"}),
        "error: isolux reference sobolev: both planes reflect everything (the light never "
        "ends). Lower --rho1 or --rho2\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=1.5"}),
              "error: --h1: 1.5 m is not between the planes (they are 1 m apart). Lower it, or "
              "give --separation\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=0"}),
              "error: --h1: 0 m is not above zero\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=0.5", "--separation=-1"}),
              "error: --separation: -1 m is not above zero\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=0.5", "--flux=0"}),
              "error: --flux: 0 lm is not above zero\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=0.5", "--r", "-1"}),
              "error: --r: -1 m is below zero\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=0.5", "--r=1,,2"}),
              "error: --r: '' is not a number\n");
    EXPECT_EQ(error({"--rho1=0.5", "--rho2=0.5", "--h1=0.5", "--r=1e6"}),
              "error: --r: 1e+06 m is too far (more than 1000 separations)\n");
}

TEST(ReferenceVerb, ChecksWhatTheSphereNeeds) {
    EXPECT_EQ(
        complaint({"reference", "sphere", "--rho=1"}),
        "error: --rho: 1 leaves no absorption (the light never ends). Give less than 1\n");
    EXPECT_EQ(complaint({"reference", "sphere", "--rho=0.5", "--source-offset=1"}),
              "error: --source-offset: 1 m is not inside the sphere (0 to 1 m)\n");
    EXPECT_EQ(complaint({"reference", "sphere", "--rho=0.5", "--radius=0"}),
              "error: --radius: 0 m is not above zero\n");
    EXPECT_EQ(complaint({"reference", "sphere", "--rho=0.5", "--angles=0,x"}),
              "error: --angles: 'x' is not a number\n");
}

TEST(ReferenceVerb, KnowsItsProblems) {
    EXPECT_EQ(complaint({"reference"}),
              "error: isolux reference: no problem is named. Known are sobolev and sphere: "
              "`isolux reference --help`\n");
    EXPECT_EQ(complaint({"reference", "sobolef", "--rho1=0.5"}),
              "error: isolux reference: 'sobolef' is not known. Did you mean sobolev?\n");
    EXPECT_EQ(
        complaint({"reference", "furnace"}),
        "error: isolux reference: 'furnace' is not known. Known are sobolev and sphere\n");
    EXPECT_EQ(complaint({"reference", "sphere", "--rho=0.5", "--radios=2", "more"}),
              "error: isolux reference sphere: unknown option '--radios'. Did you mean "
              "--radius?\n"
              "error: isolux reference sphere: 'more' is one argument too many\n");
}

} // namespace
} // namespace isolux::test
