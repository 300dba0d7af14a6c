#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>

#include "isolux/photometry/bug_rating.h"
#include "isolux/photometry/quantities.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

/// A table in steps of one degree from a formula in degrees.
IntensityDistribution make_table(const std::function<double(double, double)>& f,
                                 double plane_step = 5.0) {
    std::vector<Angle> planes, gammas;
    for (double c = 0; c <= 360; c += plane_step)
        planes.push_back(degrees(c));
    for (double g = 0; g <= 180; g += 1)
        gammas.push_back(degrees(g));
    std::vector<double> candela;
    for (const Angle c : planes)
        for (const Angle g : gammas)
            candela.push_back(f(std::round(c.in_degrees()), std::round(g.in_degrees())));
    return {std::move(planes), std::move(gammas), std::move(candela)};
}

LuminairePhotometry make_luminaire(IntensityDistribution distribution,
                                   LuminousOpening opening = {}) {
    return {.format = PhotometricFormat::eulumdat,
            .photometric_type = 'C',
            .symmetry = {},
            .planes_in_file = 0,
            .gammas_in_file = 0,
            .manufacturer = {},
            .name = {},
            .catalogue_number = {},
            .distribution = std::move(distribution),
            .opening = opening,
            .housing = opening,
            .is_absolute = false,
            .declared_flux = std::nullopt,
            .lamp_sets = {{1, "lamp", Lumen(2000), "", "", 20.0}},
            .input_watts = 25.0};
}

double lambert(double, double g) { return g < 90 ? 500.0 * std::cos(g * pi / 180) : 0.0; }

/// The trapezoid rule between nodes one degree apart misses a smooth table by about h^2 / 12.
constexpr double one_degree = (pi / 180) * (pi / 180) / 12;

TEST(Quantities, OfALambertianLuminaireAreKnownInClosedForm) {
    const auto l = make_luminaire(make_table(lambert));
    const double flux = 500 * pi;
    const double allowed = 5 * one_degree;
    EXPECT_NEAR(
        flux_between(l.distribution, degrees(0), degrees(30)).value() / flux, 0.25, allowed);
    EXPECT_NEAR(
        flux_between(l.distribution, degrees(30), degrees(90)).value() / flux, 0.75, allowed);
    EXPECT_NEAR(downward_fraction(l.distribution), 1.0, 1e-12);
    EXPECT_NEAR(light_output_ratio(l).value(), flux / 2000, allowed);
    EXPECT_NEAR(downward_light_output_ratio(l).value(), flux / 2000, allowed);
    EXPECT_NEAR(luminous_efficacy(l).value(), flux / 25, flux / 25 * allowed);
    const auto code = cie_flux_code(l); // 1 - cos^2 at cos = 3/4, 1/2, 1/4
    EXPECT_NEAR(code[0], 43.75, 100 * allowed);
    EXPECT_NEAR(code[1], 75.00, 100 * allowed);
    EXPECT_NEAR(code[2], 93.75, 100 * allowed);
    EXPECT_NEAR(code[3], 100.0, 1e-9);
    EXPECT_NEAR(code[4], 100 * flux / 2000, 100 * allowed);
    double sum = 0;
    for (const Lumen zone : zonal_flux(l.distribution))
        sum += zone.value();
    EXPECT_NEAR(sum, l.distribution.flux_trapezoid().value(), 1e-9);
}

TEST(Quantities, HaveNoLightOutputRatioInAbsolutePhotometry) {
    auto l = make_luminaire(make_table(lambert));
    l.is_absolute = true;
    l.input_watts = 0;
    EXPECT_FALSE(light_output_ratio(l).has_value());
    EXPECT_FALSE(downward_light_output_ratio(l).has_value());
    EXPECT_FALSE(luminous_efficacy(l).has_value());
    EXPECT_EQ(cie_flux_code(l)[4], 100.0);
}

