#include <vector>

#include <gtest/gtest.h>

#include "isolux/sampling/warp.h"
#include "isolux/transport/clear_view.h"

#include "support/random_luminaires.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

using test::NormalDraws;

const std::vector<Point3> panel{{-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0.5, 0.5, 2}, {-0.5, 0.5, 2}};

bool is_clear_past(const Point3& corner, const Vector3& u, const Vector3& v) {
    test::Builder b;
    b.add_room({-5, -5, -0.001}, {5, 5, 2.001}, {}, {}, b.add_diffuse(0.5));
    b.add_quad(corner, u, v, b.add_diffuse(0.5));
    const Scene scene = b.build();
    return ClearView(scene).is_clear({0, 0, 0}, panel);
}

TEST(ClearView, SeesThatNothingIsInTheWay) {
    EXPECT_TRUE(is_clear_past({2, 2, 1}, {1, 0, 0}, {0, 1, 0}));
    // Beside the pyramid, inside its box.
    EXPECT_TRUE(is_clear_past({0.35, 0.35, 0.5}, {0.1, 0, 0}, {0, 0.1, 0}));
}

TEST(ClearView, SeesWhatCutsACorner) {
    EXPECT_FALSE(is_clear_past({0.2, 0.2, 1}, {1, 0, 0}, {0, 1, 0}));
    // Smaller than the pyramid, wholly inside it.
    EXPECT_FALSE(is_clear_past({0.0, 0.0, 1}, {0.01, 0, 0}, {0, 0.01, 0}));
    // Much larger: no corner of it anywhere near.
    EXPECT_FALSE(is_clear_past({-4, -4, 1}, {8, 0, 0}, {0, 8, 0}));
    // Upright, edge on.
    EXPECT_FALSE(is_clear_past({0.1, 0.1, 0.5}, {0, 0, 1}, {0, 1, 0}));
}

TEST(ClearView, KnowsNothingInThePlaneOfThePolygon) {
    test::Builder b;
    b.add_quad({50, 50, 50}, {1, 0, 0}, {0, 1, 0}, b.add_diffuse(0.5));
    const Scene scene = b.build();
    EXPECT_FALSE(ClearView(scene).is_clear({3, 0, 2}, panel));
}

/// What it calls clear no ray finds blocked: random triangles, random quadrilaterals.
TEST(ClearView, IsNeverContradictedByARay) {
    NormalDraws random(5);
    test::Builder b;
    const MaterialId m = b.add_diffuse(0.5);
    for (int i = 0; i < 60; ++i) {
        const Point3 p = test::random_point(random, 4.0);
        b.add_triangle(p,
                       p + 0.7 * Vector3(test::random_direction(random)),
                       p + 0.7 * Vector3(test::random_direction(random)),
                       m);
    }
    const Scene scene = b.build();
    const ClearView view(scene);
    int clear = 0;
    int blocked = 0;
    for (int i = 0; i < 4000; ++i) {
        const Point3 apex = test::random_point(random, 4.0);
        const Point3 corner = test::random_point(random, 4.0);
        const Vector3 u = 0.5 * Vector3(test::random_direction(random));
        const Vector3 v = 0.5 * Vector3(test::random_direction(random));
        const std::vector<Point3> quad{corner, corner + u, corner + u + v, corner + v};
        const bool is_clear = view.is_clear(apex, quad);
        bool is_blocked = false;
        for (int k = 0; k < 20; ++k) {
            const double s = random.uniform();
            const Point3 p = sample_polygon(quad, s, random.uniform());
            is_blocked = is_blocked || scene.caster.transmittance(apex, p) == 0.0;
        }
        EXPECT_FALSE(is_clear && is_blocked) << i;
        clear += is_clear ? 1 : 0;
        blocked += is_blocked ? 1 : 0;
    }
    EXPECT_GT(clear, 500); // both happen often
    EXPECT_GT(blocked, 500);
}

} // namespace
} // namespace isolux
