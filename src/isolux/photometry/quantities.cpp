#include "isolux/photometry/quantities.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Trapezoid rule between two gammas on one interval of the table; nadir poles.
double flux_of_band(const IntensityDistribution& d, double lower, double upper) noexcept {
    const auto planes = d.planes();
    double sum = 0.0;
    const auto value = [&](std::size_t p, double g) {
        return d.evaluate(planes[p], radians(g)).value();
    };
    for (std::size_t p = 0; p + 1 < planes.size(); ++p)
        sum +=
            0.25 * (planes[p + 1] - planes[p]).in_radians()
            * (value(p, lower) + value(p, upper) + value(p + 1, lower) + value(p + 1, upper));
    return sum * (std::cos(lower) - std::cos(upper));
}

/// Rings of a table on lateral poles do not follow its own angles: midpoint rule on a fine
/// grid.
double flux_of_ring(const IntensityDistribution& d, double lower, double upper) noexcept {
    constexpr int rings = 90;
    constexpr int sectors = 720;
    double sum = 0.0;
    for (int r = 0; r < rings; ++r) {
        const double a = lower + (upper - lower) * r / rings;
        const double b = lower + (upper - lower) * (r + 1) / rings;
        const double g = 0.5 * (a + b);
        double ring = 0.0;
        for (int s = 0; s < sectors; ++s) {
            const double c = 2.0 * pi * (s + 0.5) / sectors;
            ring += d.evaluate(UnitVector3::from_unit({std::sin(g) * std::cos(c),
                                                       std::sin(g) * std::sin(c),
                                                       -std::cos(g)}))
                        .value();
        }
        sum += ring * (std::cos(a) - std::cos(b)) * 2.0 * pi / sectors;
    }
    return sum;
}

} // namespace

Lumen flux_between(const IntensityDistribution& d, Angle lower, Angle upper) noexcept {
    if (d.pole() == TablePole::lateral)
        return Lumen(flux_of_ring(d, lower.in_radians(), upper.in_radians()));
    const auto gammas = d.gammas();
    double sum = 0.0;
    for (std::size_t g = 0; g + 1 < gammas.size(); ++g) {
        const Angle a = std::max(lower, gammas[g]);
        const Angle b = std::min(upper, gammas[g + 1]);
        if (a < b)
            sum += flux_of_band(d, a.in_radians(), b.in_radians());
    }
    return Lumen(sum);
}

double downward_fraction(const IntensityDistribution& d) noexcept {
    const double all = d.flux_trapezoid().value();
    if (!(all > 0.0))
        return 0.0;
    if (d.pole() == TablePole::nadir)
        return flux_between(d, Angle(), degrees(90)).value() / all;
    // planes of constant V run from pole to pole; those within 90 degrees of nadir are below
    const auto planes = d.planes();
    const bool is_all_below =
        planes.front() >= degrees(-90.001) && planes.back() <= degrees(90.001);
    return is_all_below ? 1.0 : flux_between(d, Angle(), degrees(90)).value() / all;
}

} // namespace isolux