TEST(Quantities, SplitSectorsAnywhere) {
    const auto d = make_table([](double, double) { return 100.0; });
    const auto sector = [&](double middle, double half) {
        return flux_in_sector(d, degrees(20), degrees(70), degrees(middle), degrees(half))
            .value();
    };
    const double zone = 100 * (std::cos(pi / 9) - std::cos(7 * pi / 18));
    EXPECT_NEAR(sector(0, 90), pi * zone, 1e-9);
    EXPECT_NEAR(sector(90, 90), pi * zone, 1e-9);
    EXPECT_NEAR(sector(350, 17), 34 * pi / 180 * zone, 1e-9);
    EXPECT_NEAR(sector(-77, 180), 2 * pi * zone, 1e-9);
}

TEST(Quantities, FollowATableOnLateralPoles) {
    // 100 cd on the lower half-space, as type B
    const IntensityDistribution d({degrees(-90), degrees(90)},
                                  {degrees(0), degrees(180)},
                                  {100, 100, 100, 100},
                                  TablePole::lateral);
    EXPECT_EQ(downward_fraction(d), 1.0);
    // the zone 30..60 within; the fine grid's edges fall on the limits
    EXPECT_NEAR(flux_between(d, degrees(30), degrees(60)).value(),
                200 * pi * (std::cos(pi / 6) - 0.5),
                1e-9);
}

TEST(Quantities, FindTheMaximumAndItsDirection) {
    const auto d =
        make_table([](double c, double g) { return c == 250 && g == 40 ? 900.0 : 10.0; });
    const auto m = find_maximum(d);
    EXPECT_EQ(m.value.value(), 900);
    EXPECT_NEAR(m.plane.in_degrees(), 250, 1e-9);
    EXPECT_NEAR(m.gamma.in_degrees(), 40, 1e-9);
    const IntensityDistribution b({degrees(-90), degrees(30), degrees(90)},
                                  {degrees(0), degrees(90), degrees(180)},
                                  {0, 0, 0, 0, 700, 0, 0, 0, 0},
                                  TablePole::lateral);
    const auto in_b = find_maximum(b); // V = 30, H = 0: towards +x, 30 degrees from nadir
    EXPECT_NEAR(in_b.plane.in_degrees(), 0, 1e-9);
    EXPECT_NEAR(in_b.gamma.in_degrees(), 30, 1e-9);
}

TEST(Quantities, MeasureBeamAndFieldAngle) {
    // falls linearly from 1000 at 0 to 0 at 50: half at 25, a tenth at 45
    const auto cone = make_table([](double, double g) { return std::max(0.0, 1000 - 20 * g); });
    EXPECT_NEAR(find_beam(cone, degrees(0), 0.5)->full().in_degrees(), 50, 1e-9);
    EXPECT_NEAR(find_beam(cone, degrees(33), 0.1)->full().in_degrees(), 90, 1e-9);
    EXPECT_NEAR(find_beam(make_table(lambert), degrees(0), 0.5)->full().in_degrees(),
                120,
                one_degree * 180 / pi * 10);
    const auto up =
        make_table([](double, double g) { return std::max(0.0, 1000 - 20 * (180 - g)); });
    EXPECT_NEAR(find_beam(up, degrees(0), 0.5)->full().in_degrees(), 50, 1e-9);
    EXPECT_FALSE(find_beam(make_table([](double, double) { return 0.0; }), degrees(0), 0.5));
}

TEST(Quantities, MeasureEachSideOfAnAsymmetricBeam) {
    // towards C0 twice as wide as towards C180
    const auto d = make_table([](double c, double g) {
        const double width = std::abs(std::remainder(c, 360)) < 90 ? 60 : 30;
        return std::max(0.0, 1000 * (1 - g / width));
    });
    const auto beam = find_beam(d, degrees(0), 0.5);
    EXPECT_NEAR(beam->towards_plane.in_degrees(), 30, 1e-9);
    EXPECT_NEAR(beam->towards_opposite.in_degrees(), 15, 1e-9);
}

