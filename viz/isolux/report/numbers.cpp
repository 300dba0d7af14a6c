#include "isolux/report/numbers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace isolux::report {

namespace {

/// Decimals after the point so that `digits` digits of `value` count.
int decimals_for(double value, int digits) {
    if (!(std::abs(value) > 0.0) || !std::isfinite(value))
        return 0;
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
    return std::clamp(digits - 1 - magnitude, 0, 9);
}

} // namespace

std::string to_digits(double value) {
    return fmt::format("{:.{}f}", value + 0.0, decimals_for(value, 4));
}

Cell number_cell(double value) { return {to_digits(value), value, Mark::none}; }

std::string to_percent(double share) {
    return fmt::format("{:.{}f} %", 100.0 * share, std::min(2, decimals_for(100.0 * share, 2)));
}

std::string to_half_width(const Estimate& e, double confidence) {
    const Interval interval = confidence_interval(e, confidence);
    const double half = 0.5 * (interval.upper - interval.lower);
    return fmt::format("{:.{}f}", half, decimals_for(half, 2));
}

Cell estimate_cell(const Estimate& e, double confidence) {
    const Interval interval = confidence_interval(e, confidence);
    const double half = 0.5 * (interval.upper - interval.lower);
    if (!(half > 0.0) || !std::isfinite(half))
        return number_cell(e.mean);
    const int decimals = decimals_for(half, 2);
    return {
        fmt::format("{:.{}f} ± {:.{}f}", e.mean, decimals, half, decimals), e.mean, Mark::none};
}

} // namespace isolux::report
