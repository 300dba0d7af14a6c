#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "isolux/scene/luminaire.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

LuminousOpening opening(OpeningShape shape, double x, double y, double z) {
    return {shape, Metre(x), Metre(y), Metre(z)};
}

double total_area(const Opening& o) {
    double sum = 0.0;
    for (const Facet& f : o.facets)
        sum += f.area;
    return sum;
}

/// Every facet is planar, convex, wound counter-clockwise about its normal and has its area.
void expect_sound(const Opening& o) {
    for (const Facet& f : o.facets) {
        Vector3 twice;
        const std::size_t n = f.vertices.size();
        ASSERT_GE(n, 3U);
        for (std::size_t i = 0; i < n; ++i) {
            const Point3 &a = f.vertices[i], &b = f.vertices[(i + 1) % n],
                         &c = f.vertices[(i + 2) % n];
            EXPECT_NEAR(dot(a - f.vertices[0], f.normal), 0.0, 1e-14);
            EXPECT_GT(dot(cross(b - a, c - b), f.normal), 0.0);
            twice = twice + cross(a - Point3{}, b - Point3{});
        }
        EXPECT_NEAR(0.5 * length(twice), f.area, 1e-14);
    }
}

/// The vector areas of a closed body add up to zero, and all facets look outwards.
void expect_closed(const Opening& o) {
    Vector3 sum;
    for (const Facet& f : o.facets) {
        sum = sum + f.area * Vector3(f.normal);
        EXPECT_GT(dot(f.vertices[0] - Point3{}, f.normal), 0.0);
    }
    EXPECT_NEAR(length(sum), 0.0, 1e-13);
}

TEST(Opening, PointHasNoFacets) {
    const Opening o = make_opening({});
    EXPECT_EQ(o.form, OpeningForm::point);
    EXPECT_TRUE(o.facets.empty());
    EXPECT_EQ(o.largest_dimension, 0.0);
    EXPECT_EQ(make_opening(opening(OpeningShape::rectangle, 0, 0, 0)).form, OpeningForm::point);
}

TEST(Opening, FlatShapesHaveTheirAreaAndFaceTheLight) {
    const struct {
        OpeningShape shape;
        double area;
        Vector3 normal;
    } cases[] = {{OpeningShape::rectangle, 1.2 * 0.3, {0, 0, -1}},
                 {OpeningShape::ellipse, pi / 4 * 1.2 * 0.3, {0, 0, -1}},
                 {OpeningShape::vertical_ellipse, pi / 4 * 0.3 * 0.2, {1, 0, 0}}};

    for (const auto& c : cases) {
        const Opening o = make_opening(opening(c.shape, 1.2, 0.3, 0.2));
        ASSERT_EQ(o.facets.size(), 1U);
        EXPECT_EQ(o.form, OpeningForm::flat);
        EXPECT_NEAR(o.facets[0].area, c.area, 1e-14);
        EXPECT_NEAR(length(Vector3(o.facets[0].normal) - c.normal), 0.0, 1e-15);
        expect_sound(o);
    }
    const Opening o = make_opening(opening(OpeningShape::rectangle, 1.2, 0.3, 0.0));
    double x = 0.0, y = 0.0;
    for (const Point3& p : o.facets[0].vertices)
        x = std::max(x, p.x), y = std::max(y, p.y);
    EXPECT_EQ(x, 0.6); // extent_x lies along x
    EXPECT_EQ(y, 0.15);
    EXPECT_EQ(o.largest_dimension, 1.2);
}

TEST(Opening, SolidShapesAreClosed) {
    for (const auto shape : {OpeningShape::box, OpeningShape::ellipsoid}) {
        const Opening o = make_opening(opening(shape, 0.9, 0.5, 0.3));
        EXPECT_EQ(o.form, OpeningForm::solid);
        expect_sound(o);
        expect_closed(o);
    }
    for (const auto shape : {OpeningShape::vertical_cylinder,
                             OpeningShape::cylinder_along_x,
                             OpeningShape::cylinder_along_y}) {
        const Opening o = make_opening(opening(shape, 0.9, 0.5, 0.3));
        EXPECT_EQ(o.form, OpeningForm::solid);
        expect_sound(o);
        expect_closed(o);
    }
}

