#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/base/arc_tangent.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ArcTangent, AgreesWithTheLibraryAllAround) {
    for (int i = -200000; i <= 200000; ++i) {
        const double angle = pi * (static_cast<double>(i) + 0.37) / 200001.0;
        const double y = 3.0 * std::sin(angle);
        const double x = 3.0 * std::cos(angle);
        ASSERT_NEAR(arc_tangent(y, x), std::atan2(y, x), 9e-16) << i;
    }
}

TEST(ArcTangent, KeepsSmallAnglesRelativelyExact) {
    for (double y = 1.0; y > 1e-300; y *= 0.37)
        ASSERT_NEAR(arc_tangent(y, 1.0) / std::atan2(y, 1.0), 1.0, 4e-16) << y;
}

TEST(ArcTangent, IsExactOnAxesAndDiagonals) {
    EXPECT_EQ(arc_tangent(0.0, 2.0), 0.0);
    EXPECT_EQ(arc_tangent(2.0, 2.0), pi / 4);
    EXPECT_EQ(arc_tangent(2.0, 0.0), pi / 2);
    EXPECT_EQ(arc_tangent(2.0, -2.0), 3 * pi / 4);
    EXPECT_EQ(arc_tangent(0.0, -2.0), pi);
    EXPECT_EQ(arc_tangent(-2.0, 0.0), -pi / 2);
    EXPECT_EQ(arc_tangent(0.0, 0.0), 0.0);
}

} // namespace
} // namespace isolux
