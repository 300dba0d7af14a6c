#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "isolux/calc/project.h"

/// Option values as people write them. Each throws InputError{option, ...} when it cannot read
/// `text`.
namespace isolux {

/// "1%" or "0.01" (both 0.01). 0.01 % to 50 %.
[[nodiscard]] double parse_tolerance(std::string_view option, std::string_view text);

/// "60s", "1.5 min", "2h"; a bare number is seconds. More than 0.
[[nodiscard]] std::chrono::duration<double> parse_duration(std::string_view option,
                                                           std::string_view text);

/// A whole number in [minimum, maximum].
[[nodiscard]] std::uint64_t parse_count(std::string_view option,
                                        std::string_view text,
                                        std::uint64_t minimum,
                                        std::uint64_t maximum);

/// "auto", "local", "mis", ... or the names of the project file: `estimator_names`.
[[nodiscard]] Estimator parse_estimator(std::string_view option, std::string_view text);

/// All of `text` as a finite number, blanks around it ignored; NaN if it is not one. The
/// decimal mark is a point whatever the locale.
[[nodiscard]] double parse_finite_number(std::string_view text) noexcept;

} // namespace isolux
