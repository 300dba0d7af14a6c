#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isolux {

/// How much the filter may smooth, METHODS "Profiles". Larger k mu: narrower,
/// less bias, more noise.
struct FilterSettings {
    double k_mu_shadow =
        6.0; ///< width of a shadow's filter: 1/(k mu) of the penumbra, eq. (94)
    double k_mu_indirect = 3.0; ///< of reflected light, eq. (95)
    double k_mu_lens = 3.0;     ///< of the lens, eq. (96)
    /// Reflected light is smoothed over at least so many pixels (standard
    /// deviation).
    double floor_pixels = 1.5;
    /// Shadows are, too, and what the pilot found fully lit; 0: what is narrower stays, what is
    /// lit is copied.
    double shadow_floor_pixels = 0.0;
    std::size_t pilot_step = 1; ///< pixels from one whose pilot looked around to the next
    std::size_t radius = 50;    ///< pixels beyond which nothing is looked at
    /// Pixels with samples of one half alone are filtered, too: the other has taken its values.
    bool with_half_sites = false;
    bool choose_width = true; ///< filter, then verify: choose among five widths, eq. (100)
    double samples = 16.0;  ///< a pixel, both halves together: widths shrink with it, eq. (101)
    std::size_t window = 0; ///< pixels, odd; 0: by METHODS "Filter, then verify"
};

/// For pictures.
[[nodiscard]] inline FilterSettings picture_filter() noexcept { return {}; }

/// For pictures in which luminances are read: twice as narrow for reflected
/// light.
[[nodiscard]] inline FilterSettings photometric_filter() noexcept {
    FilterSettings s;
    s.k_mu_indirect = 6.0;
    return s;
}

/// For a picture within a second or two: wide, one width, small radius.
/// @param samples  rays a pixel; the floors are those of two and go down with their noise
[[nodiscard]] inline FilterSettings preview_filter(double samples = 2.0) noexcept {
    const double noise = std::sqrt(2.0 / std::max(2.0, samples));
    FilterSettings s;
    s.samples = samples;
    s.k_mu_shadow = 3.0;
    s.k_mu_indirect = 1.4;
    s.floor_pixels = std::max(s.floor_pixels, 5.0 * noise);
    s.shadow_floor_pixels = 1.5 * noise;
    s.pilot_step = 2;
    s.radius = 20;
    s.choose_width = false;
    s.with_half_sites = true;
    return s;
}

/// Share by which widths shrink at n samples a pixel, METHODS eq. (101):
/// (16/n)^(1/6), never above 1.
[[nodiscard]] double width_factor(double samples) noexcept;

} // namespace isolux
