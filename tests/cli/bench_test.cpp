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

TEST(BenchVerb, MeasuresTimeToErrorAndRays) {
    const Ran ran = run_program({"bench",
                                 "--rooms",
                                 "empty-room",
                                 "--estimators",
                                 "mis,path-tracing",
                                 "--seconds",
                                 "0.1s",
                                 "--seeds",
                                 "2",
                                 "--points",
                                 "100",
                                 "--luminaires",
                                 "1",
                                 "--json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    const nlohmann::json j = nlohmann::json::parse(ran.out);
    ASSERT_EQ(j["rooms"].size(), 1U);
    const nlohmann::json& room = j["rooms"][0];
    EXPECT_EQ(room["name"], "empty-room");
    EXPECT_EQ(room["points"], 96);
    EXPECT_EQ(room["luminaires"], 4);
    EXPECT_GT(room["shadow_rays_per_second"].get<double>(), 0.0);
    EXPECT_GT(room["bare_rays_per_second"].get<double>(), 0.0);
    ASSERT_EQ(room["estimators"].size(), 2U);
    for (const auto& estimator : room["estimators"]) {
        ASSERT_EQ(estimator["times"].size(), 4U);
        double last = 0.0;
        for (const auto& time : estimator["times"]) { // smaller errors take no less time
            EXPECT_GE(time["cpu_seconds"].get<double>(), last);
            last = time["cpu_seconds"].get<double>();
        }
        const double efficiency = estimator["efficiency_per_second"].get<double>();
        EXPECT_GE(efficiency * 1.5, estimator["efficiency_over_seeds"][0].get<double>());
        EXPECT_LE(efficiency, 1.5 * estimator["efficiency_over_seeds"][1].get<double>());
        EXPECT_GT(estimator["runs"].size(), 0U);
    }
    ASSERT_EQ(j["by_points"].size(), 1U);
    EXPECT_GE(j["by_points"][0]["points"].get<int>(), 96);
    ASSERT_EQ(j["by_luminaires"].size(), 1U);
    EXPECT_EQ(j["by_luminaires"][0]["luminaires"], 1);
    ASSERT_EQ(j["by_luminaires_and_size"].size(), 1U);
    EXPECT_EQ(j["by_luminaires_and_size"][0]["luminaires"], 1);
}

TEST(BenchVerb, NamesWhatIsWrong) {
    EXPECT_THAT(complaint({"bench", "--rooms", "attic"}),
                HasSubstr("error: --rooms: 'attic' is not a room. Known are empty-room, "));
    EXPECT_THAT(complaint({"bench", "--estimators", "mis,fast"}),
                HasSubstr("error: --estimators: 'fast' is not an estimator. Known are auto, "));
    EXPECT_EQ(complaint({"bench", "--seeds", "0"}),
              "error: --seeds: 0 is out of range (1 to 1000)\n");
    EXPECT_THAT(complaint({"bench", "--seconds", "soon"}),
                HasSubstr("error: --seconds: 'soon' is not a time."));
    EXPECT_THAT(complaint({"bench", "no-such-project"}), HasSubstr("no-such-project"));
}

} // namespace
} // namespace isolux::test
