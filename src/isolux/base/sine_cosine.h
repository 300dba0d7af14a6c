#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

#include "isolux/base/angle.h"

namespace isolux {

struct SineCosine {
    double sine = 0.0;
    double cosine = 1.0;
};

[[nodiscard]] constexpr SineCosine sum_of_angles(const SineCosine& a,
                                                 const SineCosine& b) noexcept {
    return {a.sine * b.cosine + a.cosine * b.sine, a.cosine * b.cosine - a.sine * b.sine};
}

/// Sine and cosine of an angle in turns, 1 for the full circle, without a call or a branch, for
/// kernels: to 2.5e-16, small sines to as much of their own size. @pre |turns| < 2^48
///
/// What is left of the angle beyond its nearest quarter turn, r quarters, is at most half of
/// one: there sin/r and cos are polynomials in r^2 (through the Chebyshev nodes, relative error
/// 4e-17).
[[nodiscard]] inline SineCosine sine_cosine(double turns) noexcept {
    constexpr double to_integer = 0x1.8p52; // what is added to it has no place for fractions
    const double quarters = 4.0 * turns;
    const double rounded = quarters + to_integer;
    const double r = quarters - (rounded - to_integer);
    const double s = r * r;
    const double s2 = s * s;
    const double s4 = s2 * s2;
    const double sine = r
                        * ((1.5707963267948966 - 0.6459640975062443 * s
                            + s2 * (0.07969262624604301 - 0.004681754132340976 * s))
                           + s4
                                 * (0.0001604411507421909 - 3.59864335298231e-06 * s
                                    + s2 * 5.633933781537854e-08));
    const double cosine =
        (1.0 - 1.2337005501361697 * s + s2 * (0.2536695079010467 - 0.02086348076331121 * s))
        + s4
              * (0.0009192602741831558 - 2.520203677046026e-05 * s
                 + s2 * (4.710609726757823e-07 - 6.321256869628588e-09 * s));
    // A quarter turn on, the sine is the cosine and the cosine minus the sine; two turn both.
    const auto quarter = std::bit_cast<std::uint64_t>(rounded);
    const auto a = std::bit_cast<std::uint64_t>(sine);
    const auto b = std::bit_cast<std::uint64_t>(cosine);
    const std::uint64_t swap = (a ^ b) & -(quarter & 1U);
    return {std::bit_cast<double>(a ^ swap ^ (quarter & 2U) << 62U),
            std::bit_cast<double>(b ^ swap ^ ((quarter + 1U) & 2U) << 62U)};
}

[[nodiscard]] inline SineCosine sine_cosine(Angle a) noexcept {
    return sine_cosine(a.in_radians() / (2.0 * std::numbers::pi));
}

} // namespace isolux
