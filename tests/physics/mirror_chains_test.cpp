// METHODS "Planar mirrors": light over chains of mirrors, of which only some have images.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/polygon.h"
#include "isolux/calc/calculate.h"

#include "support/test_scene.h"

namespace isolux {
namespace {

constexpr double z_limit = 7.0; // METHODS 7.1
constexpr double side = 3.0;    // m, of the room
constexpr double reflectance = 0.6;
constexpr double flux = 3000.0;         // lm
constexpr Point3 panel{0.8, 1.0, 2.95}; // its lower corner
constexpr double panel_side = 0.4;      // m
constexpr std::size_t sheets_of_many = 60;

/// A black room with four mirrored walls and a panel; `sheets` mirrors as large as the walls
/// stand outside, where they do nothing but make chains too many to image: those of two
/// reflections that end at the first pair of walls have images, those at the other have none.
Scene hall_of_mirrors(std::size_t sheets) {
    test::Builder b;
    const MaterialId black = b.add_diffuse(0.0);
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb{}, reflectance}, Sides::both});
    b.add_quad({0, 0, 0}, {0, side, 0}, {0, 0, side}, mirror);
    b.add_quad({side, 0, 0}, {0, 0, side}, {0, side, 0}, mirror);
    for (std::size_t k = 0; k < sheets; ++k)
        b.add_quad(
            {10.0 + 0.1 * static_cast<double>(k), 0, 0}, {0, side, 0}, {0, 0, side}, mirror);
    b.add_quad({0, 0, 0}, {0, 0, side}, {side, 0, 0}, mirror);
    b.add_quad({0, side, 0}, {side, 0, 0}, {0, 0, side}, mirror);
    b.add_quad({0, 0, 0}, {side, 0, 0}, {0, side, 0}, black);
    b.add_quad({0, 0, side}, {0, side, 0}, {side, 0, 0}, black);
    b.add_panel(panel, {0, panel_side, 0}, {panel_side, 0, 0}, flux);
    return b.build();
}

/// Where the image of a coordinate range [low, low + panel_side] begins that |i| reflections at
/// two parallel mirrors make.
double image_of(double low, int i) {
    return i % 2 == 0 ? side * i + low : side * (i + 1) - low - panel_side;
}

/// Closed form: the panel and its images in both pairs of walls, a lattice.
double illuminance(const Point3& at) {
    constexpr int farthest = 40;
    const double luminance = flux / (std::numbers::pi * panel_side * panel_side);
    double sum = 0.0;
    for (int i = -farthest; i <= farthest; ++i)
        for (int j = -farthest; j <= farthest; ++j) {
            const double x = image_of(panel.x, i);
            const double y = image_of(panel.y, j);
            const std::vector<Point3> corners{{x, y, panel.z},
                                              {x, y + panel_side, panel.z},
                                              {x + panel_side, y + panel_side, panel.z},
                                              {x + panel_side, y, panel.z}};
            sum += std::pow(reflectance, std::abs(i) + std::abs(j)) * luminance
                   * projected_solid_angle(corners, at, UnitVector3::from_unit({0, 0, 1}));
        }
    return sum;
}

class MirrorChains : public testing::TestWithParam<std::pair<Estimator, std::size_t>> {};

TEST_P(MirrorChains, BringWhatTheLatticeOfImagesBrings) {
    const auto [estimator, sheets] = GetParam();
    const Scene scene = hall_of_mirrors(sheets);
    CalculationSurface surface;
    for (const double x : {0.4, 1.5, 2.8})
        surface.receivers.push_back({{x, 0.7 * x, 0.1}, UnitVector3::from_unit({0, 0, 1})});
    Settings settings;
    settings.estimator = estimator;
    // Whose rays find openings seldom needs more of them.
    settings.fixed_units = estimator == Estimator::bidirectional ? 1536 : 128;
    settings.seed = 5;
    const Results results = calculate(scene, {&surface, 1}, settings);
    for (std::size_t p = 0; p < surface.receivers.size(); ++p) {
        const Estimate& e = results.surfaces[0].points[p].total;
        const double right = illuminance(surface.receivers[p].point);
        EXPECT_LT(std::abs(e.mean - right), z_limit * e.standard_error + 1e-4 * right) << p;
        EXPECT_LT(e.standard_error, 0.01 * right) << p; // or the test could not see a bias
    }
}

INSTANTIATE_TEST_SUITE_P(Estimators,
                         MirrorChains,
                         testing::Values(std::pair{Estimator::automatic, std::size_t{0}},
                                         std::pair{Estimator::automatic, sheets_of_many},
                                         std::pair{Estimator::path_tracing, sheets_of_many},
                                         std::pair{Estimator::bidirectional, sheets_of_many}));

/// What a run says of a point source or a panel over a floor and between walls that mirror.
std::vector<Message>
notices_of(double mirror_of_floor, double mirror_of_walls, bool is_point, bool direct_only) {
    test::Builder b;
    const auto glossy = [&](double mirror) {
        return b.add_material({"glossy", Opaque{Rgb::grey(0.4), mirror}, Sides::both});
    };
    b.add_room({0, 0, 0},
               {4, 3, 2.5},
               glossy(mirror_of_floor),
               b.add_diffuse(0.5),
               glossy(mirror_of_walls));
    if (is_point)
        b.add_point({2, 1.5, 2}, b.add_isotropic_type(1000.0));
    else
        b.add_panel({2, 1.5, 2}, {0, 0.3, 0}, {0.3, 0, 0}, 1000.0);
    const Scene scene = b.build();
    CalculationSurface surface;
    surface.receivers = {{{1, 1, 0.75}, UnitVector3::from_unit({0, 0, 1})}};
    Settings settings;
    settings.fixed_units = 1;
    settings.direct_only = direct_only;
    return calculate(scene, {&surface, 1}, settings).notices;
}

// All chains of 1 to 4 reflections at 4 mirrors have images, 160 of them; 0.5^5/0.5 are left.
constexpr const char* what_is_left =
    "of light that reaches a place by mirrors alone, 160 chains of mirrors are followed; the "
    "others would bring at most about 6.2 % of what meets mirrors and are left out";

TEST(MirrorChains, OfPointsAreToldAboutWhereSomeHaveNoImage) {
    const std::vector<Message> notices = notices_of(0.0, 0.5, true, false);
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_TRUE(notices[0].what.starts_with(
        "1 luminaire shines as points, and no ray meets a point by chance: "))
        << notices[0].what;
    EXPECT_TRUE(notices[0].what.ends_with(what_is_left)) << notices[0].what;
}

TEST(MirrorChains, OfOpeningsAreToldAboutWhereNoRaysAreSent) {
    const std::vector<Message> notices = notices_of(0.0, 0.5, false, true);
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_TRUE(notices[0].what.starts_with("only direct light is calculated: "))
        << notices[0].what;
    EXPECT_TRUE(notices[0].what.ends_with(what_is_left)) << notices[0].what;
}

TEST(MirrorChains, NeedNoWordWhereAllIsCounted) {
    EXPECT_TRUE(notices_of(0.0, 0.5, false, false).empty()); // rays find openings
    EXPECT_TRUE(notices_of(0.2, 0.0, true, false).empty());  // one mirror has no longer chain
}

} // namespace
} // namespace isolux
