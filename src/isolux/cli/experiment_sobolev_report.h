#pragma once

#include <string>

#include "isolux/calc/sobolev_experiment.h"
#include "isolux/viz/drawing.h"

/// What `isolux experiment sobolev` prints, writes and draws.
namespace isolux {

/// CPU seconds of counting over those of local estimation for the same error, as an earlier
/// study reported them (Budak, Zheltov, Kalakutsky 2012).
inline constexpr double reported_ratio_low = 80.0;
inline constexpr double reported_ratio_high = 90.0;

[[nodiscard]] std::string to_text(const SobolevComparison& comparison);
[[nodiscard]] std::string to_json(const SobolevComparison& comparison);

/// One row a place: plane, radius, exact value, then value and standard error of every method.
[[nodiscard]] std::string to_csv(const SobolevComparison& comparison);

/// E(r) on both planes, and how far every method is from the series, with 95 % error bars.
[[nodiscard]] Drawing draw(const SobolevComparison& comparison);

} // namespace isolux