TEST(Quantities, FollowABeamAcrossTheHorizonButNotASecondOne) {
    const auto wall = make_table([](double c, double g) { // horizontal beam towards C0
        return c < 45 || c > 315 ? std::max(0.0, 1000 - 20 * std::abs(g - 90)) : 0.0;
    });
    const auto beam = find_beam(wall, degrees(0), 0.5);
    EXPECT_NEAR(beam->towards_plane.in_degrees(), 115, 1e-9);
    EXPECT_NEAR(beam->towards_opposite.in_degrees(), -65, 1e-9);
    EXPECT_NEAR(find_beam(wall, degrees(180), 0.1)->full().in_degrees(), 90, 1e-9);
    const auto bare = make_table([](double, double) { return 100.0; });
    EXPECT_NEAR(find_beam(bare, degrees(30), 0.5)->full().in_degrees(), 360, 1e-9);
    const auto pendant = make_table([](double, double g) { // a dark horizon between two beams
        return 1000 * std::abs(std::cos(g * pi / 180));
    });
    EXPECT_LT(find_beam(pendant, degrees(0), 0.1)->full().in_degrees(), 180);
}

TEST(Quantities, TakeTheOuterEdgesOfABatwing) {
    const auto wings = make_table([](double, double g) { // peaks at 40, a hole below
        return std::max(0.0, 1000 - 50 * std::abs(g - 40));
    });
    EXPECT_NEAR(find_beam(wings, degrees(0), 0.5)->full().in_degrees(), 100, 1e-9);
}

// ---- luminance -----------------------------------------------------------------------------

LuminousOpening sized(OpeningShape shape, double x, double y, double z) {
    return {shape, Metre(x), Metre(y), Metre(z)};
}

double area(const LuminousOpening& o, const Vector3& direction) {
    return projected_luminous_area(make_luminaire(make_table(lambert), o),
                                   UnitVector3(direction))
        .value();
}

TEST(LuminousArea, OfEveryShapeSeenAlongTheAxes) {
    using enum OpeningShape;
    const Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, -1};
    EXPECT_EQ(area({}, z), 0);
    EXPECT_NEAR(area(sized(rectangle, 2, 3, 0), z), 6, 1e-12);
    EXPECT_NEAR(area(sized(rectangle, 2, 3, 0), x), 0, 1e-12);
    EXPECT_NEAR(area(sized(box, 2, 3, 5), x), 15, 1e-12);
    EXPECT_NEAR(area(sized(box, 2, 3, 5), y), 10, 1e-12);
    EXPECT_NEAR(area(sized(ellipse, 2, 3, 0), z), pi * 1.5, 1e-12);
    EXPECT_NEAR(area(sized(vertical_cylinder, 2, 3, 5), x), 15, 1e-12);
    EXPECT_NEAR(area(sized(vertical_cylinder, 2, 3, 5), y), 10, 1e-12);
    EXPECT_NEAR(area(sized(vertical_cylinder, 2, 3, 5), z), pi * 1.5, 1e-12);
    EXPECT_NEAR(area(sized(cylinder_along_x, 2, 3, 5), y), 10, 1e-12);
    EXPECT_NEAR(area(sized(cylinder_along_x, 2, 3, 5), z), 6, 1e-12);
    EXPECT_NEAR(area(sized(cylinder_along_x, 2, 3, 5), x), pi * 15 / 4, 1e-12);
    EXPECT_NEAR(area(sized(cylinder_along_y, 2, 3, 5), x), 15, 1e-12);
    EXPECT_NEAR(area(sized(cylinder_along_y, 2, 3, 5), z), 6, 1e-12);
    EXPECT_NEAR(area(sized(cylinder_along_y, 2, 3, 5), y), pi * 10 / 4, 1e-12);
    EXPECT_NEAR(area(sized(ellipsoid, 2, 3, 5), x), pi * 15 / 4, 1e-12);
    EXPECT_NEAR(area(sized(ellipsoid, 2, 3, 5), z), pi * 6 / 4, 1e-12);
    EXPECT_NEAR(area(sized(vertical_ellipse, 0, 3, 5), x), pi * 15 / 4, 1e-12);
    EXPECT_NEAR(area(sized(ellipsoid, 2, 2, 2), {1, 1, 1}), pi, 1e-12);
}

