#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/cli/verdict_report.h"

#include "support/sample_results.h"

namespace isolux {
namespace {

using testing::HasSubstr;

TEST(VerdictReport, SaysVerdictValueLimitMarginAndClause) {
    const std::string text = to_verdict_table(test::make_results());
    EXPECT_THAT(text, HasSubstr("pass"));
    EXPECT_THAT(text, HasSubstr("510.0 [504.0, 516.0]"));
    EXPECT_THAT(text, HasSubstr(">= 500 lx"));
    EXPECT_THAT(text, HasSubstr("+10 lx"));
    EXPECT_THAT(text, HasSubstr("row 34.2: EN 1:2021"));
    EXPECT_THAT(text, HasSubstr("not judged"));
    EXPECT_THAT(text, HasSubstr("recommendation; not stated"));
    EXPECT_EQ(text.find("verdict: pass (limits: 1 pass, 1 not judged)\n"), 0U);
    EXPECT_THAT(text, HasSubstr("1 of 2 limits are recalled"));
    EXPECT_EQ(to_verdict_table({}), "");
}

TEST(VerdictReport, ShowsTheWorstObserver) {
    const std::string text = to_observer_table(test::make_results());
    EXPECT_THAT(text, HasSubstr("18.25 +-0.12"));
    EXPECT_THAT(text, HasSubstr("1 2 1.2"));
    EXPECT_THAT(text, HasSubstr("18.5 by table method: room 4H x 8H"));
    EXPECT_EQ(to_observer_table({}), "");
}

TEST(VerdictReport, ShowsThePowerOfTheRoomsThatHaveOne) {
    const std::string text = to_energy_table(test::make_results());
    EXPECT_THAT(text, HasSubstr("energy: office, 216 W over 24 m2, 9 W/m2, 1.800 +-0.024"));
    EXPECT_THAT(text, HasSubstr("LENI 12.5 kWh/(m2 a)"));
    EXPECT_THAT(text, testing::Not(HasSubstr("store")));
    EXPECT_EQ(to_energy_table({}), "");
}

} // namespace
} // namespace isolux
