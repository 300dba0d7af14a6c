#pragma once

#include <cmath>
#include <numbers>

namespace isolux {

/// Angle of (x, y) from the x axis, rad, in [-pi, pi]: std::atan2 within 4e-16 of a turn, in a
/// third of its time and with the same bits on every machine. 0 for (0, 0).
///
/// An odd polynomial of degree 19 on |t| <= tan(pi/8), fitted at Chebyshev nodes (error 1e-15);
/// beyond that the angle is counted from the diagonal, t = (s - c)/(s + c).
[[nodiscard]] inline double arctangent(double y, double x) noexcept {
    constexpr double pi = std::numbers::pi;
    constexpr double tan_eighth = 0.41421356237309503; // of a half turn
    const double a = std::abs(x);
    const double b = std::abs(y);
    const bool is_steep = b > a;
    const double c = is_steep ? b : a;
    const double s = is_steep ? a : b;
    if (!(c > 0.0))
        return 0.0;
    const bool is_far = s > tan_eighth * c;
    const double t = is_far ? (s - c) / (s + c) : s / c;
    const double z = t * t;
    const double z2 = z * z;
    const double z4 = z2 * z2;
    const double low = (0.9999999999999990399 - 0.333333333332213411 * z)
                       + z2 * (0.1999999997837686871 - 0.1428571266065905409 * z);
    const double middle = (0.1111104882058514481 - 0.09089529357362554915 * z)
                          + z2 * (0.07673529098467826526 - 0.065059441555033107 * z);
    const double high = 0.05024634245596043313 - 0.02531472973194232955 * z;
    double angle = t * (low + z4 * (middle + z4 * high));
    angle = is_far ? angle + 0.25 * pi : angle;
    angle = is_steep ? 0.5 * pi - angle : angle;
    angle = x < 0.0 ? pi - angle : angle;
    return std::copysign(angle, y);
}

} // namespace isolux
