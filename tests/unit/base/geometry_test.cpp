#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/angle.h"
#include "isolux/base/colour.h"
#include "isolux/base/frame.h"
#include "isolux/base/units.h"
#include "isolux/base/vec.h"

#include "support/normal_draws.h"

namespace isolux {
namespace {

void expect_near(const Vector3& a, const Vector3& b, double tolerance = 1e-14) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

std::vector<UnitVector3> directions() {
    std::vector<UnitVector3> all{UnitVector3{},
                                 -UnitVector3{},
                                 UnitVector3({1, 0, 0}),
                                 UnitVector3({1e-9, 0, -1}),
                                 UnitVector3({0, 1e-9, -1})};
    test::NormalDraws normal(1);
    for (int i = 0; i < 200; ++i)
        all.emplace_back(Vector3{normal(), normal(), normal()});
    return all;
}

TEST(UnitVector, IsNormalisedAndTheZeroVectorHasADefault) {
    EXPECT_NEAR(length(UnitVector3({3, -4, 12})), 1.0, 1e-15);
    expect_near(UnitVector3({3, -4, 12}), {3.0 / 13, -4.0 / 13, 12.0 / 13});
    expect_near(UnitVector3({0, 0, 0}), {0, 0, 1});
}

TEST(Basis, IsRightHandedAndOrthonormalForEveryNormal) {
    for (const UnitVector3& n : directions()) {
        const Basis b = make_basis(n);
        expect_near(cross(b.t, b.b), n, 1e-12);
        EXPECT_NEAR(length(b.t), 1.0, 1e-12);
        EXPECT_NEAR(dot(b.t, b.n), 0.0, 1e-12);
        expect_near(b.to_local(b.to_world({1, 2, 3})), {1, 2, 3}, 1e-11);
    }
}

TEST(Rotation, TurnsCounterClockwiseSeenFromTheTipOfTheAxis) {
    const UnitVector3 z;
    expect_near(rotate(Vector3{1, 0, 0}, z, degrees(90)), {0, 1, 0});
    expect_near(rotate(Vector3{0, 1, 0}, UnitVector3({1, 0, 0}), degrees(90)), {0, 0, 1});
    expect_near(rotate(Vector3{1, 2, 3}, UnitVector3({1, 1, 1}), degrees(120)), {3, 1, 2});
}

TEST(FramePlacement, GoesToTheWorldAndBack) {
    const Frame f = rotate(Frame{{10, 20, 30}}, UnitVector3({1, 2, -1}), degrees(77));
    const Point3 p = f.point_from_local({1, 2, 3});
    expect_near(f.point_to_local(p), {1, 2, 3}, 1e-12);
    EXPECT_NEAR(distance(p, f.origin), std::sqrt(14.0), 1e-12);
    const Frame quarter = rotate(Frame{}, UnitVector3{}, degrees(90));
    expect_near(quarter.vector_from_local({1, 0, 0}), {0, 1, 0});
}

TEST(Colour, GreyIsItsOwnLuminance) {
    for (const double v : {0.0, 0.1, 0.5, 0.93, 1.0})
        EXPECT_NEAR(luminance_sum(Rgb::grey(v)), v, 1e-15);
    EXPECT_NEAR(luminance_sum({1, 0, 0}), 0.2126, 1e-15);
    EXPECT_NEAR(luminance_sum({0, 0, 1}), 0.0722, 1e-15);
    EXPECT_TRUE(is_grey(Rgb::grey(0.3)));
    EXPECT_FALSE(is_grey({0.3, 0.3, 0.2}));
    EXPECT_EQ(max_channel({0.1, 0.7, 0.3}), 0.7);
}

TEST(Units, CarryTheProductsOfPhotometry) {
    const Lux e = Candela(900.0) / (Metre(3.0) * Metre(3.0));
    EXPECT_DOUBLE_EQ(in_lux(e), 100.0);
    EXPECT_DOUBLE_EQ(in_lux(Lumen(500.0) / SquareMetre(2.0)), 250.0);
    EXPECT_DOUBLE_EQ(in_lumen(Candela(2.0) * Steradian(3.0)), 6.0);
    EXPECT_DOUBLE_EQ(in_candela_per_square_metre(luminance_of(Candela(10.0), SquareMetre(0.5))),
                     20.0);
    EXPECT_DOUBLE_EQ(Lux(3.0) / Lux(2.0), 1.5);
    EXPECT_LT(Lux(1.0), Lux(2.0));
}

TEST(AngleUnits, ConvertBothWays) {
    EXPECT_DOUBLE_EQ(degrees(180).in_radians(), std::acos(-1.0));
    EXPECT_DOUBLE_EQ(radians(0.5).in_degrees(), 28.64788975654116);
    EXPECT_EQ(degrees(30) + degrees(60), degrees(90));
}

} // namespace
} // namespace isolux