TEST(LuminousArea, UsesTheHeightOfTheSideThatIsSeen) {
    auto l = make_luminaire(make_table(lambert), sized(OpeningShape::box, 2, 3, 5));
    l.side_heights = {{Metre(5), Metre(4), Metre(0), Metre(1)}};
    const auto seen = [&](const Vector3& w) {
        return projected_luminous_area(l, UnitVector3(w)).value();
    };
    EXPECT_NEAR(seen({1, 0, 0}), 15, 1e-12);
    EXPECT_NEAR(seen({-1, 0, 0}), 0, 1e-12);
    EXPECT_NEAR(seen({0, 1, 0}), 8, 1e-12);
    EXPECT_NEAR(seen({0, -1, 0}), 2, 1e-12);
}

TEST(Luminance, OfALambertianPanelIsTheSameEverywhere) {
    const auto panel =
        make_luminaire(make_table(lambert), sized(OpeningShape::rectangle, 0.5, 1, 0));
    for (const double g : {0.0, 45.0, 65.0, 85.0}) // nodes of the table
        EXPECT_NEAR(mean_luminance(panel, degrees(20), degrees(g))->value(), 1000, 1e-9);
    EXPECT_FALSE(mean_luminance(make_luminaire(make_table(lambert)), degrees(0), degrees(0)));
}

// ---- BUG -----------------------------------------------------------------------------------

TEST(BugRating, SortsFluxIntoFrontBackAndUp) {
    // 100 cd towards the front half (C90), 10 cd towards the back, 1 cd up
    const IntensityDistribution d = make_table(
        [](double c, double g) { return g > 90             ? 1.0
                                        : c > 0 && c < 180 ? 100.0
                                                           : 10.0; }, 1.0);
    const auto zones = bug_zones(d, street_side_by_convention(PhotometricFormat::eulumdat));
    const double low = pi * (1 - std::cos(pi / 6));
    // the step between the halves is a ramp one degree wide: half a degree on both ends
    const double ramp = 2 * 0.5 / 180;
    EXPECT_NEAR(zones.front_low.value() / low, 100 - 90 * ramp, 1e-9);
    EXPECT_NEAR(zones.back_low.value() / low, 10, 1e-9);
    EXPECT_NEAR(zones.up_high.value(), 2 * pi * (std::cos(pi * 100 / 180) + 1), 1e-9);
    const auto turned = bug_zones(d, degrees(270));
    EXPECT_NEAR(turned.back_low.value(), zones.front_low.value(), 1e-9);
    EXPECT_EQ(street_side_by_convention(PhotometricFormat::lm63_2002).in_degrees(), 0);
}

TEST(BugRating, FollowsTheLimitsOfTm15) {
    BugZones z;
    EXPECT_EQ(to_string(rate(z, LateralType::asymmetric)), "B0 U0 G0");
    z.back_mid = Lumen(221);
    EXPECT_EQ(to_string(rate(z, LateralType::asymmetric)), "B1 U0 G0");
    z.up_low = Lumen(11);
    EXPECT_EQ(to_string(rate(z, LateralType::asymmetric)), "B1 U2 G0");
    z.back_high = Lumen(501);
    EXPECT_EQ(to_string(rate(z, LateralType::asymmetric)), "B2 U2 G2");
    EXPECT_EQ(to_string(rate(z, LateralType::symmetric)), "B2 U2 G0");
    z.front_very_high = Lumen(751);
    z.up_high = Lumen(1001);
    z.back_low = Lumen(5001);
    EXPECT_EQ(to_string(rate(z, LateralType::symmetric)), "B5 U5 G5");
}

} // namespace
} // namespace isolux
