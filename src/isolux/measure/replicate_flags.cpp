#include "isolux/measure/replicate_flags.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace isolux {

namespace {

constexpr double suspicious_deviation = 3.5; ///< standard deviations, METHODS 3.5 (i)
constexpr double heavy_kurtosis = 6.0;       ///< METHODS 3.5 (ii)
constexpr double rounding = 1e-12;           ///< of the mean
constexpr std::size_t fewest = 4;

} // namespace

ReplicateFlags flag_replicates(std::span<const double> replicates) noexcept {
    if (replicates.size() < fewest)
        return {};
    const double n = static_cast<double>(replicates.size());
    double sum = 0.0;
    for (const double y : replicates)
        sum += y;
    const double mean = sum / n;

    double second = 0.0;
    double fourth = 0.0;
    double largest = 0.0;
    for (const double y : replicates) {
        const double d = std::abs(y - mean);
        second += d * d;
        fourth += d * d * d * d;
        largest = std::max(largest, d);
    }
    if (largest <= rounding * std::abs(mean))
        return {};
    const double s = std::sqrt(second / (n - 1.0));
    return {largest > suspicious_deviation * s, n * fourth > heavy_kurtosis * second * second};
}

} // namespace isolux