TEST(Opening, BoxHasItsSixFaces) {
    const Opening o = make_opening(opening(OpeningShape::box, 0.9, 0.5, 0.3));
    EXPECT_EQ(o.facets.size(), 6U);
    EXPECT_NEAR(total_area(o), 2 * (0.9 * 0.5 + 0.5 * 0.3 + 0.3 * 0.9), 1e-14);
}

TEST(Opening, RoundSolidsHaveTheSurfaceOfTheShape) {
    // Cauchy: then the projected area, averaged over all directions, is right, too.
    const Opening sphere = make_opening(opening(OpeningShape::ellipsoid, 0.4, 0.4, 0.4));
    EXPECT_NEAR(total_area(sphere), pi * 0.16, 2e-5 * pi * 0.16); // quadrature of the reference
    const Opening standing =
        make_opening(opening(OpeningShape::vertical_cylinder, 0.4, 0.4, 0.7));
    EXPECT_NEAR(total_area(standing), pi * 0.4 * 0.7 + 2 * pi * 0.04, 1e-13);
    const Opening lying = make_opening(opening(OpeningShape::cylinder_along_y, 0.1, 1.5, 0.1));
    EXPECT_NEAR(total_area(lying), pi * 0.1 * 1.5 + 2 * pi * 0.0025, 1e-13);
    // Prolate spheroid a = b = 0.2, c = 0.5: 2 pi a^2 (1 + c/(a e) asin e), e^2 = 1 - a^2/c^2
    const double e = std::sqrt(1.0 - 0.16);
    const Opening egg = make_opening(opening(OpeningShape::ellipsoid, 0.4, 0.4, 1.0));
    const double exact = 2 * pi * 0.04 * (1.0 + 0.5 / (0.2 * e) * std::asin(e));
    EXPECT_NEAR(total_area(egg), exact, 1e-4 * exact);
}

TEST(Opening, CylindersLieAlongTheirAxis) {
    const auto extent = [](const Opening& o) {
        Vector3 e;
        for (const Facet& f : o.facets)
            for (const Point3& p : f.vertices)
                e = {std::max(e.x, 2 * p.x), std::max(e.y, 2 * p.y), std::max(e.z, 2 * p.z)};
        return e;
    };
    const Vector3 x =
        extent(make_opening(opening(OpeningShape::cylinder_along_x, 1.5, 0.1, 0.2)));
    EXPECT_NEAR(x.x, 1.5, 1e-15);
    EXPECT_NEAR(x.y, 0.1, 0.002);
    EXPECT_NEAR(x.z, 0.2, 0.004);
    const Vector3 y =
        extent(make_opening(opening(OpeningShape::cylinder_along_y, 0.1, 1.5, 0.2)));
    EXPECT_NEAR(y.x, 0.1, 0.002);
    EXPECT_NEAR(y.y, 1.5, 1e-15);
    EXPECT_NEAR(y.z, 0.2, 0.004);
}

TEST(Opening, ALineGetsTheLeastWidth) {
    const Opening o = make_opening(opening(OpeningShape::rectangle, 1.5, 0.0, 0.0));
    EXPECT_NEAR(o.facets[0].area, 1.5e-3, 1e-15);
    expect_sound(o);
}

