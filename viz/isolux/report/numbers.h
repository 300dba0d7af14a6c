#pragma once

#include <string>

#include "isolux/base/estimate.h"
#include "isolux/report/content.h"

namespace isolux::report {

/// Four digits that count, no exponent: 0.001235, 1.234, 512.3, 12346.
[[nodiscard]] std::string to_digits(double value);

/// The value in so many decimals, and exactly.
[[nodiscard]] Cell number_cell(double value);

/// `share` in percent.
[[nodiscard]] std::string to_percent(double share);

/// Half the width of the interval, to two digits that count.
[[nodiscard]] std::string to_half_width(const Estimate& e, double confidence);

/// "512.3 ± 2.1"; the value alone where it has no doubt.
[[nodiscard]] Cell estimate_cell(const Estimate& e, double confidence);

} // namespace isolux::report
