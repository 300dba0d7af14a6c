// METHODS "Photometer head": what the estimator gives is the mean over the disc, to the last
// percent, also where it differs from the value at the point.

#include <numbers>

#include <gtest/gtest.h>

#include "isolux/transport/photometer_head.h"

#include "support/replicates.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

constexpr double flux = 3000.0;
constexpr Point3 source{0.5, 0.1, 0.4};

/// A dark floor at the foot of a wall that a near source lights: the reflected part falls
/// steeply from the wall.
Scene bright_wall() {
    test::Builder b;
    b.add_quad({0, -2, 0}, {3, 0, 0}, {0, 4, 0}, b.add_diffuse(0.1));
    b.add_quad({0, -2, 0}, {0, 4, 0}, {0, 0, 3}, b.add_diffuse(0.8));
    b.add_point(source, b.add_isotropic_type(flux));
    return b.build();
}

/// Straight from the source: exact and without noise, and averaged by nobody.
double direct(const Receiver& r) {
    const Vector3 d = source - r.point;
    const double l2 = length_squared(d);
    return flux / (4.0 * pi) * dot(r.axis, d) / (l2 * std::sqrt(l2));
}

/// Points spread evenly over a disc (a sunflower).
std::vector<Receiver> spread(const Receiver& middle, double radius, std::size_t n) {
    std::vector<Receiver> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double r =
            radius * std::sqrt((static_cast<double>(i) + 0.5) / static_cast<double>(n));
        const double phi = static_cast<double>(i) * pi * (3.0 - std::sqrt(5.0));
        Receiver p = middle;
        p.point = p.point + Vector3{r * std::cos(phi), r * std::sin(phi), 0.0};
        points.push_back(p);
    }
    return points;
}

TEST(PhotometerHead, GivesTheMeanOverItsDiscAndNotTheValueAtItsMiddle) {
    const Scene scene = bright_wall();
    const Receiver middle{{0.1, 0.1, 0.0}, UnitVector3({0, 0, 1})};
    constexpr double radius = 0.09;
    Settings settings;
    settings.fixed_units = 32;
    settings.estimator = Estimator::photometer_head;
    settings.photometer_head_radius = radius;
    const std::vector<Receiver> one{middle};
    Estimate head = test::sample(scene, one, settings, 1).mean();
    const std::vector<Receiver> disc = spread(middle, radius, 64);
    Estimate mean = test::sample(scene, disc, Estimator::path_tracing, 16, 11).mean();
    Estimate point = test::sample(scene, one, Estimator::path_tracing, 256, 21).mean();
    head.mean -= direct(middle);
    point.mean -= direct(middle);
    for (const Receiver& r : disc)
        mean.mean -= direct(r) / static_cast<double>(disc.size());
    EXPECT_LT(std::abs(test::z_score(head, mean)), test::z_limit)
        << head.mean << " +- " << head.standard_error << " against " << mean.mean << " +- "
        << mean.standard_error;
    EXPECT_LT(head.standard_error, 0.005 * head.mean);
    // The difference to the point is there to be seen: it is what the results warn of.
    EXPECT_GT(std::abs(test::z_score(point, mean)), test::z_limit)
        << point.mean << " +- " << point.standard_error << ", mean " << mean.mean;
}

TEST(PhotometerHead, HasTheAreaOfTheDisc) {
    const Scene scene = bright_wall();
    const PhotometerHead head =
        make_photometer_head(scene, {{1.5, 0, 0.8}, UnitVector3({0, 0, 1})}, 0.1);
    EXPECT_NEAR(head.area, pi * 0.01, 1e-12);
    EXPECT_FALSE(head.is_cut);
}

TEST(PhotometerHead, IsCutByAWallAndWhereItsSurfaceEnds) {
    const Scene scene = bright_wall();
    const UnitVector3 up({0, 0, 1});
    // Half of the head would stand in the wall, half of the other one over the floor's end.
    for (const double x : {1e-4, 3.0 - 1e-4}) {
        const PhotometerHead head = make_photometer_head(scene, {{x, 0, 0}, up}, 0.1);
        EXPECT_TRUE(head.is_cut);
        EXPECT_NEAR(head.area, 0.5 * pi * 0.01, 0.01 * pi * 0.01) << x;
        for (const Point3& p : head.outline) {
            EXPECT_GE(p.x, -1e-6);
            EXPECT_LE(p.x, 3.0 + 1e-6);
        }
    }
}

TEST(PhotometerHead, SaysSoInTheResults) {
    const Scene scene = bright_wall();
    CalculationSurface surface;
    surface.receivers = {
        {{1e-3, 0.1, 0.0}, UnitVector3({0, 0, 1})},
        {{1.0, 0.1, 0.5}, UnitVector3({0, 0, 1}), IlluminanceKind::cylindrical}};
    Settings settings;
    settings.fixed_units = 1;
    settings.estimator = Estimator::photometer_head;
    const Results results = calculate(scene, {&surface, 1}, settings);
    ASSERT_EQ(results.notices.size(), 1U);
    EXPECT_EQ(results.notices[0].what,
              "reflected light is the mean over a photometer head of radius 10 mm, not the "
              "value at the point (the difference is r^2/8 times the Laplacian of E); points "
              "whose head an edge cuts, where it grows like r: 1; points that are no planes "
              "and have no head: 1");
}

} // namespace
} // namespace isolux
