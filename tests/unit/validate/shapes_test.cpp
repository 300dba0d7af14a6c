#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/validate/lambertian_shapes.h"
#include "isolux/validate/shadow_and_mirror.h"

#include "support/printed.h"

namespace isolux {
namespace {

using std::numbers::pi;

const CandelaPerSquareMetre kilo{1000.0};
const UnitVector3 up = UnitVector3::from_unit({0, 0, 1});

TEST(LambertianShapes, RectanglesGiveTheReferenceCorners) {
    // a, b, c = 1.3, 0.7, 0.9
    EXPECT_NEAR(in_lux(illuminance_from(ParallelRectangle{0, 1.3, 0, 0.7, 0.9}, kilo))
                    / (1000.0 * pi),
                0.1376717531,
                5.1e-11);
    EXPECT_NEAR(in_lux(illuminance_from(PerpendicularRectangle{0, 0.7, 0, 1.3, 0.9}, kilo))
                    / (1000.0 * pi),
                0.0674508883,
                5.1e-11);
}

TEST(LambertianShapes, RectanglesAnywhereEqualThePolygonFormula) {
    for (const auto& [x0, x1, y0, y1] :
         {std::array{-0.5, 0.5, -0.5, 0.5}, {1.0, 3.0, -2.0, -0.3}, {-1.0, 4.0, 0.2, 0.3}}) {
        const std::vector<Point3> ceiling = {
            {x0, y0, 1.7}, {x1, y0, 1.7}, {x1, y1, 1.7}, {x0, y1, 1.7}};
        EXPECT_NEAR(in_lux(illuminance_from(ParallelRectangle{x0, x1, y0, y1, 1.7}, kilo)),
                    in_lux(polygon_illuminance(ceiling, kilo, {0, 0, 0}, up)),
                    1e-9);
        const std::vector<Point3> wall = {
            {1.7, x0, y0}, {1.7, x1, y0}, {1.7, x1, y1}, {1.7, x0, y1}};
        EXPECT_NEAR(in_lux(illuminance_from(PerpendicularRectangle{x0, x1, y0, y1, 1.7}, kilo)),
                    in_lux(polygon_illuminance(wall, kilo, {0, 0, 0}, up)),
                    1e-9);
    }
}

TEST(LambertianShapes, DiscGivesTheReferenceValues) {
    const auto horizontal = [](double h, double x) {
        return in_lux(illuminance_from(LambertianDisc{0.5, h, x}, kilo));
    };
    const auto vertical = [](double h, double x) {
        return in_lux(vertical_illuminance_from(LambertianDisc{0.5, h, x}, kilo));
    };
    EXPECT_TRUE(test::agrees(horizontal(2, 0), 184.79957, 8));
    EXPECT_TRUE(test::agrees(horizontal(2, 0.5), 165.83338, 8));
    EXPECT_TRUE(test::agrees(horizontal(2, 2), 49.829863, 8));
    EXPECT_TRUE(test::agrees(vertical(2, 2), 48.297005, 8));
    EXPECT_TRUE(test::agrees(horizontal(0.5, 0.3), 1292.525, 8));
    EXPECT_TRUE(test::agrees(horizontal(0.5, 1), 165.83338, 8));
    EXPECT_TRUE(test::agrees(vertical(0.5, 1), 268.32405, 8));
    EXPECT_NEAR(horizontal(2, 0), 1000.0 * pi * 0.25 / 4.25, 1e-10); // pi L a2/(a2 + h2)
}

TEST(LambertianShapes, SphereGivesTheReferenceValues) {
    const auto e = [](double h, double tilt) {
        return in_lux(illuminance_from(LambertianSphere{0.2, 0.2 * h, degrees(tilt)}, kilo))
               / (1000.0 * pi);
    };
    EXPECT_TRUE(test::agrees(e(3, 20), 0.10441029, 8));
    EXPECT_TRUE(test::agrees(e(3, 65), 0.046957585, 8));
    EXPECT_TRUE(test::agrees(e(3, 80), 0.020760757, 8)) << e(3, 80);
    EXPECT_TRUE(test::agrees(e(3, 100), 0.0014665154, 8)) << e(3, 100);
    EXPECT_TRUE(test::agrees(e(1.5, 75), 0.14232446, 8)) << e(1.5, 75);
    EXPECT_EQ(e(3, 110), 0.0);
    // Two receivers back to back see the whole sphere: the cut form joins the uncut one.
    EXPECT_NEAR(e(3, 80) - e(3, 100), std::cos(degrees(80).in_radians()) / 9.0, 1e-12);
}

TEST(LambertianShapes, LineGivesTheReferenceValue) {
    const LambertianLine line{0.0, 1.2, 2.0, std::hypot(0.5, 2.0)};
    EXPECT_TRUE(test::agrees(in_lux(illuminance_from(line, 300.0)), 67.900009, 8));
    // Long and straight above: (i0/(2 h)) pi.
    EXPECT_NEAR(in_lux(illuminance_from(LambertianLine{-1e5, 1e5, 2.0, 2.0}, 300.0)),
                300.0 * pi / 4.0,
                1e-6);
}

TEST(Penumbra, GivesTheReferenceValues) {
    const std::vector<Point3> source = {
        {-.25, -.25, 2}, {.25, -.25, 2}, {.25, .25, 2}, {-.25, .25, 2}};
    const OccludingEdge edge{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    const double expected[] = {0,
                               43.055369,
                               97.104754,
                               152.88094,
                               207.53746,
                               258.26374,
                               295.89781,
                               288.54573,
                               279.48146};
    for (int k = 0; k < 9; ++k) {
        const double e = in_lux(penumbra_illuminance(
            source, CandelaPerSquareMetre(5000.0), edge, {0.0875 * (k - 3), 0.05, 0}, up));
        if (k == 0)
            EXPECT_EQ(e, 0.0);
        else
            EXPECT_TRUE(test::agrees(e, expected[k], 8)) << k << ": " << e;
    }
}

const std::vector<Point3> wall_mirror = {{3, -1, 0.5}, {3, 1, 0.5}, {3, 1, 2}, {3, -1, 2}};

TEST(Mirror, ImageOfAPointSourceShinesThroughTheMirror) {
    const FlatMirror mirror{wall_mirror, 0.8};
    const IdealPointSource lamp{
        {1, 0, 2.2}, Lumen(1000.0), UnitVector3::from_unit({0, 0, -1}), {}};
    // Image at (5, 0, 2.2); from (1, 0.4, 0) the ray meets x = 3 half way, at height 1.1.
    const Vector3 d{4, -0.4, 2.2};
    EXPECT_NEAR(in_lux(mirrored_illuminance(lamp, mirror, {1, 0.4, 0}, up)),
                0.8 * 1000.0 / (4.0 * pi) * 2.2 / std::pow(length(d), 3),
                1e-12);
    // From (2.9, 0, 0) it would meet the wall below the mirror's edge; from behind: nothing.
    EXPECT_EQ(in_lux(mirrored_illuminance(lamp, mirror, {2.9, 0, 0}, up)), 0.0);
    EXPECT_EQ(in_lux(mirrored_illuminance(lamp, mirror, {4, 0, 0}, up)), 0.0);
}

TEST(Mirror, TurnsTheAxisOfTheSource) {
    const FlatMirror mirror{wall_mirror, 1.0};
    const UnitVector3 towards(Vector3{1, 0, -0.5});
    const IdealPointSource spot{{1, 0, 2}, Lumen(1000.0), towards, 10.0};
    const IdealPointSource image{
        {5, 0, 2}, Lumen(1000.0), UnitVector3(Vector3{-1, 0, -0.5}), 10.0};
    EXPECT_NEAR(in_lux(mirrored_illuminance(spot, mirror, {0.5, 0.2, 0}, up)),
                in_lux(point_source_illuminance(image, {{0.5, 0.2, 0}, up})),
                1e-12);
}

TEST(Mirror, AreaSourceIsClippedByTheMirror) {
    const std::vector<Point3> panel = {
        {0.5, -0.5, 2.5}, {1.5, -0.5, 2.5}, {1.5, 0.5, 2.5}, {0.5, 0.5, 2.5}};
    const Point3 p{1, 0, 0.5};
    const double whole = in_lux(polygon_illuminance(
        std::vector<Point3>{
            {4.5, -0.5, 2.5}, {5.5, -0.5, 2.5}, {5.5, 0.5, 2.5}, {4.5, 0.5, 2.5}},
        kilo,
        p,
        up));
    // Seen from p the mirror's upper edge stands at (2 - 0.5)/2, the image between 2/4.5 and
    // 2/3.5.
    EXPECT_NEAR(in_lux(mirrored_illuminance(panel, kilo, {wall_mirror, 0.9}, p, up)),
                0.9 * whole,
                1e-10);
    // A mirror that ends half way up shows the far half: up to 2/4 at x = 5.
    const std::vector<Point3> low = {{3, -1, 0.5}, {3, 1, 0.5}, {3, 1, 1.5}, {3, -1, 1.5}};
    const double half = in_lux(polygon_illuminance(
        std::vector<Point3>{{5, -0.5, 2.5}, {5.5, -0.5, 2.5}, {5.5, 0.5, 2.5}, {5, 0.5, 2.5}},
        kilo,
        p,
        up));
    EXPECT_NEAR(
        in_lux(mirrored_illuminance(panel, kilo, {low, 0.9}, p, up)), 0.9 * half, 1e-10);
}

} // namespace
} // namespace isolux
