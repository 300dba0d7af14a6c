#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/measure/energy.h"
#include "isolux/measure/glare.h"
#include "isolux/validate/glare.h"

namespace isolux {
namespace {

/// Nine 0.6 x 0.6 m panels at z = 2.8 m that face down, L = 3000 cd/m2.
std::vector<GlareSourcePart> nine_panels(const Point3& eye) {
    std::vector<GlareSourcePart> parts;
    for (const double x : {-2.0, 0.0, 2.0})
        for (const double y : {2.0, 4.0, 6.0}) {
            const Vector3 d = Point3{x, y, 2.8} - eye;
            const double r = length(d);
            parts.push_back({3000.0, 0.36 * (d.z / r) / (r * r), UnitVector3(d)});
        }
    return parts;
}

/// An illuminance whose background luminance is 30 cd/m2.
const std::vector<double> background_of_thirty(16, 30.0 * std::numbers::pi);

TEST(Ugr, OfTheReferenceInstallationIsItsPrintedFigure) {
    const UnitVector3 sight = UnitVector3::from_unit({0, 1, 0});
    const auto parts = nine_panels({0.5, 0, 1.2});
    EXPECT_NEAR(position_index(sight, parts[0].towards), 5.931357, 5e-7);
    EXPECT_NEAR(parts[0].solid_angle, 0.01256316, 5e-9);
    const double sum = glare_sum(sight, parts, GlareSources::in_front);
    const Estimate ugr = unified_glare_rating(sum, background_of_thirty);
    EXPECT_NEAR(ugr.mean, 22.19262, 5e-6);
    EXPECT_NEAR(ugr.standard_error, 0.0, 1e-9);
}

TEST(Ugr, IsTheSameForTheMirrorImageOfAnObserver) {
    const UnitVector3 sight = UnitVector3::from_unit({0, 1, 0});
    EXPECT_NEAR(glare_sum(sight, nine_panels({0.5, 0, 1.2}), GlareSources::in_front),
                glare_sum(sight, nine_panels({-0.5, 0, 1.2}), GlareSources::in_front),
                1e-9);
}

TEST(Ugr, AgreesWithTheIndependentFormulaInAnyDirection) {
    const Point3 eye{0.3, 1.0, 1.5};
    for (const double azimuth : {0.0, 0.7, 2.0, 3.9}) {
        const UnitVector3 sight =
            UnitVector3::from_unit({std::cos(azimuth), std::sin(azimuth), 0});
        std::vector<GlareSource> sources;
        for (const double x : {-2.0, 0.0, 2.0})
            for (const double y : {2.0, 4.0, 6.0})
                sources.push_back(see_glare_source(eye,
                                                   sight,
                                                   UnitVector3::from_unit({0, 0, 1}),
                                                   {x, y, 2.8},
                                                   UnitVector3::from_unit({0, 0, -1}),
                                                   SquareMetre(0.36),
                                                   CandelaPerSquareMetre(3000)));
        EXPECT_NEAR(
            unified_glare_rating(glare_sum(sight, nine_panels(eye), GlareSources::in_front),
                                 background_of_thirty)
                .mean,
            exact_ugr(sources, CandelaPerSquareMetre(30)),
            1e-9);
    }
}

TEST(Ugr, CountsEverySourceInFrontOfTheEyeAndOnTheWishOnlyThoseInTheTable) {
    const UnitVector3 sight = UnitVector3::from_unit({0, 1, 0});
    const GlareSourcePart steep{3000, 0.01, UnitVector3(Vector3{0, 1, 2.5})};
    const GlareSourcePart behind{3000, 0.01, UnitVector3(Vector3{0, -1, 1})};
    EXPECT_GT(glare_sum(sight, {&steep, 1}, GlareSources::in_front), 0.0);
    EXPECT_EQ(glare_sum(sight, {&steep, 1}, GlareSources::in_table), 0.0);
    EXPECT_EQ(glare_sum(sight, {&behind, 1}, GlareSources::in_front), 0.0);
}

TEST(Ugr, HasAnErrorFromItsBackgroundAndGrowsByEightForATenthOfIt) {
    std::vector<double> e;
    for (int r = 0; r < 16; ++r)
        e.push_back(100.0 + (r % 2 == 0 ? 1.0 : -1.0));
    const Estimate u = unified_glare_rating(1e5, e);
    const double relative = estimate_from_replicates(e).standard_error / 100.0;
    EXPECT_NEAR(u.standard_error, 8.0 / std::log(10.0) * relative, 1e-4);
    const std::vector<double> darker(16, 10.0);
    const std::vector<double> even(16, 100.0);
    EXPECT_NEAR(unified_glare_rating(1e5, darker).mean - unified_glare_rating(1e5, even).mean,
                8.0,
                1e-9);
}

TEST(Ugr, HasNoValueWithoutSourcesOrBackground) {
    EXPECT_EQ(unified_glare_rating(0.0, background_of_thirty).samples, 0U);
    EXPECT_EQ(unified_glare_rating(1.0, std::vector<double>(16, 0.0)).samples, 0U);
}

TEST(OutdoorGlare, FollowsItsFormula) {
    const std::vector<double> background(16, 0.5);
    EXPECT_NEAR(outdoor_glare_rating(1.0, background).mean,
                27.0 + 24.0 * std::log10(1.0 / std::pow(0.5, 0.9)),
                1e-9);
}

TEST(Energy, IsPowerTimesHoursPerArea) {
    // 100 W over 10 m2: 2250 h by day at F_D 0.8 and 250 h by night, F_O 0.9, F_C 0.95
    const EnergyUse use{2250, 250, 0.95, 0.9, 0.8, 1.5};
    EXPECT_NEAR(lighting_energy(100, 10, use),
                100 * 0.95 * (2250 * 0.9 * 0.8 + 250 * 0.9) / (1000 * 10) + 1.5,
                1e-12);
    EXPECT_NEAR(lighting_energy(100, 10, EnergyUse{}), 25.0, 1e-12);
}

} // namespace
} // namespace isolux
