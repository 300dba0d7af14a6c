#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/measure/camera.h"

namespace isolux::test {
namespace {

constexpr double pi = std::numbers::pi;

Camera looking_north() {
    Camera c;
    c.position = {1, 2, 3};
    c.target = {1, 6, 3};
    c.field_of_view = degrees(90);
    c.columns = 200;
    c.rows = 100;
    return c;
}

double angle_between(const Vector3& a, const Vector3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

TEST(Camera, LooksAtItsTargetInTheMiddleOfThePicture) {
    const CameraRays rays(looking_north());
    const auto line = rays.sight_line(100, 50);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->direction.y(), 1.0, 1e-15);
    EXPECT_EQ(line->eye, (Point3{1, 2, 3}));
}

TEST(Camera, HasRightOnTheRightAndUpAtTheTop) {
    const CameraRays rays(looking_north());
    EXPECT_GT(rays.sight_line(150, 50)->direction.x(), 0.1); // east
    EXPECT_GT(rays.sight_line(100, 10)->direction.z(), 0.1);
}

TEST(Camera, SpansItsFieldOfViewAcrossTheWidth) {
    const CameraRays rays(looking_north());
    const auto left = rays.sight_line(0, 50);
    const auto right = rays.sight_line(200, 50);
    EXPECT_NEAR(angle_between(left->direction, right->direction), pi / 2, 1e-12);
    // square pixels: a picture half as high shows 2 atan(1/2) upright
    const auto top = rays.sight_line(100, 0);
    EXPECT_NEAR(angle_between(top->direction, rays.forward()), std::atan(0.5), 1e-12);
}

TEST(Camera, PutsNorthAtTheTopOfAPlan) {
    Camera c = looking_north();
    c.projection = Projection::orthographic;
    c.position = {4, 3, 2.5};
    c.target = {4, 3, 0};
    c.width = 8.0;
    const CameraRays rays(c);
    const auto corner = rays.sight_line(0, 0);
    EXPECT_NEAR(corner->eye.x, 0.0, 1e-12);
    EXPECT_NEAR(corner->eye.y, 5.0, 1e-12);
    EXPECT_NEAR(corner->eye.z, 2.5, 1e-12);
    EXPECT_NEAR(corner->direction.z(), -1.0, 1e-15);
}

class Fisheye : public testing::TestWithParam<Projection> {};

TEST_P(Fisheye, ReachesItsFieldOfViewAtTheRimAndNothingBeyond) {
    Camera c = looking_north();
    c.projection = GetParam();
    c.field_of_view = degrees(170);
    const CameraRays rays(c);
    const auto rim = rays.sight_line(150 - 1e-9, 50);
    ASSERT_TRUE(rim);
    EXPECT_NEAR(angle_between(rim->direction, rays.forward()), 85.0 / 180 * pi, 1e-6);
    EXPECT_FALSE(rays.sight_line(151, 50));
    EXPECT_FALSE(rays.sight_line(140, 90));
}

INSTANTIATE_TEST_SUITE_P(Projections,
                         Fisheye,
                         testing::Values(Projection::equidistant,
                                         Projection::equal_area,
                                         Projection::stereographic));

TEST(Camera, OfEqualAreaGivesPixelsTheSameSolidAngle) {
    Camera c = looking_north();
    c.projection = Projection::equal_area;
    c.field_of_view = degrees(180);
    const CameraRays rays(c);
    // solid angle of a small pixel from its two sides
    const auto size = [&](double x, double y) {
        const Vector3 a = rays.sight_line(x, y)->direction;
        const Vector3 dx = Vector3(rays.sight_line(x + 1e-3, y)->direction) - a;
        const Vector3 dy = Vector3(rays.sight_line(x, y + 1e-3)->direction) - a;
        return length(cross(dx, dy));
    };
    EXPECT_NEAR(size(135, 70) / size(101, 51), 1.0, 1e-3);
}

TEST(Camera, OfEqualDistanceHasAnglesInProportionToTheRadius) {
    Camera c = looking_north();
    c.projection = Projection::equidistant;
    c.field_of_view = degrees(180);
    const CameraRays rays(c);
    EXPECT_NEAR(angle_between(rays.sight_line(120, 50)->direction, rays.forward()),
                0.4 * pi / 2,
                1e-12);
}

TEST(Camera, WithALensShowsThePlaneOfFocusSharp) {
    Camera c = looking_north();
    c.lens_radius = 0.1;
    c.focus_distance = 2.0;
    const CameraRays rays(c);
    const auto a = rays.sight_line(130, 40, 0.1, 0.8);
    const auto b = rays.sight_line(130, 40, 0.9, 0.3);
    EXPECT_GT(distance(a->eye, b->eye), 0.05);
    const auto at_focus = [&](const SightLine& s) {
        return s.eye + (2.0 / dot(s.direction, rays.forward())) * Vector3(s.direction);
    };
    EXPECT_NEAR(distance(at_focus(*a), at_focus(*b)), 0.0, 1e-12);
}

TEST(Camera, ShiftsWhatIsOutOfFocusByTheLensEquation) {
    Camera c = looking_north();
    c.lens_radius = 0.1;
    c.focus_distance = 2.0;
    const CameraRays rays(c);
    EXPECT_NEAR(rays.lens_shift(2.0), 0.0, 1e-15);
    // A place at depth 1 seen from the lens's rim: where does it fall on the picture?
    // Half width of the picture at the focus: 2 m for 100 pixels. From the rim the ray through
    // it meets the plane of focus 0.1 m beyond the axis: 5 pixels.
    EXPECT_NEAR(rays.lens_shift(1.0), 5.0, 1e-12);
    EXPECT_LT(rays.lens_shift(4.0), 0.0);
}

TEST(Camera, TakesPlacesOnTheLensUniformly) {
    Camera c = looking_north();
    c.lens_radius = 1.0;
    const CameraRays rays(c);
    constexpr int n = 64;
    int inside = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const auto s = rays.sight_line(100, 50, (i + 0.5) / n, (j + 0.5) / n);
            const double r = distance(s->eye, c.position);
            EXPECT_LE(r, 1.0 + 1e-12);
            inside += r < std::sqrt(0.5) ? 1 : 0;
        }
    EXPECT_NEAR(inside, n * n / 2, 2 * n); // concentric squares: exact to a ring of cells
}

} // namespace
} // namespace isolux::test
