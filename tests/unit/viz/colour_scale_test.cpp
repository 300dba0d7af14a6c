#include <algorithm>

#include <gtest/gtest.h>

#include "isolux/viz/colour_scale.h"
#include "isolux/viz/map_page.h"

namespace isolux {
namespace {

using Breaks = std::vector<double>;

TEST(Breaks, FollowThePhotometricSeries) {
    EXPECT_EQ(choose_breaks(12, 180, 0), (Breaks{15, 20, 30, 50, 75, 100, 150}));
    EXPECT_EQ(choose_breaks(0.8, 9, 0), (Breaks{1, 1.5, 2, 3, 5, 7.5}));
    EXPECT_EQ(choose_breaks(100, 2000, 0), (Breaks{150, 200, 300, 500, 750, 1000, 1500}));
}

TEST(Breaks, ThinTheSeriesOutOverMoreThanTwoDecades) {
    EXPECT_EQ(choose_breaks(1, 1200, 0), (Breaks{2, 5, 10, 20, 50, 100, 200, 500, 1000}));
    EXPECT_EQ(choose_breaks(0.02, 20000, 0), (Breaks{0.1, 1, 10, 100, 1000, 10000}));
}

TEST(Breaks, AreEqualStepsInNarrowRanges) {
    EXPECT_EQ(choose_breaks(401, 559, 0), (Breaks{425, 450, 475, 500, 525, 550}));
    EXPECT_EQ(choose_breaks(318, 382, 0), (Breaks{320, 330, 340, 350, 360, 370, 380}));
}

TEST(Breaks, AreSixToTwelveForAnyRange) {
    for (double low = 0.5; low < 5000; low *= 1.37)
        for (double ratio = 1.01; ratio < 900; ratio *= 1.29) {
            const Breaks b = choose_breaks(low, low * ratio, 0);
            EXPECT_GE(b.size(), 6u) << low << " " << low * ratio;
            EXPECT_LE(b.size(), 12u) << low << " " << low * ratio;
            EXPECT_TRUE(std::is_sorted(b.begin(), b.end()));
            EXPECT_GT(b.front(), low);
            EXPECT_LT(b.back(), low * ratio);
        }
}

TEST(Breaks, AreNeverCloserThanTheDoubt) {
    EXPECT_EQ(choose_breaks(401, 559, 40), (Breaks{450, 500, 550}));
    EXPECT_TRUE(choose_breaks(498, 499, 10).empty());
}

TEST(Breaks, AreNoneInAFlatOrDarkField) {
    EXPECT_TRUE(choose_breaks(500, 500, 0).empty());
    EXPECT_TRUE(choose_breaks(500, 500 * (1 + 1e-9), 0).empty());
    EXPECT_TRUE(choose_breaks(0, 0, 0).empty());
}

TEST(BandColours, GrowLighterAndCarryDarkText) {
    for (std::size_t n = 1; n <= 13; ++n) {
        const auto colours = band_colours(n);
        ASSERT_EQ(colours.size(), n);
        for (std::size_t k = 0; k < n; ++k) {
            // WCAG 2.1 asks 4.5 of body text.
            EXPECT_GE(contrast_ratio(colours[k], ink::black), 4.5) << n << " bands, " << k;
            if (k > 0) {
                EXPECT_GT(contrast_ratio(colours[k], {0, 0, 0}),
                          contrast_ratio(colours[k - 1], {0, 0, 0}));
            }
        }
    }
}

TEST(Contrast, IsThatOfTheStandard) {
    EXPECT_NEAR(contrast_ratio({0, 0, 0}, {255, 255, 255}), 21.0, 1e-12);
    EXPECT_NEAR(contrast_ratio({119, 119, 119}, {255, 255, 255}), 4.478, 5e-4);
}

TEST(FormatLux, KeepsThreeDigits) {
    EXPECT_EQ(format_lux(0), "0.00");
    EXPECT_EQ(format_lux(0.416), "0.42");
    EXPECT_EQ(format_lux(7.5), "7.50");
    EXPECT_EQ(format_lux(48.27), "48.3");
    EXPECT_EQ(format_lux(511.6), "512");
    EXPECT_EQ(format_lux(99.97), "100");
    EXPECT_EQ(format_lux(12345), "12300");
    EXPECT_EQ(format_break(7.5), "7.5");
    EXPECT_EQ(format_break(10000), "10000");
    EXPECT_EQ(format_break(0.1), "0.1");
}

TEST(NiceNumbers, AreOneTwoFive) {
    EXPECT_DOUBLE_EQ(nice_below(7.2), 5);
    EXPECT_DOUBLE_EQ(nice_below(0.0199), 0.01);
    EXPECT_DOUBLE_EQ(nice_above(1.3), 2);
    EXPECT_DOUBLE_EQ(nice_above(2.0), 2);
    EXPECT_DOUBLE_EQ(nice_above(2.1), 5);
    EXPECT_DOUBLE_EQ(nice_above(0.7), 1);
}

} // namespace
} // namespace isolux
