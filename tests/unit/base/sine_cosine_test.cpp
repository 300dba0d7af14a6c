#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/base/sine_cosine.h"

namespace isolux {
namespace {

constexpr long double two_pi = 2.0L * std::numbers::pi_v<long double>;

TEST(SineCosine, AgreesWithTheLibraryOverSomeTurns) {
    for (int i = -300000; i <= 300000; ++i) {
        const double turns = static_cast<double>(i) / 99991.0;
        const SineCosine own = sine_cosine(turns);
        ASSERT_LT(std::abs(own.sine - std::sin(two_pi * turns)), 2.5e-16L) << turns;
        ASSERT_LT(std::abs(own.cosine - std::cos(two_pi * turns)), 2.5e-16L) << turns;
    }
}

TEST(SineCosine, KeepsSmallSinesRelativelyExact) {
    for (double turns = 0.1; turns > 1e-300; turns *= 0.37) {
        const long double exact = std::sin(two_pi * turns);
        ASSERT_LT(std::abs(sine_cosine(turns).sine / exact - 1.0L), 4e-16L) << turns;
        ASSERT_LT(std::abs(sine_cosine(-turns).sine / exact + 1.0L), 4e-16L) << turns;
    }
}

TEST(SineCosine, IsExactAtQuarterTurns) {
    for (int quarter = -9; quarter <= 9; ++quarter) {
        const SineCosine own = sine_cosine(0.25 * quarter);
        EXPECT_EQ(own.sine, std::round(std::sin(std::numbers::pi / 2 * quarter)));
        EXPECT_EQ(own.cosine, std::round(std::cos(std::numbers::pi / 2 * quarter)));
    }
}

} // namespace
} // namespace isolux
