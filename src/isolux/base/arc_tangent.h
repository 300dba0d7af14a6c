#pragma once

#include <cmath>
#include <numbers>

namespace isolux {

/// std::atan2 without a call, for kernels: the angle of (x, y) in (-pi, pi], rad, to 4e-16; 0
/// for x = y = 0. Signs of zeros count for nothing.
///
/// Both lengths are turned by 45 degrees where they lie nearer to the diagonal than to an axis;
/// what is left is below tan(22.5 degrees), and atan(t)/t there a polynomial in t^2 (through
/// the Chebyshev nodes, relative error 3.5e-17).
[[nodiscard]] inline double arc_tangent(double y, double x) noexcept {
    constexpr double pi = std::numbers::pi;
    constexpr double tan_eighth = 0.41421356237309503;
    const double a = std::abs(x);
    const double b = std::abs(y);
    const bool is_steep = b > a;
    const double high = is_steep ? b : a;
    const double low = is_steep ? a : b;
    const bool is_turned = low > tan_eighth * high;
    const double above = is_turned ? low - high : low;
    const double below = is_turned ? low + high : high;
    const double t = below > 0.0 ? above / below : 0.0;
    const double s = t * t;
    const double s2 = s * s;
    const double s4 = s2 * s2;
    const double p01 = 1.0 - 0.3333333333332844 * s;
    const double p23 = 0.1999999999885511 - 0.14285714180976467 * s;
    const double p45 = 0.11111106180455946 - 0.09090773074808414 * s;
    const double p67 = 0.07689953496306857 - 0.06640233930429408 * s;
    const double p89 = 0.056883492268090106 - 0.04348052215716462 * s;
    const double p =
        (p01 + s2 * p23) + s4 * (p45 + s2 * p67) + s4 * s4 * (p89 + s2 * 0.021135373157693246);
    double angle = (is_turned ? 0.25 * pi : 0.0) + t * p;
    angle = is_steep ? 0.5 * pi - angle : angle;
    angle = x < 0.0 ? pi - angle : angle;
    return y < 0.0 ? -angle : angle;
}

} // namespace isolux