TEST(Opening, ToWorldTurnsAndMovesFacets) {
    const Opening local = make_opening(opening(OpeningShape::rectangle, 0.6, 0.3, 0.0));
    const Frame frame = make_tilted_frame({1, 2, 3}, degrees(0), degrees(90), degrees(0));
    const Opening world = to_world(local, frame);
    EXPECT_NEAR(world.facets[0].normal.x(), 1.0, 1e-15); // the nadir tips towards +x
    for (const Point3& p : world.facets[0].vertices) {
        EXPECT_NEAR(p.x, 1.0, 1e-15);
        EXPECT_NEAR(std::abs(p.y - 2.0), 0.15, 1e-15);
        EXPECT_NEAR(std::abs(p.z - 3.0), 0.3, 1e-15);
    }
}

// Sources without a file.

LuminaireType lambertian(double flux) {
    LuminaireType t{.name = "panel",
                    .file = "",
                    .source = LambertianSource{Lumen(flux)},
                    .opening = opening(OpeningShape::rectangle, 0.6, 0.6, 0.0)};
    return t;
}

UnitVector3 at_gamma(double angle) {
    const double g = degrees(angle).in_radians();
    return UnitVector3::from_unit({std::sin(g), 0, -std::cos(g)});
}

TEST(Luminaire, LambertianPanelFollowsTheCosine) {
    const auto type = lambertian(4000);
    for (const double angle : {0.0, 30.0, 60.0, 89.0})
        EXPECT_NEAR(in_candela(luminous_intensity(type, at_gamma(angle))),
                    4000 / pi * std::cos(degrees(angle).in_radians()),
                    1e-10);
    EXPECT_EQ(in_candela(luminous_intensity(type, at_gamma(91))), 0.0);
    EXPECT_EQ(in_candela(luminous_intensity(type, at_gamma(180))), 0.0);
    EXPECT_EQ(in_lumen(luminous_flux(type)), 4000.0);
}

TEST(Luminaire, FluxScaleScalesFluxAndIntensity) {
    auto type = lambertian(4000);
    type.flux_scale = 0.5;
    EXPECT_EQ(in_lumen(luminous_flux(type)), 2000.0);
    EXPECT_NEAR(in_candela(luminous_intensity(type, at_gamma(0))), 2000 / pi, 1e-10);
}

TEST(Luminaire, IsotropicSourceShinesAlikeEverywhere) {
    const LuminaireType type{
        .name = "bulb", .file = "", .source = IsotropicSource{Lumen(1000)}, .opening = {}};
    for (const double angle : {0.0, 77.0, 180.0})
        EXPECT_NEAR(in_candela(luminous_intensity(type, at_gamma(angle))), 79.5774715459, 1e-9);
}

TEST(Luminaire, UprightLambertianShinesForwards) {
    auto type = lambertian(100);
    type.opening = opening(OpeningShape::vertical_ellipse, 0, 0.3, 0.3);
    EXPECT_NEAR(in_candela(luminous_intensity(type, at_gamma(90))), 100 / pi, 1e-12);
    EXPECT_NEAR(in_candela(luminous_intensity(type, at_gamma(0))), 0.0, 1e-14);
}

TEST(Luminaire, TableGivesIntensityAndFlux) {
    const IntensityDistribution uniform(
        {degrees(0), degrees(360)}, {degrees(0), degrees(180)}, {100, 100, 100, 100});
    const LuminairePhotometry photometry{.symmetry = "",
                                         .manufacturer = "",
                                         .name = "",
                                         .catalogue_number = "",
                                         .distribution = uniform,
                                         .opening = {},
                                         .housing = {},
                                         .declared_flux = {},
                                         .lamp_sets = {}};
    const LuminaireType type{.name = "table",
                             .file = "table.ldt",
                             .source = photometry,
                             .opening = {},
                             .flux_scale = 2.0};
    EXPECT_NEAR(in_lumen(luminous_flux(type)), 2.0 * 4.0 * pi * 100.0, 1e-9);
    EXPECT_NEAR(in_candela(luminous_intensity(type, at_gamma(33))), 200.0, 1e-10);
}

// Frames.

