#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/polygon.h"

namespace isolux {
namespace {

using std::numbers::pi;

constexpr double accuracy = 1e-9; // METHODS "Closed answers", rows 4 to 6

UnitVector3 unit(double x, double y, double z) { return UnitVector3(Vector3{x, y, z}); }

double illuminance(const std::vector<Point3>& polygon, const Point3& p, const UnitVector3& n) {
    return 1000.0 * projected_solid_angle(polygon, p, n); // L = 1000 cd/m2
}

// Element under a corner of a parallel rectangle a x b at distance c, and at the foot corner of
// a wall b wide and a high at distance c: METHODS "Closed answers", rows 4 and 5.
double parallel_corner(double a, double b, double c) {
    const double A = a / c;
    const double B = b / c;
    return 0.5
           * (A / std::hypot(1.0, A) * std::atan(B / std::hypot(1.0, A))
              + B / std::hypot(1.0, B) * std::atan(A / std::hypot(1.0, B)));
}

double perpendicular_corner(double a, double b, double c) {
    return 0.5 * (std::atan(b / c) - c / std::hypot(a, c) * std::atan(b / std::hypot(a, c)));
}

TEST(ProjectedSolidAngle, EqualsTheCornerFormulaOfAParallelRectangle) {
    for (const auto& [a, b, c] :
         {std::array{1.3, 0.7, 0.9}, {0.01, 3.0, 2.0}, {50.0, 80.0, 0.1}}) {
        const std::vector<Point3> r = {{0, 0, c}, {a, 0, c}, {a, b, c}, {0, b, c}};
        const double expected = parallel_corner(a, b, c);
        EXPECT_NEAR(
            projected_solid_angle(r, {0, 0, 0}, unit(0, 0, 1)), expected, accuracy * expected);
    }
    EXPECT_NEAR(parallel_corner(1.3, 0.7, 0.9) / pi, 0.1376717531, 5e-11);
}

TEST(ProjectedSolidAngle, EqualsTheCornerFormulaOfAPerpendicularRectangle) {
    for (const auto& [a, b, c] :
         {std::array{1.3, 0.7, 0.9}, {0.01, 3.0, 2.0}, {50.0, 80.0, 0.1}}) {
        const std::vector<Point3> r = {{c, 0, 0}, {c, b, 0}, {c, b, a}, {c, 0, a}};
        const double expected = perpendicular_corner(a, b, c);
        EXPECT_NEAR(
            projected_solid_angle(r, {0, 0, 0}, unit(0, 0, 1)), expected, accuracy * expected);
    }
    EXPECT_NEAR(perpendicular_corner(1.3, 0.7, 0.9) / pi, 0.0674508883, 5e-11);
}

TEST(ProjectedSolidAngle, CountsOnlyWhatIsAboveTheHorizon) {
    // A wall that reaches 2 m below the receiver counts from the receiver's level up.
    const double a = 1.3, b = 0.7, c = 0.9;
    const std::vector<Point3> r = {{c, 0, -2}, {c, b, -2}, {c, b, a}, {c, 0, a}};
    const double expected = perpendicular_corner(a, b, c);
    EXPECT_NEAR(projected_solid_angle(r, {0, 0, 0}, unit(0, 0, 1)), expected, accuracy);
    // Wherever the walk around the outline begins, and in either sense.
    for (std::size_t turn = 0; turn < 4; ++turn) {
        std::vector<Point3> turned = r;
        std::rotate(turned.begin(), turned.begin() + static_cast<long>(turn), turned.end());
        EXPECT_NEAR(
            projected_solid_angle(turned, {0, 0, 0}, unit(0, 0, 1)), expected, accuracy);
        std::reverse(turned.begin(), turned.end());
        EXPECT_NEAR(
            projected_solid_angle(turned, {0, 0, 0}, unit(0, 0, 1)), expected, accuracy);
    }
    EXPECT_EQ(projected_solid_angle(r, {0, 0, 3}, unit(0, 0, 1)), 0.0);
    EXPECT_EQ(projected_solid_angle(r, {0, 0, 0}, unit(-1, 0, 0)), 0.0);
}

struct Case {
    Point3 point;
    Vector3 normal;
    double square;
    double triangle;
};

// Independent reference values, lx, luminance 1000 cd/m2, 9 digits.
TEST(ProjectedSolidAngle, GivesTheReferenceValuesOfASquareAndATriangle) {
    const std::vector<Point3> square = {
        {-.5, -.5, 2.5}, {.5, -.5, 2.5}, {.5, .5, 2.5}, {-.5, .5, 2.5}};
    const std::vector<Point3> triangle = {{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
    const Case cases[] = {
        {{0, 0, .8}, {0, 0, 1}, 310.40147, 238.488171},
        {{.6, .3, .8}, {0, 0, 1}, 244.023344, 280.109191},
        {{2, 1, 0}, {0, 0, 1}, 49.8471748, 38.1382729},
        {{1.5, .4, 1}, {-1, 0, 0}, 100.025791, 100.151789},
        {{.2, .1, .6}, {1, 0, 0}, 6.09744794, 25.2634233},
        {{.2, .1, .6}, {.6, 0, .8}, 183.943167, 184.972918},
        // normals to more digits than the six printed: (-3, 5, 1), (-1, 2, 4/3)
        {{.9, .7, 1.5}, {-3, 5, 1}, 28.6868199, 55.6305939},
        {{.1, -.2, 1.9}, {-3, 6, 4}, 924.471186, 260.569403},
    };
    for (const Case& c : cases) {
        const UnitVector3 n(c.normal);
        EXPECT_NEAR(illuminance(square, c.point, n), c.square, 6e-9 * c.square);
        EXPECT_NEAR(illuminance(triangle, c.point, n), c.triangle, 6e-9 * c.triangle);
    }
}

TEST(ProjectedSolidAngle, AddsUpOverTheParts) {
    // An L of three squares is what its two rectangles are, although it is not convex and its
    // notch crosses the horizon of a tilted receiver.
    const std::vector<Point3> l = {
        {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};
    const std::vector<Point3> lower = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1}};
    const std::vector<Point3> upper = {{0, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};
    const Point3 p{0.8, 0.7, 0.3};
    for (const UnitVector3& n : {unit(0, 0, 1),
                                 unit(1, 0.2, 0.1),
                                 unit(-1, -1, 0.2),
                                 unit(1, 1, -0.3),
                                 unit(0.3, -1, 0.05),
                                 unit(-0.2, 0.9, 0)})
        EXPECT_NEAR(projected_solid_angle(l, p, n),
                    projected_solid_angle(lower, p, n) + projected_solid_angle(upper, p, n),
                    1e-12);
}

TEST(ProjectedSolidAngle, OfAHugeCeilingIsPi) {
    const std::vector<Point3> sky = {
        {-1e6, -1e6, 1}, {1e6, -1e6, 1}, {1e6, 1e6, 1}, {-1e6, 1e6, 1}};
    EXPECT_NEAR(projected_solid_angle(sky, {0, 0, 0}, unit(0, 0, 1)), pi, 1e-9);
    EXPECT_NEAR(projected_solid_angle(sky, {0, 0, 0}, unit(1, 0, 0)), pi / 2, 1e-5);
}

TEST(ProjectedSolidAngle, IsFiniteInEveryDegeneratePosition) {
    const std::vector<Point3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(projected_solid_angle(square, {2, 2, 0}, unit(0, 0, 1)), 0.0); // in its plane
    EXPECT_EQ(projected_solid_angle(square, {-1, 0, 0}, unit(0, 0, 1)),
              0.0); // and on an edge's line
    for (const Point3& p : square)
        EXPECT_TRUE(std::isfinite(projected_solid_angle(square, p, unit(1, 1, 1))));
    EXPECT_TRUE(std::isfinite(projected_solid_angle(square, {0.5, 0, 0}, unit(0, 1, 1))));
    EXPECT_EQ(projected_solid_angle(std::vector<Point3>{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}},
                                    {0, 0, 0},
                                    unit(0, 0, 1)),
              0.0);
    EXPECT_EQ(projected_solid_angle({}, {0, 0, 0}, unit(0, 0, 1)), 0.0);
}

TEST(ProjectedSolidAngle, OfATinyFarPolygonIsAreaTimesCosinesOverSquaredDistance) {
    constexpr double s = 1e-4;
    const std::vector<Point3> square = {{100, 0, 0}, {100, s, 0}, {100, s, s}, {100, 0, s}};
    // The terms of the formula are angles of s/d = 1e-6, each with a rounding error of 1e-16.
    EXPECT_NEAR(projected_solid_angle(square, {0, s / 2, s / 2}, unit(0.6, 0.8, 0)),
                s * s / 1e4 * 0.6,
                2e-15);
}

TEST(ClipToHalfSpace, KeepsTheSideOfTheNormal) {
    const std::vector<Point3> square = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    const std::vector<Point3> half = clip_to_half_space(square, {0.5, 0, 0}, {1, 0, 0});
    EXPECT_EQ(half, (std::vector<Point3>{{0.5, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0.5, 2, 0}}));
    EXPECT_EQ(clip_to_half_space(square, {-1, 0, 0}, {1, 0, 0}), square);
    EXPECT_TRUE(clip_to_half_space(square, {3, 0, 0}, {1, 0, 0}).empty());
    EXPECT_EQ(clip_to_half_space(square, {0, 0, 0}, {0, 0, 1}), square); // all on the plane
}

TEST(ClipToHalfSpace, OfACornerIsATriangleAndOfATouchIsNothing) {
    const std::vector<Point3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(clip_to_half_space(square, {0.5, 0, 0}, {-1, -1, 0}),
              (std::vector<Point3>{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}));
    EXPECT_TRUE(clip_to_half_space(square, {0, 0, 0}, {-1, -1, 0}).empty()); // one corner
    EXPECT_TRUE(clip_to_half_space(square, {0, 0, 0}, {-1, 0, 0}).empty());  // one edge
}

} // namespace
} // namespace isolux
