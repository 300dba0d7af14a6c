#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/validate/enclosure.h"
#include "isolux/validate/form_factor.h"
#include "isolux/validate/integrating_sphere.h"

#include "support/printed.h"

namespace isolux {
namespace {

using std::numbers::pi;

const Metre one{1.0};
const Lumen klm{1000.0};

TEST(IntegratingSphere, GivesTheReferenceValues) {
    const double indirect = in_lux(sphere_indirect(one, 0.8, klm));
    EXPECT_TRUE(test::agrees(indirect, 318.30989, 8));
    EXPECT_TRUE(test::agrees(
        indirect + in_lux(sphere_direct(one, klm, Metre(0.0), degrees(77))), 397.88736, 8));
    const double expected[] = {636.62, 507.941, 410.198, 375.251, 361.278, 355.357, 353.678};
    for (int k = 0; k < 7; ++k)
        EXPECT_TRUE(test::agrees(
            indirect + in_lux(sphere_direct(one, klm, Metre(0.5), degrees(30.0 * k))),
            expected[k],
            6))
            << 30 * k << " degrees";
}

TEST(IntegratingSphere, ZonesShareOneReflectedIlluminance) {
    const auto indirect = [](double source) {
        const Metre border(-0.2);
        const SquareMetre below = sphere_cap_area(one, border);
        const Lumen onto_it = sphere_cap_flux(one, border, klm, Metre(source));
        const std::array<SphereZone, 2> zones = {
            {{0.3, below, onto_it}, {0.7, SquareMetre(4.0 * pi) - below, klm - onto_it}}};
        return in_lux(sphere_indirect(zones));
    };
    EXPECT_TRUE(test::agrees(indirect(0.0), 93.417032, 8)) << indirect(0.0);
    EXPECT_TRUE(test::agrees(indirect(0.35), 103.43319, 8)) << indirect(0.35);
}

TEST(IntegratingSphere, ZonesOfOneReflectanceAreNoZones) {
    const SquareMetre below = sphere_cap_area(Metre(2.0), Metre(0.7));
    const Lumen onto_it = sphere_cap_flux(Metre(2.0), Metre(0.7), klm, Metre(-1.1));
    const std::array<SphereZone, 2> zones = {
        {{0.6, below, onto_it}, {0.6, SquareMetre(16.0 * pi) - below, klm - onto_it}}};
    EXPECT_NEAR(
        in_lux(sphere_indirect(zones)), in_lux(sphere_indirect(Metre(2.0), 0.6, klm)), 1e-12);
}

TEST(IntegratingSphere, CapFluxCountsTheWholeSphereAndTheHalf) {
    EXPECT_DOUBLE_EQ(in_lumen(sphere_cap_flux(one, one, klm, Metre(0.4))), 1000.0);
    EXPECT_NEAR(in_lumen(sphere_cap_flux(one, Metre(-1.0), klm, Metre(0.4))), 0.0, 1e-12);
    EXPECT_DOUBLE_EQ(in_lumen(sphere_cap_flux(one, Metre(0.3), klm, Metre(0.3))), 500.0);
}

TEST(ConcentricSpheres, BalanceTheirFlux) {
    const ConcentricSpheres s{0.6, 500.0, 0.4, 0.7};
    const ConcentricIlluminance e = concentric_illuminance(s);
    // In areas of the outer sphere: emitted = absorbed on both.
    const double k = 0.36;
    EXPECT_NEAR(k * 500.0, k * 0.6 * in_lux(e.inner) + 0.3 * in_lux(e.outer), 1e-10);
    // The outer sphere sees the inner one and itself: E2 = k (M + rho1 E1) + (1 - k) rho2 E2.
    EXPECT_NEAR(in_lux(e.outer),
                k * (500.0 + 0.4 * in_lux(e.inner)) + (1.0 - k) * 0.7 * in_lux(e.outer),
                1e-10);
}

TEST(Enclosure, FurnaceAndClosedRoom) {
    EXPECT_DOUBLE_EQ(in_lux(furnace_illuminance(100.0, 0.75)), 400.0);
    // Cube of 4 m, 10 000 lm, rho 0.5: 104.17 lx direct and as much again by reflection.
    EXPECT_DOUBLE_EQ(in_lux(closed_room_mean(Lumen(1e4), SquareMetre(96.0), 0.5)), 1e4 / 48.0);
    EXPECT_DOUBLE_EQ(in_lux(closed_room_mean_indirect(Lumen(1e4), SquareMetre(96.0), 0.5)),
                     1e4 / 96.0);
    // A sphere is a closed room.
    EXPECT_DOUBLE_EQ(in_lux(closed_room_mean_indirect(klm, SquareMetre(4.0 * pi), 0.8)),
                     in_lux(sphere_indirect(one, 0.8, klm)));
}

TEST(FormFactor, GivesTheReferenceValues) {
    EXPECT_TRUE(test::agrees(parallel_form_factor(2, 2, 1), 0.415253284, 9));
    EXPECT_TRUE(test::agrees(perpendicular_form_factor(1, 2, 1), 0.116426301, 9));
}

TEST(FormFactor, SumsToOneInABox) {
    // Floor of a box 4 x 3 x 2.5 m sees the ceiling and four walls.
    const double sum = parallel_form_factor(4, 3, 2.5)
                       + 2.0 * perpendicular_form_factor(4, 3, 2.5)
                       + 2.0 * perpendicular_form_factor(3, 4, 2.5);
    EXPECT_NEAR(sum, 1.0, 1e-14);
}

TEST(FormFactor, IsReciprocal) {
    EXPECT_NEAR(2.0 * perpendicular_form_factor(1.5, 2.0, 0.7),
                0.7 * perpendicular_form_factor(1.5, 0.7, 2.0),
                1e-15);
}

} // namespace
} // namespace isolux