void expect_rotation(const Frame& f) {
    // Rounding, multiplied where +x lies near the nadir and little of it is left for C0.
    constexpr double rounding = 1e-13;
    EXPECT_NEAR(length(cross(f.x, f.y) - Vector3(f.z)), 0.0, rounding);
    EXPECT_NEAR(length(f.x), 1.0, rounding);
    EXPECT_NEAR(dot(f.x, f.y), 0.0, rounding);
}

TEST(TiltedFrame, AgreesWithTheReferenceScene) {
    // "downlights": rotation 0, tilt 25; azimuth 30 and 90; nadir and C0 as given there
    const struct {
        double azimuth;
        Vector3 nadir, c0;
    } cases[] = {
        {30, {0.365998151, 0.211309131, -0.906307787}, {0.784885567, 0.453153894, 0.422618262}},
        {90, {0.0, 0.422618262, -0.906307787}, {0.0, 0.906307787, 0.422618262}}};

    for (const auto& c : cases) {
        const Frame f =
            make_tilted_frame({1, 2, 3}, degrees(0), degrees(25), degrees(c.azimuth));
        EXPECT_NEAR(length(-Vector3(f.z) - c.nadir), 0.0, 1e-9);
        EXPECT_NEAR(length(Vector3(f.x) - c.c0), 0.0, 1e-9);
        EXPECT_EQ(f.origin, (Point3{1, 2, 3}));
        expect_rotation(f);
    }
}

TEST(TiltedFrame, RotatesAboutItsOwnAxisFirst) {
    // Turned by 90 degrees C0 points along +y, about which the tilt turns: it stays.
    const Frame f = make_tilted_frame({}, degrees(90), degrees(40), degrees(0));
    EXPECT_NEAR(length(Vector3(f.x) - Vector3{0, 1, 0}), 0.0, 1e-15);
    EXPECT_NEAR(-f.z.x(), std::sin(degrees(40).in_radians()), 1e-15);
}

TEST(AimedFrame, LooksAtTheAimWithC0AsNearAsPossibleToX) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const Point3 p{u(engine), u(engine), u(engine)}, aim{u(engine), u(engine), u(engine)};
        const Frame f = make_aimed_frame(p, aim, degrees(0));
        expect_rotation(f);
        EXPECT_NEAR(length(-Vector3(f.z) - Vector3(UnitVector3(aim - p))), 0.0, 1e-15);
        EXPECT_NEAR(f.y.x(), 0.0, 1e-12); // any other C0 would have less of +x
        EXPECT_GT(f.x.x(), 0.0);
        EXPECT_EQ(f.origin, p);
    }
}

TEST(AimedFrame, StraightDownIsTheUntiltedFrame) {
    const Frame f = make_aimed_frame({1, 1, 3}, {1, 1, 0}, degrees(0));
    EXPECT_EQ(Vector3(f.x), (Vector3{1, 0, 0}));
    EXPECT_EQ(Vector3(f.z), (Vector3{0, 0, 1}));
}

TEST(AimedFrame, SpinTurnsLikeRotation) {
    const Frame spun = make_aimed_frame({}, {0, 0, -2}, degrees(30));
    const Frame rotated = make_tilted_frame({}, degrees(30), degrees(0), degrees(0));
    EXPECT_NEAR(length(Vector3(spun.x) - Vector3(rotated.x)), 0.0, 1e-15);
}

TEST(AimedFrame, AlongXItFollowsTheTiltedFrame) {
    for (const double sign : {1.0, -1.0}) {
        const Frame aimed = make_aimed_frame({}, {sign, 0, 0}, degrees(0));
        const Frame tilted = make_tilted_frame({}, degrees(0), degrees(sign * 90), degrees(0));
        EXPECT_NEAR(length(Vector3(aimed.x) - Vector3(tilted.x)), 0.0, 1e-15);
        EXPECT_NEAR(length(Vector3(aimed.z) - Vector3(tilted.z)), 0.0, 1e-15);
        expect_rotation(aimed);
    }
}

} // namespace
} // namespace isolux
