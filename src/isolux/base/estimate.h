#pragma once

#include <cstddef>
#include <span>

namespace isolux {

/// A result that knows its doubt. A bare number means a deterministic one.
struct Estimate {
    double mean = 0.0;
    double standard_error = 0.0;
    std::size_t samples = 0; ///< independent replicates behind the two numbers
};

struct Interval {
    double lower = 0.0;
    double upper = 0.0;

    [[nodiscard]] constexpr bool contains(double v) const noexcept {
        return lower <= v && v <= upper;
    }
};

/// Mean and standard error of R independent replicate values, METHODS eq. (15).
[[nodiscard]] Estimate estimate_from_replicates(std::span<const double> replicates) noexcept;

/// Two-sided Student quantile t with `degrees_of_freedom` such that P(|T| <= t) = confidence.
/// @pre degrees_of_freedom >= 1, 0 < confidence < 1
[[nodiscard]] double student_quantile(double confidence, double degrees_of_freedom);

/// Student interval of a replicate estimate at the given two-sided confidence, METHODS eq.
/// (15). With one sample (or a deterministic value) the interval is the value itself.
[[nodiscard]] Interval confidence_interval(const Estimate& e, double confidence);

} // namespace isolux
