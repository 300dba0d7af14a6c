#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/estimate.h"
#include "isolux/base/polygon.h"
#include "isolux/transport/direct_light.h"
#include "isolux/transport/opening_light.h"
#include "isolux/transport/response.h"

#include "support/random_luminaires.h"
#include "support/statistics.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

constexpr std::size_t replicates = 16;
constexpr std::uint32_t units = 64;
constexpr double luminance = 1000.0; // cd/m2, of a panel of 1 m2

/// A sheet hides what lies beyond `edge` of the panel, along x or along y.
struct Shadow {
    double edge;
    bool is_along_x;
};

/// A panel 2 m above the receiver, a black sheet halfway.
class DirectLightPastAnEdge : public testing::TestWithParam<Shadow> {
protected:
    DirectLightPastAnEdge() {
        const double e = 0.5 * GetParam().edge;
        const Point3 corner = GetParam().is_along_x ? Point3{e, -5, 1} : Point3{-5, e, 1};
        test::Builder builder;
        builder.add_quad(corner, {10, 0, 0}, {0, 10, 0}, builder.add_diffuse(0));
        builder.add_panel({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, luminance * std::numbers::pi);
        scene_.push_back(builder.build());
    }

    /// Of the part of the panel below `edge`, lx.
    [[nodiscard]] double light_below(double edge) const {
        const double x = GetParam().is_along_x ? edge : 0.5;
        const double y = GetParam().is_along_x ? 0.5 : edge;
        const std::vector<Point3> part{{-0.5, -0.5, 2}, {x, -0.5, 2}, {x, y, 2}, {-0.5, y, 2}};
        return luminance * projected_solid_angle(part, receiver_.point, receiver_.axis);
    }

    /// Mean of `count` units for each replicate, lx.
    [[nodiscard]] Estimate estimate(std::uint32_t count) const {
        const Emission emission(scene_.front());
        const MirrorImages images(scene_.front());
        const DirectLight direct(scene_.front(), emission, images);
        std::vector<double> sums(replicates, 0.0);
        std::vector<Rgb> values(replicates);
        std::uint64_t rays = 0;
        for (std::uint32_t unit = 0; unit < count; ++unit) {
            direct.estimate(receiver_, 0, 1, unit, 0, values, rays);
            for (std::size_t r = 0; r < replicates; ++r)
                sums[r] += luminance_sum(values[r]) / count;
        }
        return estimate_from_replicates(sums);
    }

    Receiver receiver_{{0, 0, 0}, UnitVector3::from_unit({0, 0, 1})};
    std::vector<Scene> scene_;
};

TEST_P(DirectLightPastAnEdge, IsThatOfTheVisiblePartOfThePanel) {
    const double expected = light_below(GetParam().edge);
    const Estimate e = estimate(units);
    EXPECT_LT(std::abs(e.mean - expected), 7.0 * e.standard_error)
        << e.mean << " +- " << e.standard_error << " lx, exact " << expected;
}

/// At least one look at the panel a unit: of independent looks the error would be that of a
/// coin. A scrambled net is at most sqrt(e) worse, in fact better; 16 replicates know their own
/// error to a fifth.
TEST_P(DirectLightPastAnEdge, HasAnErrorThatShrinksWithTheUnits) {
    const double whole = light_below(0.5);
    const double share = light_below(GetParam().edge) / whole;
    const double coin = whole * std::sqrt(share * (1.0 - share) / (units * replicates));
    EXPECT_LT(estimate(units).standard_error, coin);
}

INSTANTIATE_TEST_SUITE_P(Edges,
                         DirectLightPastAnEdge,
                         testing::Values(Shadow{-0.25, true},
                                         Shadow{-0.25, false},
                                         Shadow{0.25, true},
                                         Shadow{0.25, false},
                                         Shadow{0.45, true},
                                         Shadow{0.45, false}));

/// What nothing hides costs no ray, ever, and has no noise.
TEST(DirectLight, OfAWhollyVisiblePanelIsLambertsFormula) {
    test::Builder builder;
    builder.add_room({-2, -2, 0}, {2, 2, 2.5}, {}, {}, builder.add_diffuse(0.5));
    builder.add_panel({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, luminance * std::numbers::pi);
    const Scene scene = builder.build();
    const Emission emission(scene);
    const MirrorImages images(scene);
    const DirectLight direct(scene, emission, images);
    const Receiver receiver{{0.3, 0.2, 0}, UnitVector3::from_unit({0, 0, 1})};
    std::uint64_t rays = 0;
    const DirectPlan plan = direct.plan(receiver, 0, 1, true, rays);
    EXPECT_EQ(rays, 0U);
    EXPECT_TRUE(direct.is_exact(plan));
    const std::vector<Point3> panel{
        {-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0.5, 0.5, 2}, {-0.5, 0.5, 2}};
    const double exact =
        luminance * projected_solid_angle(panel, receiver.point, receiver.axis);
    EXPECT_NEAR(luminance_sum(plan.known), exact, 1e-12 * exact);
    ASSERT_EQ(plan.terms.size(), 1U);
    EXPECT_NEAR(plan.terms[0].lux, exact, 1e-12 * exact);
}

/// Rules of growing order against the mean of many places of the opening: every shape, every
/// kind of table, every receiver. False alarm 2e-9 a comparison; the rules may err by 2e-5.
TEST(OpeningLight, IsTheMeanOverItsPlaces) {
    test::NormalDraws random(11);
    int compared = 0;
    for (int i = 0; i < 150; ++i) {
        test::Builder b;
        b.add_triangle({0, 0, -900}, {1, 0, -900}, {0, 1, -900}, b.add_diffuse(0.0));
        test::add_random_luminaire(b, random, 1.0);
        const Scene scene = b.build();
        const Emission emission(scene);
        const Receiver receiver = test::random_receiver(random, 6.0);
        const OpeningLight light(scene, emission, receiver, receiver.point, 0);
        const std::optional<RuleValue> known = light.unshadowed();
        if (!known)
            continue;
        const Estimate e = test::over_seeds([&](std::size_t) {
            double sum = 0.0;
            for (int k = 0; k < 200; ++k) {
                const double u = random.uniform();
                sum += light.value(light.look(u, random.uniform()));
            }
            return sum / 200.0;
        });
        EXPECT_LT(std::abs(e.mean - known->value),
                  test::z_limit * e.standard_error + 1e-4 * known->value + 1e-12)
            << i << ": " << e.mean << " +- " << e.standard_error << ", rule " << known->value;
        compared += known->value > 0.0 ? 1 : 0;
    }
    EXPECT_GT(compared, 50);
}

/// METHODS eq. (3) without shadows, by a fine midpoint rule on every triangle of an opening.
double illuminance_by_places(const Scene& scene,
                             const Emission& emission,
                             const Receiver& receiver,
                             std::size_t luminaire) {
    const Opening& opening = scene.luminaires[luminaire].opening;
    constexpr int n = 120;
    double sum = 0.0;
    for (std::size_t f = 0; f < opening.facets.size(); ++f) {
        const auto& p = opening.facets[f].vertices;
        if (opening.form == OpeningForm::solid
            && dot(opening.facets[f].normal, receiver.point - p[0]) <= 0.0)
            continue;
        for (std::size_t i = 1; i + 1 < p.size(); ++i)
            for (int u = 0; u < n; ++u)
                for (int v = 0; v < n; ++v) {
                    const double s = (u + 0.5) / n;
                    const double t = (1.0 - s) * (v + 0.5) / n;
                    EmissionPoint from{luminaire, f, p[0]};
                    from.position = p[0] + (s * (p[i] - p[0]) + t * (p[i + 1] - p[0]));
                    const Vector3 d = receiver.point - from.position;
                    const UnitVector3 w(d);
                    sum += (1.0 - s) * length(cross(p[i] - p[0], p[i + 1] - p[0]))
                           * emission.evaluate(from, w) * evaluate_response(receiver, -w)
                           / (length_squared(d) * n * n);
                }
    }
    return sum;
}

/// METHODS eq. (134): what a plan knows of several luminaires at once may be wrong by 2e-4 of
/// it as two rules tell it. A random table is the worst case: every node is a kink. The last
/// scenes have many luminaires, of which most bring so little that rough values will do.
TEST(DirectLight, KnowsItsOpeningsAsWellAsItMatters) {
    test::NormalDraws random(17);
    int compared = 0;
    for (int i = 0; i < 46; ++i) {
        test::Builder b;
        b.add_triangle({0, 0, -900}, {1, 0, -900}, {0, 1, -900}, b.add_diffuse(0.0));
        for (int k = 0; k < (i < 40 ? 5 : 24); ++k)
            test::add_random_luminaire(b, random, 1.0);
        const Scene scene = b.build();
        const Emission emission(scene);
        const MirrorImages images(scene);
        const DirectLight direct(scene, emission, images);
        const Receiver receiver = test::random_receiver(random, i % 2 == 0 ? 6.0 : 40.0);
        std::uint64_t rays = 0;
        const DirectPlan plan = direct.plan(receiver, 0, 1, true, rays);
        double known = 0.0;
        for (const DirectPlan::Term& term : plan.terms)
            if (scene.luminaires[term.luminaire].opening.form != OpeningForm::point)
                known += term.lux;
        double true_value = 0.0; // also of those that the plan took for dark
        for (std::uint32_t l = 0; l < scene.luminaires.size(); ++l)
            if (scene.luminaires[l].opening.form != OpeningForm::point
                && std::ranges::none_of(plan.openings,
                                        [&](const auto& o) { return o.luminaire == l; }))
                true_value += illuminance_by_places(scene, emission, receiver, l);
        EXPECT_NEAR(known, true_value, 4e-4 * true_value + 1e-12) << i;
        compared += true_value > 0.0 ? 1 : 0;
    }
    EXPECT_GT(compared, 25);
}

/// A long pendant and a round one close above a desk, seen by the desk, by a screen and a
/// sloping board whose horizons cut them, and by bodies: halves of an opening are known where
/// the whole is too near.
TEST(OpeningLight, IsKnownCloseToAnOpeningAndAcrossTheHorizon) {
    for (const OpeningShape shape : {OpeningShape::rectangle, OpeningShape::ellipse}) {
        test::Builder b;
        b.add_triangle({0, 0, -900}, {1, 0, -900}, {0, 1, -900}, b.add_diffuse(0.0));
        LuminaireType type;
        type.source = IsotropicSource{Lumen(3000.0)};
        type.opening.shape = shape;
        type.opening.extent_x = Metre(1.5);
        type.opening.extent_y = Metre(shape == OpeningShape::rectangle ? 0.06 : 1.0);
        Luminaire pendant;
        pendant.placement.world_from_luminaire.origin = {0, 0, 0.9};
        pendant.opening =
            to_world(make_opening(type.opening), pendant.placement.world_from_luminaire);
        pendant.flux = luminous_flux(type);
        pendant.placement.type = b.add_type(std::move(type));
        b.luminaires.push_back(pendant);
        const Scene scene = b.build();
        const Emission emission(scene);
        const std::array axes{Vector3{0, 0, 1}, Vector3{1, 0, 0}, Vector3{0.7, -0.6, 0.1}};
        for (const IlluminanceKind kind : {IlluminanceKind::planar,
                                           IlluminanceKind::cylindrical,
                                           IlluminanceKind::semi_cylindrical})
            for (const Vector3& axis : axes) {
                const Receiver receiver{{0.2, 0.3, 0.5}, UnitVector3(axis), kind};
                const OpeningLight light(scene, emission, receiver, receiver.point, 0);
                const std::optional<RuleValue> known = light.unshadowed();
                ASSERT_TRUE(known.has_value())
                    << static_cast<int>(shape) << static_cast<int>(kind);
                const double by_places = illuminance_by_places(scene, emission, receiver, 0);
                EXPECT_NEAR(known->value, by_places, 2e-3 * by_places);
                EXPECT_GT(known->value, 0.0);
            }
    }
}

/// A scene with all that its direct light needs.
struct Lit {
    explicit Lit(Scene of) : scene(std::move(of)) {}

    Scene scene;
    Emission emission{scene};
    MirrorImages images{scene};
    DirectLight direct{scene, emission, images};
    Receiver receiver{{0, 0, 0}, UnitVector3::from_unit({0, 0, 1})};
    std::uint64_t rays = 0;
    DirectPlan plan = direct.plan(receiver, 0, 1, false, rays);

    /// Adds one unit of all replicates.
    void add(std::uint32_t unit, const DirectEffort& effort, const LightLedger& ledger) {
        direct.estimate(receiver, plan, 0, 1, unit, effort, 0, ledger, rays);
    }
};

/// METHODS eq. (141): beside a bright panel a dim one behind an edge is looked at once in four
/// units, later four times as often. It keeps its mean, and its error falls with the units like
/// that of its looks. Nothing is known of what is visible, so that these have to bring it all.
TEST(DirectLight, LooksSeldomWhereLittleIsAtStake) {
    constexpr std::uint32_t many = 1024;
    const auto panel_to = [](double x) { // illuminance by the part below it, along x or y
        const std::vector<Point3> part{
            {-0.5, -0.5, 2}, {x, -0.5, 2}, {x, 0.5, 2}, {-0.5, 0.5, 2}};
        return projected_solid_angle(part, {0, 0, 0}, UnitVector3::from_unit({0, 0, 1}));
    };
    const double share = panel_to(0.25) / panel_to(0.5);
    const double coin =
        panel_to(0.5) * std::sqrt(share * (1.0 - share) / (many / 4.0 * replicates));
    for (const bool is_along_x : {true, false}) {
        const auto at = [&](double x, double y, double z) {
            return is_along_x ? Point3{x, y, z} : Point3{y, x, z};
        };
        test::Builder b;
        b.add_quad(at(0.125, -5, 1), {10, 0, 0}, {0, 10, 0}, b.add_diffuse(0));
        b.add_panel({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, std::numbers::pi);
        b.add_panel(at(-3.5, -0.5, 2), {0, 1, 0}, {1, 0, 0}, 1e4 * std::numbers::pi);
        Lit lit(b.build());
        ASSERT_EQ(lit.plan.openings.size(), 1U);
        lit.plan.openings[0].visible_share = 0.0F;
        lit.rays = 0;
        std::vector<double> sums(replicates, 0.0);
        for (std::uint32_t unit = 0; unit < many; ++unit) {
            std::vector<Rgb> values(replicates);
            lit.add(unit, {unit < many / 2 ? 1U : 4U, 0.0}, {values, nullptr, {}, {}});
            for (std::size_t r = 0; r < replicates; ++r)
                sums[r] += luminance_sum(values[r] - lit.plan.known) / many;
        }
        EXPECT_EQ(lit.rays, many / 2 * replicates / 4U + many / 2 * replicates);
        const Estimate e = estimate_from_replicates(sums);
        EXPECT_LT(std::abs(e.mean - panel_to(0.25)), 4.0 * e.standard_error);
        EXPECT_LT(e.standard_error, 0.5 * coin);
    }
}

/// The image of a dim panel in a mirror, beside a bright panel: looked at in some of the units
/// only, METHODS eq. (141), it is that of (34).
TEST(DirectLight, LooksSeldomAtDimImages) {
    constexpr std::uint32_t many = 256;
    constexpr double mirror = 0.5;
    test::Builder b;
    b.add_quad({2, -50, -50},
               {0, 100, 0},
               {0, 0, 100},
               b.add_material({"mirror", Opaque{Rgb::grey(0.0), mirror}, Sides::both}));
    b.add_panel({-0.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, std::numbers::pi);
    b.add_panel({-3.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, 1e4 * std::numbers::pi);
    Lit lit(b.build());
    ASSERT_TRUE(lit.plan.openings.empty());
    LedgerLayout layout;
    layout.sources = 2;
    layout.source_of = {0, 1};
    std::vector<double> sums(replicates, 0.0);
    std::size_t without = 0;
    for (std::uint32_t unit = 0; unit < many; ++unit) {
        std::vector<Rgb> values(replicates);
        std::vector<double> by_source(2 * replicates, 0.0);
        lit.add(unit, {}, {values, &layout, by_source, {}});
        for (std::size_t r = 0; r < replicates; ++r) {
            sums[r] += by_source[r] / many;
            without += by_source[r] == 0.0 ? 1 : 0;
        }
    }
    EXPECT_EQ(without, many * replicates * 3 / 4);
    const std::vector<Point3> panel{
        {-0.5, -0.5, 2}, {0.5, -0.5, 2}, {0.5, 0.5, 2}, {-0.5, 0.5, 2}};
    const double exact = mirror * projected_solid_angle(panel, {4, 0, 0}, lit.receiver.axis);
    const Estimate e = estimate_from_replicates(sums);
    EXPECT_LT(std::abs(e.mean - exact), 4.0 * e.standard_error);
    EXPECT_LT(e.standard_error, 1e-3 * exact);
}

/// A hall of panels and lamps with a wall in it: by luminaire the light is what it is as a
/// whole, in every replicate.
TEST(DirectLight, IsTheSumOverItsLuminaires) {
    test::Builder b;
    b.add_room({0, 0, 0}, {40, 40, 4}, {}, {}, b.add_diffuse(0.5));
    b.add_quad({11, 0, 0}, {0, 30, 0}, {0, 0, 3.5}, b.add_diffuse(0.5));
    const LuminaireTypeId lamp = b.add_isotropic_type(300.0);
    LedgerLayout layout;
    layout.sources = 7;
    for (int i = 0; i < 100; ++i) {
        const double x = 2.0 + 4.0 * (i % 10);
        const double y = 2.0 + 4.0 * static_cast<double>(i / 10);
        if (i % 3 == 0)
            b.add_point({x, y, 3.5}, lamp);
        else
            b.add_panel({x, y, 3.9}, {0, 1, 0}, {1, 0, 0}, 3000.0);
        layout.source_of.push_back(static_cast<std::uint32_t>(i % 7));
    }
    const Scene scene = b.build();
    const Emission emission(scene);
    const MirrorImages images(scene);
    const DirectLight direct(scene, emission, images);
    const Receiver receiver{{9.0, 9.0, 0.75}, UnitVector3::from_unit({0, 0, 1})};
    std::uint64_t rays = 0;
    const DirectPlan plan = direct.plan(receiver, 0, 1, true, rays);
    EXPECT_FALSE(plan.terms.empty());
    EXPECT_FALSE(plan.openings.empty());
    EXPECT_FALSE(plan.tail.empty());
    std::vector<Rgb> total(replicates);
    std::vector<double> by_source(7 * replicates, 0.0);
    direct.estimate(receiver, plan, 0, 1, 0, {}, 0, {total, &layout, by_source, {}}, rays);
    for (std::size_t r = 0; r < replicates; ++r) {
        double sum = 0.0;
        for (std::size_t s = 0; s < 7; ++s)
            sum += by_source[s * replicates + r];
        EXPECT_NEAR(sum, luminance_sum(total[r]), 1e-12 * sum) << r;
    }
}

} // namespace
} // namespace isolux
