#include <cmath>

#include <gtest/gtest.h>

#include "isolux/cli/terminal.h"

namespace isolux {
namespace {

TEST(FormatSeconds, SpeaksLikePeople) {
    EXPECT_EQ(format_seconds(0.04), "0.0 s");
    EXPECT_EQ(format_seconds(4.26), "4.3 s");
    EXPECT_EQ(format_seconds(9.96), "10 s");
    EXPECT_EQ(format_seconds(119.4), "119 s");
    EXPECT_EQ(format_seconds(200.0), "3 min 20 s");
    EXPECT_EQ(format_seconds(7199.7), "2 h 0 min");
    EXPECT_EQ(format_seconds(7530.0), "2 h 5 min");
}

TEST(FormatProgress, TellsStageShareTimeAndError) {
    EXPECT_EQ(format_progress({0.456, 12.3, 0.0182, "calculating"}, 80),
              "calculating  45 %   12 s left   worst point +-1.8 %");
}

TEST(FormatProgress, LeavesOutWhatIsUnknown) {
    EXPECT_EQ(format_progress({0.0, -1.0, 0.0, "pilot"}, 80), "pilot   0 %");
    EXPECT_EQ(format_progress({1.5, -1.0, INFINITY, "pilot"}, 80), "pilot 100 %");
}

TEST(FormatProgress, FitsTheTerminal) {
    EXPECT_EQ(format_progress({0.456, 12.3, 0.0182, "calculating"}, 17), "calculating  45 %");
    EXPECT_EQ(format_progress({0.456, 12.3, 0.0182, "calculating"}, 0), "");
}

} // namespace
} // namespace isolux
