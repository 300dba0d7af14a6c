#pragma once

#include "isolux/base/sine_cosine.h"

namespace isolux {

/// A range of polar angles: integrals of sin(gamma) over it, times the hat functions of its two
/// ends. What is linear in gamma, p at the lower and q at the upper end, has the integral p s0
/// + q s1.
struct GammaPiece {
    SineCosine upper; ///< of the upper end
    double s0 = 0.0;  ///< S0 and S1 of METHODS eq. (4)
    double s1 = 0.0;
};

/// From `lower` on, `width` rad wide; written about the middle, so that nothing cancels in
/// narrow ones.
[[nodiscard]] inline GammaPiece gamma_piece(const SineCosine& lower, double width) noexcept {
    const double h = 0.5 * width;
    const double h2 = h * h;
    const SineCosine half = sine_cosine(radians(h));
    const SineCosine middle = sum_of_angles(lower, half);
    // (sin h - h cos h) / h; its series below h = 0.1 is exact to 1e-14
    const double q =
        h < 0.1 ? h2 * (1.0 / 3.0 - h2 * (1.0 / 30.0 - h2 * (1.0 / 840.0 - h2 / 45360.0)))
                : half.sine / h - half.cosine;
    const double even = middle.sine * half.sine;
    const double odd = middle.cosine * q;
    return {sum_of_angles(middle, half), even - odd, even + odd};
}

} // namespace isolux
