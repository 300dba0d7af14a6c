#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/io/outline.h"

namespace isolux {
namespace {

std::vector<Point2> rectangle(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(Outline, RoundOnesHaveTheCirclesArea) {
    const auto outline = make_round_outline({1, 2}, 0.5, 24);

    EXPECT_EQ(outline.size(), 24U);
    EXPECT_NEAR(signed_area(outline), std::numbers::pi * 0.0625, 1e-14);
}

TEST(Outline, InsetKeepsItsDistance) {
    const std::vector<Point2> l{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {0, 2}};
    const auto inset = make_inset(l, 0.5);

    ASSERT_EQ(inset.size(), 6U);
    EXPECT_NEAR(inset[0].x, 0.5, 1e-12);
    EXPECT_NEAR(inset[4].x, 2.5, 1e-12); // the corner that points inwards moves out of the way
    EXPECT_NEAR(inset[4].y, 1.5, 1e-12);
    EXPECT_NEAR(border_distance(l, inset), 0.5, 1e-12);
    EXPECT_TRUE(make_inset(l, 1.5).empty());
    EXPECT_EQ(make_inset(l, 0.0), l);
}

TEST(Outline, TouchingIsNotOverlapping) {
    const auto a = rectangle(0, 0, 6, 4);

    EXPECT_FALSE(do_overlap(a, rectangle(6, 0, 9, 4)));
    EXPECT_FALSE(do_overlap(a, rectangle(6, 2, 9, 8)));
    EXPECT_FALSE(do_overlap(a, rectangle(6, 4, 9, 8)));
    EXPECT_FALSE(do_overlap(a, rectangle(5.9999, 0, 9, 4)));
    EXPECT_FALSE(do_overlap(a, rectangle(7, 0, 9, 4)));
}

TEST(Outline, OverlappingIsSeenInEveryForm) {
    const auto a = rectangle(0, 0, 6, 4);

    EXPECT_TRUE(do_overlap(a, a));
    EXPECT_TRUE(do_overlap(a, rectangle(5.9, 0, 9, 4))); // a strip along a common line
    EXPECT_TRUE(do_overlap(a, rectangle(1, 1, 2, 2)));   // one inside the other
    EXPECT_TRUE(do_overlap(rectangle(1, 1, 2, 2), a));
    EXPECT_TRUE(do_overlap(a, rectangle(2, -1, 3, 5))); // a cross
    EXPECT_TRUE(do_overlap(a, {{3, -1}, {7, 2}, {3, 5}}));
    EXPECT_TRUE(do_overlap(a, rectangle(0, 0, 6, 5)));
}

TEST(Outline, BorderDistanceIsZeroWhereTheyCross) {
    EXPECT_EQ(border_distance(rectangle(0, 0, 2, 2), rectangle(1, 1, 3, 3)), 0.0);
    EXPECT_DOUBLE_EQ(border_distance(rectangle(0, 0, 1, 1), rectangle(2, 0, 3, 1)), 1.0);
    EXPECT_DOUBLE_EQ(distance_to_border({0.5, 0.25}, rectangle(0, 0, 1, 1)), 0.25);
}

} // namespace
} // namespace isolux
