#include "isolux/validate/sobolev.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/bessel.hpp>

#include "isolux/base/check.h"

namespace isolux {

namespace {

using std::numbers::pi;

/// The problem in units of the separation, seen from one plane: `own` and `other` are the
/// reflectances of that plane and of the one opposite, `near` and `far` the source's distances.
struct View {
    double own;
    double other;
    double near;
    double far;
};

View view_from(const SobolevProblem& p, SobolevPlane plane) noexcept {
    ISOLUX_EXPECT(p.separation.value() > 0.0 && p.source_height.value() > 0.0
                  && p.source_height < p.separation);
    ISOLUX_EXPECT(p.reflectance_1 >= 0.0 && p.reflectance_2 >= 0.0
                  && p.reflectance_1 * p.reflectance_2 < 1.0);
    const double h1 = p.source_height / p.separation;
    if (plane == SobolevPlane::one)
        return {p.reflectance_1, p.reflectance_2, h1, 1.0 - h1};
    return {p.reflectance_2, p.reflectance_1, 1.0 - h1, h1};
}

/// Illuminance of intensity 1 cd and separation 1 m, in the units of the problem.
double candela_per_square_metre_of(const SobolevProblem& p) noexcept {
    return in_lumen(p.flux) / (4.0 * pi * in_metre(p.separation) * in_metre(p.separation));
}

/// What stands under the integral of METHODS eq. (30), without the factor rho of the plane
/// opposite. k K1(k) -> 1 as k -> 0.
double integrand(const View& v, double r, double k) {
    const double k1 = boost::math::cyl_bessel_k(1, k);
    const double kernel = k * k1;
    return (std::exp(-v.far * k) + v.own * kernel * std::exp(-v.near * k))
           / (1.0 - v.own * v.other * kernel * kernel) * kernel * k
           * boost::math::cyl_bessel_j(0, k * r);
}

/// Gauss-Legendre over panels that halve towards k = 0, where the integrand has terms k^3 ln k
/// and, for reflectances near 1, a peak as narrow as sqrt(1 - rho1 rho2); each panel is cut so
/// that it spans less than one period of J0(k r). The integrand falls like
/// exp(-(1 + min(near, far)) k): beyond 45/(1 + min) nothing is left.
double integral(const View& v, double r) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    const double top = 45.0 / (1.0 + std::min(v.near, v.far));
    const double widest = std::min(2.0, 6.0 / std::max(r, 1e-3));
    constexpr int halvings = 60;
    const auto f = [&](double k) { return integrand(v, r, k); };
    double sum = 0.0;
    double upper = top;
    for (int j = 0; j < halvings; ++j) {
        const double lower = j + 1 < halvings ? 0.5 * upper : 0.0;
        const int cuts = std::max(1, static_cast<int>(std::ceil((upper - lower) / widest)));
        const double width = (upper - lower) / cuts;
        for (int c = 0; c < cuts; ++c)
            sum += Rule::integrate(f, lower + c * width, lower + (c + 1) * width);
        upper = lower;
    }
    return sum;
}

} // namespace

Lux sobolev_direct(const SobolevProblem& problem, SobolevPlane plane, Metre r) noexcept {
    const View v = view_from(problem, plane);
    const double x = r / problem.separation;
    const double d2 = v.near * v.near + x * x;
    return Lux(candela_per_square_metre_of(problem) * v.near / (d2 * std::sqrt(d2)));
}

Lux sobolev_indirect(const SobolevProblem& problem, SobolevPlane plane, Metre r) {
    ISOLUX_EXPECT(r.value() >= 0.0);
    const View v = view_from(problem, plane);
    if (v.other == 0.0)
        return Lux(0.0);
    return Lux(candela_per_square_metre_of(problem) * v.other
               * integral(v, r / problem.separation));
}

Lux sobolev_illuminance(const SobolevProblem& problem, SobolevPlane plane, Metre r) {
    return sobolev_direct(problem, plane, r) + sobolev_indirect(problem, plane, r);
}

Lux sobolev_indirect_ring(const SobolevProblem& problem,
                          SobolevPlane plane,
                          Metre inner,
                          Metre outer) {
    ISOLUX_EXPECT(inner.value() >= 0.0 && inner < outer);
    using Rule = boost::math::quadrature::gauss<double, 10>;
    const auto f = [&](double r) {
        return r * in_lux(sobolev_indirect(problem, plane, Metre(r)));
    };
    const double a = in_metre(inner);
    const double b = in_metre(outer);
    return Lux(2.0 * Rule::integrate(f, a, b) / (b * b - a * a));
}

Lux sobolev_direct_ring(const SobolevProblem& problem,
                        SobolevPlane plane,
                        Metre inner,
                        Metre outer) noexcept {
    const View v = view_from(problem, plane);
    const double a = inner / problem.separation;
    const double b = outer / problem.separation;
    // The flux through a disc is Phi/2 (1 - h/sqrt(h^2 + r^2)); the ring's is the difference.
    const double flux =
        2.0 * pi * v.near * (1.0 / std::hypot(v.near, a) - 1.0 / std::hypot(v.near, b));
    return Lux(candela_per_square_metre_of(problem) * flux / (pi * (b * b - a * a)));
}

Lumen sobolev_flux(const SobolevProblem& problem, SobolevPlane plane) noexcept {
    const View v = view_from(problem, plane);
    return Lumen(0.5 * in_lumen(problem.flux) * (1.0 + v.other) / (1.0 - v.own * v.other));
}

} // namespace isolux
