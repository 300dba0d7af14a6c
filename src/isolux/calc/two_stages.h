#pragma once

#include "isolux/calc/calculate.h"

namespace isolux {

/// Replicates of the discarded pilot; fixed, because a quantile belongs to it.
inline constexpr std::size_t pilot_stage_replicates = 16;

/// Units that the second stage needs so that a point's interval keeps the tolerance, METHODS
/// eq. (82). @param pilot  of one unit and pilot_stage_replicates replicates
/// @param tolerance    half width over value
/// @param floor        value below which the tolerance grows no smaller, lx
/// @param quantile     Student's, of the statement that is to hold
[[nodiscard]] double
units_for(const Estimate& pilot, double tolerance, double floor, double quantile) noexcept;

/// Stein's two stages instead of doubling: a pilot of one unit, thrown away, fixes the work; it
/// is run once, with random numbers of its own, and its intervals stand whatever they are. The
/// cost is known after the pilot, and no look at the result decides when to stop.
[[nodiscard]] Results calculate_in_two_stages(const Scene& scene,
                                              std::span<const CalculationSurface> surfaces,
                                              const Settings& settings,
                                              const Control& control = {});

} // namespace isolux
