#pragma once

#include <cmath>

namespace isolux::test {

/// How far a computed value may be from a number printed with that many significant digits and
/// still be the same number: half a unit in the last place, and a twentieth more because some
/// references were rounded to one digit more before.
inline double half_unit(double printed, int digits) {
    const double place = std::floor(std::log10(std::abs(printed))) - (digits - 1);
    return 0.55 * std::pow(10.0, place);
}

/// Does `value` agree with a reference printed with so many significant digits?
inline bool agrees(double value, double printed, int digits) {
    return std::abs(value - printed) <= half_unit(printed, digits);
}

} // namespace isolux::test
