#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include "isolux/validate/sobolev.h"

#include "support/printed.h"

namespace isolux {
namespace {

using std::numbers::pi;

/// Separation 1 m, intensity 1 cd.
SobolevProblem unit_problem(double rho1, double rho2, double h1) {
    return {rho1, rho2, Metre(1.0), Metre(h1), Lumen(4.0 * pi)};
}

double e1(const SobolevProblem& p, double r) {
    return in_lux(sobolev_illuminance(p, SobolevPlane::one, Metre(r)));
}

double e2(const SobolevProblem& p, double r) {
    return in_lux(sobolev_illuminance(p, SobolevPlane::two, Metre(r)));
}

// A series and a Nystrom solution that uses no transform agree on these to 2e-10; seven digits.
TEST(Sobolev, GivesTheReferenceValuesOnBothPlanes) {
    const SobolevProblem a = unit_problem(0.3, 0.6, 0.4);
    const SobolevProblem b = unit_problem(0.6, 0.6, 0.5);
    const SobolevProblem c = unit_problem(0.8, 0.4, 0.6);
    const std::array<double, 7> table[] = {
        // r, then E1 and E2 of the three problems
        {0, 6.758417, 3.132893, 4.692441, 4.692441, 3.310327, 7.008896},
        {0.25, 4.299114, 2.522118, 3.526374, 3.526374, 2.692718, 4.541439},
        {0.5, 1.957404, 1.551504, 2.004845, 2.004845, 1.704462, 2.177972},
        {0.75, 1.0142, 0.9137074, 1.178704, 1.178704, 1.044241, 1.205583},
        {1, 0.6112998, 0.5624607, 0.7596389, 0.7596389, 0.6707966, 0.772103},
        {1.5, 0.2834417, 0.2498886, 0.3795344, 0.3795344, 0.3224809, 0.3919387},
        {2, 0.1529265, 0.1296925, 0.2167174, 0.2167174, 0.1784433, 0.2253381},
        {3, 0.05577366, 0.04599678, 0.08674228, 0.08674228, 0.06906499, 0.08956532},
        {4, 0.02471231, 0.02035107, 0.04090968, 0.04090968, 0.03206456, 0.04176804},
        {5, 0.01253467, 0.01038515, 0.02151115, 0.02151115, 0.01674058, 0.02177144},
        {7.5, 0.003403342, 0.002881179, 0.005953259, 0.005953259, 0.004642201, 0.005966334},
        {10, 0.001319495, 0.001138923, 0.002252943, 0.002252943, 0.001781465, 0.002258411},
    };
    for (const auto& row : table) {
        const double r = row[0];
        const double computed[] = {e1(a, r), e2(a, r), e1(b, r), e2(b, r), e1(c, r), e2(c, r)};
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_TRUE(test::agrees(computed[k], row[k + 1], 7))
                << "r " << r << " column " << k + 1 << ": " << computed[k];
    }
}

// Another set, printed with seven decimals; plane 1.
TEST(Sobolev, GivesTheReferenceValuesOfPlaneOne) {
    const double radii[] = {0, 0.25, 0.5, 1, 2, 3, 5};

    const struct {
        SobolevProblem problem;
        double e[7];
    } rows[] = {
        {unit_problem(0.5, 0.5, 0.5),
         {4.5281295, 3.3674925, 1.8602901, 0.6534423, 0.1664977, 0.0621502, 0.0143926}},
        {unit_problem(0.8, 0.3, 0.5),
         {4.3535840, 3.2012749, 1.7155403, 0.5617334, 0.1354626, 0.0500413, 0.0115654}},
        {unit_problem(0.7, 0.7, 0.3),
         {11.9104190, 5.8126516, 2.2230336, 0.7879524, 0.2736633, 0.1221932, 0.0339419}},
    };

    for (const auto& row : rows)
        for (std::size_t i = 0; i < 7; ++i)
            EXPECT_NEAR(e1(row.problem, radii[i]), row.e[i], 0.5001e-7) << "r " << radii[i];
}

TEST(Sobolev, ScalesWithFluxAndSeparation) {
    const SobolevProblem p{0.3, 0.6, Metre(2.0), Metre(0.8), Lumen(1000.0)};
    const double radii[] = {0, 1, 2, 4, 10};
    const double plane1[] = {134.454, 38.9413, 12.1614, 3.04238, 0.249369};
    const double plane2[] = {62.3269, 30.8662, 11.1898, 2.58015, 0.206606};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_TRUE(test::agrees(e1(p, radii[i]), plane1[i], 6)) << e1(p, radii[i]);
        EXPECT_TRUE(test::agrees(e2(p, radii[i]), plane2[i], 6)) << e2(p, radii[i]);
    }
}

TEST(Sobolev, BlackPlanesLeaveTheDirectLight) {
    const SobolevProblem p = unit_problem(0.7, 0.0, 0.25);
    EXPECT_EQ(in_lux(sobolev_indirect(p, SobolevPlane::one, Metre(0.5))), 0.0);
    EXPECT_DOUBLE_EQ(e1(p, 0.5), 0.25 / std::pow(0.25 * 0.25 + 0.25, 1.5));
}

/// One reflection, rho1 = 0, summed in the plane without any transform. The kernel
/// 1/(pi s^4) integrated over the azimuth is 2 a/(a^2 - b^2)^(3/2) with a = 1 + r^2 + q^2,
/// b = 2 r q. With q = t/(1 - t) the rest is an integral over 0..1 whose only hills are at the
/// foot of the source and at q = r.
double one_reflection(double rho2, double h2, double r) {
    using Rule = boost::math::quadrature::gauss<double, 30>;
    const auto f = [=](double t) {
        const double q = t / (1.0 - t);
        const double near = 1.0 + (r - q) * (r - q);
        const double far = 1.0 + (r + q) * (r + q);
        const double kernel = 2.0 * (1.0 + r * r + q * q) / std::pow(near * far, 1.5);
        const double direct = h2 / std::pow(h2 * h2 + q * q, 1.5);
        return kernel * direct * q / ((1.0 - t) * (1.0 - t));
    };
    const auto over = [&](double q0, double q1) {
        constexpr int panels = 200;
        const double t0 = q0 / (1.0 + q0);
        const double t1 = q1 / (1.0 + q1);
        double sum = 0.0;
        for (int k = 0; k < panels; ++k)
            sum += Rule::integrate(
                f, t0 + (t1 - t0) * k / panels, t0 + (t1 - t0) * (k + 1) / panels);
        return sum;
    };
    const double before = std::max(0.0, r - 20.0);
    return rho2 * (over(0.0, before) + over(before, r + 20.0) + over(r + 20.0, 1e9));
}

TEST(Sobolev, FirstReflectionEqualsTheIntegralOverTheOtherPlane) {
    for (const double h1 : {0.02, 0.4, 0.9})
        for (const double r : {0.0, 0.3, 1.0, 4.0, 30.0, 300.0}) {
            const double expected = one_reflection(0.6, 1.0 - h1, r);
            const double computed = in_lux(
                sobolev_indirect(unit_problem(0.0, 0.6, h1), SobolevPlane::one, Metre(r)));
            EXPECT_NEAR(computed, expected, 1e-8 * expected) << "h1 " << h1 << " r " << r;
        }
}

// Illuminance integrated over a plane is the flux on it. The rings are exact to 1e-9; beyond
// R = 40 H the light falls like c/r^3, c taken at R (error of that: of order 1/R of the tail).
TEST(Sobolev, IlluminanceIntegratesToTheFlux) {
    const SobolevProblem p{0.5, 0.7, Metre(1.0), Metre(0.3), Lumen(1000.0)};
    using Rule = boost::math::quadrature::gauss<double, 15>;
    for (const SobolevPlane plane : {SobolevPlane::one, SobolevPlane::two}) {
        const auto ring = [&](double r) {
            return 2.0 * pi * r * in_lux(sobolev_illuminance(p, plane, Metre(r)));
        };
        double sum = 0.0;
        double inner = 0.0;
        for (const double outer : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 40.0}) {
            sum += Rule::integrate(ring, inner, outer);
            inner = outer;
        }
        const double tail = ring(inner) * inner; // integral of ring ~ r^-2 beyond `inner`
        EXPECT_NEAR(sum + tail, in_lumen(sobolev_flux(p, plane)), tail / 2);
        EXPECT_LT(tail, 0.06 * sum);
    }
}

TEST(Sobolev, FluxOfBothPlanesIsAbsorbedFlux) {
    const SobolevProblem p{0.9, 0.2, Metre(3.0), Metre(1.0), Lumen(800.0)};
    EXPECT_NEAR(0.1 * in_lumen(sobolev_flux(p, SobolevPlane::one))
                    + 0.8 * in_lumen(sobolev_flux(p, SobolevPlane::two)),
                800.0,
                1e-10);
}

TEST(Sobolev, IsStableForReflectancesNearOne) {
    // Near 1 the integrand has a peak of width sqrt(1 - rho1 rho2); the flux in the middle must
    // still grow smoothly: E(0) - E(0; rho) shrinks as rho -> 1.
    const double e999 = e1(unit_problem(0.999, 0.999, 0.5), 0.0);
    const double e9999 = e1(unit_problem(0.9999, 0.9999, 0.5), 0.0);
    const double e99999 = e1(unit_problem(0.99999, 0.99999, 0.5), 0.0);
    EXPECT_GT(e9999, e999);
    EXPECT_GT(e99999, e9999);
    EXPECT_TRUE(std::isfinite(e99999));
}

} // namespace
} // namespace isolux
