#include "isolux/photometry/bug_rating.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numbers>

#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

/// Largest flux for ratings 0 to 4, lm.
using Limits = std::array<double, 5>;

// TM-15-11 addendum A, tables
constexpr Limits back_high_limits{110, 500, 1000, 2500, 5000};
constexpr Limits back_mid_limits{220, 1000, 2500, 5000, 8500};
constexpr Limits back_low_limits{110, 500, 1000, 2500, 5000};
constexpr Limits up_limits{0, 10, 50, 500, 1000};
constexpr Limits very_high_limits{10, 100, 225, 500, 750};
constexpr Limits front_high_limits{660, 1800, 5000, 7500, 12000};

int rating_of(Lumen flux, const Limits& limits) noexcept {
    // the sums of the trapezoid rule leave 1e-13 lm where nothing should be
    constexpr double rounding = 1e-9;
    return static_cast<int>(std::ranges::count_if(
        limits, [flux](double limit) { return flux.value() > limit + rounding; }));
}

} // namespace

Angle street_side_by_convention(PhotometricFormat format) noexcept {
    return format == PhotometricFormat::eulumdat ? degrees(90) : degrees(0);
}

BugZones bug_zones(const IntensityDistribution& d, Angle street_side) {
    const auto half = [&](double from, double to, Angle middle) {
        return flux_in_sector(d, degrees(from), degrees(to), middle, degrees(90));
    };
    const Angle back = street_side + radians(std::numbers::pi);
    return {.front_low = half(0, 30, street_side),
            .front_mid = half(30, 60, street_side),
            .front_high = half(60, 80, street_side),
            .front_very_high = half(80, 90, street_side),
            .back_low = half(0, 30, back),
            .back_mid = half(30, 60, back),
            .back_high = half(60, 80, back),
            .back_very_high = half(80, 90, back),
            .up_low = flux_between(d, degrees(90), degrees(100)),
            .up_high = flux_between(d, degrees(100), degrees(180))};
}

BugRating rate(const BugZones& z, LateralType type) noexcept {
    const Limits& back_glare =
        type == LateralType::symmetric ? front_high_limits : back_high_limits;
    return {std::max({rating_of(z.back_high, back_high_limits),
                      rating_of(z.back_mid, back_mid_limits),
                      rating_of(z.back_low, back_low_limits)}),
            std::max(rating_of(z.up_low, up_limits), rating_of(z.up_high, up_limits)),
            std::max({rating_of(z.front_very_high, very_high_limits),
                      rating_of(z.back_very_high, very_high_limits),
                      rating_of(z.front_high, front_high_limits),
                      rating_of(z.back_high, back_glare)})};
}

std::string to_string(const BugRating& rating) {
    return "B" + std::to_string(rating.backlight) + " U" + std::to_string(rating.uplight) + " G"
           + std::to_string(rating.glare);
}

} // namespace isolux
