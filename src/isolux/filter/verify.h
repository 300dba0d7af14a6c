#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "isolux/filter/gaussian_filter.h"

/// Filter, then verify: two independent halves measure the filter's error
/// without knowing the truth, METHODS eq. (100).
namespace isolux {

/// Mean over a square window of the sites inside it (object != 0); 0 where
/// there is none.
/// @param window  side in pixels, odd
[[nodiscard]] Plane
window_mean(const FilterSites& sites, const Plane& values, std::size_t window);

/// Pixelwise terms whose window means estimate squared errors of the final
/// picture, which is the mean of both halves.
struct SquaredErrors {
    Plane filtered; ///< bias^2 + variance of (F(A) + F(B))/2; single values may
                    ///< be negative
    Plane raw;      ///< variance of (A + B)/2
    Plane bias;     ///< bias^2; single values may be negative
};

[[nodiscard]] SquaredErrors squared_errors(const Halves& raw, const Halves& filtered);

/// METHODS eq. (100) in its first form, the error of one filtered half against
/// the other half's known variance; for tests and for callers who know their
/// variances.
[[nodiscard]] Plane
squared_error_of_half(const Halves& raw, const Halves& filtered, const Halves& variance);

/// What was chosen at every pixel among 0, 1/2, 1, 2 and 4 times the rule's
/// width: shares that add up to one, the choices of 7 x 7 pixels averaged.
struct WidthChoice {
    std::array<Plane, 5> share;
    Plane scale; ///< geometric mean of the chosen factors above 0; 1 where there
                 ///< is none
};

/// Per pixel the candidate with the smallest windowed error of the final
/// picture: 0 is the raw one, 1, 2, ... those of the list. Pixels that are no
/// site count for nobody.
[[nodiscard]] std::vector<unsigned char> best_candidates(const FilterSites& sites,
                                                         const Halves& raw,
                                                         std::span<const Halves> candidates,
                                                         std::size_t window);

[[nodiscard]] WidthChoice choose_widths(const FilterSites& sites,
                                        const Halves& raw,
                                        const std::array<Halves, 4>& ladder,
                                        std::size_t window);

/// Side of the window in pixels: 15; 31 for reflected light below 16 samples a
/// pixel.
[[nodiscard]] std::size_t window_side(const FilterSettings& settings, bool indirect) noexcept;

} // namespace isolux
