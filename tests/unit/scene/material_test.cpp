#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "isolux/base/angle.h"
#include "isolux/scene/material.h"

namespace isolux {
namespace {

double transmittance_at(const ClearPane& pane, double angle) {
    return evaluate_slab(pane, std::cos(degrees(angle).in_radians())).transmittance;
}

TEST(Slab, AgreesWithTheTabulatedTransmittancesOfClearGlass) {
    // n = 1.5 without absorption; to the seven figures of the table
    const double expected[][2] = {{0, 0.9230769},
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
    for (const auto& [angle, T] : expected)
        EXPECT_NEAR(transmittance_at({1.5, 1.0}, angle), T, 0.6e-7) << angle;
}

TEST(Slab, DiffuseTransmittanceIsTheCosineWeightedMean) {
    // T averaged over d(sin^2): midpoint rule, whose error falls as 1/n^2 beside a mild
    // singularity at grazing angles
    constexpr int n = 1000000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        sum += evaluate_slab({1.5, 1.0}, std::sqrt((i + 0.5) / n)).transmittance;
    EXPECT_NEAR(sum / n, 0.8509383, 1e-7);
}

TEST(Slab, LosesNothingWithoutAbsorptionAndTheRestWithIt) {
    for (double angle = 0.0; angle < 90.0; angle += 0.5) {
        const double c = std::cos(degrees(angle).in_radians());
        const auto clear = evaluate_slab({1.52, 1.0}, c);
        EXPECT_NEAR(clear.transmittance + clear.reflectance, 1.0, 1e-14);
        const auto tinted = evaluate_slab({1.52, 0.6}, c);
        EXPECT_LT(tinted.transmittance + tinted.reflectance, 1.0);
        EXPECT_LT(tinted.transmittance, clear.transmittance);
        EXPECT_LT(tinted.reflectance, clear.reflectance);
    }
}

TEST(Slab, NormalIncidenceWithAbsorptionIsTheClosedForm) {
    const double r = std::pow((1.52 - 1.0) / (1.52 + 1.0), 2), a = 0.7;
    const auto slab = evaluate_slab({1.52, a}, 1.0);
    EXPECT_NEAR(slab.transmittance, (1 - r) * (1 - r) * a / (1 - r * r * a * a), 1e-15);
    EXPECT_NEAR(slab.reflectance, r * (1 + slab.transmittance * a), 1e-15);
}

TEST(Slab, EndsOfTheRangeAreSafe) {
    for (const double c : {0.0, -0.1, 1e-300, 1e-12, 1.0, 1.0 + 1e-15})
        for (const ClearPane pane :
             {ClearPane{1.52, 1.0}, {1.0, 1.0}, {1.52, 0.0}, {0.8, 0.5}}) {
            const auto slab = evaluate_slab(pane, c);
            EXPECT_GE(slab.transmittance, 0.0);
            EXPECT_GE(slab.reflectance, 0.0);
            EXPECT_LE(slab.transmittance + slab.reflectance, 1.0 + 1e-12);
        }
    EXPECT_EQ(evaluate_slab({1.52, 1.0}, 0.0).reflectance, 1.0);
    EXPECT_NEAR(evaluate_slab({1.0, 1.0}, 0.3).transmittance, 1.0, 1e-15); // air in air
    EXPECT_EQ(evaluate_slab({0.5, 1.0}, 0.5).transmittance, 0.0);          // total reflection
}

TEST(EverydayMaterials, AreFoundByNameAndPhysicallyPossible) {
    std::set<std::string> names;
    for (const Material& m : everyday_materials()) {
        EXPECT_TRUE(names.insert(m.name).second) << m.name << " twice";
        EXPECT_EQ(find_everyday_material(m.name), &m);
        if (const auto* opaque = std::get_if<Opaque>(&m.scattering)) {
            EXPECT_LE(max_channel(opaque->diffuse) + opaque->mirror, 0.95) << m.name;
            EXPECT_GE(opaque->mirror, 0.0);
        } else {
            const auto& pane = std::get<ClearPane>(m.scattering);
            EXPECT_GT(pane.refractive_index, 1.0);
            EXPECT_LE(pane.internal_transmittance, 1.0);
        }
    }
    EXPECT_GE(names.size(), 30U);
    for (const char* name :
         {"white paint", "oak", "mirror", "window glass", "concrete", "black"})
        EXPECT_NE(find_everyday_material(name), nullptr) << name;
    EXPECT_EQ(find_everyday_material("unobtainium"), nullptr);
}

TEST(EverydayMaterials, WindowGlassPassesNinetyPercent) {
    const auto& pane = std::get<ClearPane>(find_everyday_material("window glass")->scattering);
    // what makers state for 4 mm of clear float glass, to the two figures they give
    EXPECT_NEAR(evaluate_slab(pane, 1.0).transmittance, 0.90, 0.005);
}

} // namespace
} // namespace isolux
