#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/efficiency.h"

namespace isolux {
namespace {

/// Values about 100 lx that vary, and state that they vary, by some standard error.
std::vector<Estimate> noisy(double standard_error, unsigned seed) {
    std::mt19937 numbers(seed);
    std::normal_distribution<double> noise(0.0, standard_error);
    std::vector<Estimate> values(10000);
    for (Estimate& e : values) {
        e.mean = 100.0 + noise(numbers);
        e.standard_error = standard_error;
    }
    return values;
}

TEST(RmsError, IsThatOfTheValuesAlone) {
    // 10 000 points know it to 1 %, and the sum of two squares to as much.
    EXPECT_NEAR(rms_error_against(noisy(0.0, 1), noisy(1.0, 2)), 0.0100, 0.0004);
    EXPECT_NEAR(rms_error_against(noisy(1.0, 3), noisy(1.0, 4)), 0.0100, 0.0006);
    EXPECT_NEAR(rms_error_against(noisy(0.5, 5), noisy(1.0, 6)), 0.0100, 0.0005);
}

TEST(RmsError, IsNeverLessThanHalfOfWhatIsMeasured) {
    const std::vector<Estimate> reference = noisy(1.0, 7);
    EXPECT_NEAR(rms_error_against(reference, noisy(0.0, 8)), 0.5 * 0.0100, 0.0002);
    EXPECT_EQ(rms_error_against(reference, reference), 0.0);
}

TEST(RmsError, CountsTheDarkBesideTheMean) {
    // 2 % of the mean of 50 lx is 1 lx: the dark point's 1 lx too much counts as 100 %.
    const std::vector<Estimate> reference{{100.0, 0.0, 16}, {0.0, 0.0, 16}};
    const std::vector<Estimate> values{{100.0, 0.0, 16}, {1.0, 0.0, 16}};
    EXPECT_NEAR(rms_error_against(reference, values), std::sqrt(0.5), 1e-12);
}

} // namespace
} // namespace isolux
