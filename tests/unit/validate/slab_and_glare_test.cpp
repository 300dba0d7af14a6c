#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/validate/glare.h"
#include "isolux/validate/slab.h"

#include "support/printed.h"

namespace isolux {
namespace {

TEST(ExactSlab, GivesTheReferenceTransmittances) {
    const ClearSlab glass{1.5, 1.0};
    const double table[][2] = {{0, 0.9230769},
                               {10, 0.9230531},
                               {20, 0.9226673},
                               {30, 0.9207344},
                               {40, 0.9142615},
                               {50, 0.8959746},
                               {60, 0.8481284},
                               {70, 0.7287121},
                               {75, 0.6181485},
                               {80, 0.4584728},
                               {85, 0.2469306},
                               {89, 0.05067896}};
    for (const auto& [angle, t] : table) {
        const SlabShares s = exact_slab(glass, std::cos(degrees(angle).in_radians()));
        EXPECT_TRUE(test::agrees(s.transmittance, t, 7)) << angle << ": " << s.transmittance;
        EXPECT_NEAR(s.transmittance + s.reflectance, 1.0, 1e-15);
    }
    EXPECT_TRUE(test::agrees(exact_diffuse_transmittance(glass), 0.8509383, 7));
}

TEST(ExactSlab, AbsorbsAlongTheBentRay) {
    // 4 % at each face at normal incidence, 80 % inside: sums of the geometric series.
    const double r = 0.04, a = 0.8;
    const SlabShares s = exact_slab({1.5, 0.8}, 1.0);
    double t = 0.0, reflected = r, inside = (1 - r) * a;
    for (int k = 0; k < 100; ++k) {
        t += inside * (1 - r);
        inside *= r * a;
        reflected += inside * (1 - r);
        inside *= r * a;
    }
    EXPECT_NEAR(s.transmittance, t, 1e-15);
    EXPECT_NEAR(s.reflectance, reflected, 1e-15);
    // At 60 degrees the way inside is longer by 1/cos(asin(sin 60/1.5)).
    EXPECT_LT(exact_slab({1.5, 0.8}, 0.5).transmittance,
              0.8 * exact_slab({1.5, 1.0}, 0.5).transmittance);
}

TEST(ExactSlab, AtGrazingIncidenceReflectsEverything) {
    EXPECT_EQ(exact_slab({1.5, 0.9}, 0.0).transmittance, 0.0);
    EXPECT_EQ(exact_slab({1.5, 0.9}, 0.0).reflectance, 1.0);
    EXPECT_EQ(exact_slab({1.0, 1.0}, 0.3).transmittance, 1.0);
}

TEST(Glare, GivesTheReferenceRating) {
    std::vector<GlareSource> panels;
    for (const double x : {-2.0, 0.0, 2.0})
        for (const double y : {2.0, 4.0, 6.0})
            panels.push_back(see_glare_source({0.5, 0, 1.2},
                                              UnitVector3::from_unit({0, 1, 0}),
                                              UnitVector3::from_unit({0, 0, 1}),
                                              {x, y, 2.8},
                                              UnitVector3::from_unit({0, 0, -1}),
                                              SquareMetre(0.36),
                                              CandelaPerSquareMetre(3000.0)));
    const GlareSource& first = panels.front();
    EXPECT_TRUE(test::agrees(first.distance, 3.579106, 7));
    EXPECT_TRUE(test::agrees(first.from_sight.in_degrees(), 56.02724, 7));
    EXPECT_TRUE(test::agrees(first.from_vertical.in_degrees(), 57.38076, 7));
    EXPECT_TRUE(test::agrees(guth_index(first.from_sight, first.from_vertical), 5.931357, 7));
    EXPECT_TRUE(test::agrees(first.solid_angle.value(), 0.01256316, 7));
    EXPECT_TRUE(test::agrees(exact_ugr(panels, CandelaPerSquareMetre(30.0)), 22.19262, 7));
}

TEST(Glare, IsTheSameInTheMirrorAndBlindBehind) {
    const auto see = [](double x, double y) {
        return see_glare_source({0, 0, 1.2},
                                UnitVector3::from_unit({0, 1, 0}),
                                UnitVector3::from_unit({0, 0, 1}),
                                {x, y, 2.8},
                                UnitVector3::from_unit({0, 0, -1}),
                                SquareMetre(0.36),
                                CandelaPerSquareMetre(3000.0));
    };
    const CandelaPerSquareMetre background(25.0);
    const GlareSource left[] = {see(-1.5, 3)}, right[] = {see(1.5, 3)},
                      both[] = {see(1.5, 3), see(1.5, -3)};
    EXPECT_EQ(exact_ugr(left, background), exact_ugr(right, background));
    EXPECT_EQ(exact_ugr(both, background), exact_ugr(right, background));
    EXPECT_DOUBLE_EQ(guth_index(degrees(0), degrees(40)), 1.0);
}

} // namespace
} // namespace isolux
