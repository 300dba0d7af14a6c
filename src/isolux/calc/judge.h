#pragma once

#include <vector>

#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

/// Ez / Eh at every point that a surface of cylindrical illuminance shares with a horizontal
/// one: ratios of the replicates' means with the delete-one jackknife, METHODS eq. (108).
[[nodiscard]] std::vector<ModellingResult> find_modelling(const Results& results);

/// A verdict for each requirement of the project, METHODS "Verdicts". The surfaces of `results`
/// begin with those of the project, and find_modelling() has filled in `modelling`.
/// @param confidence  of the two-sided intervals; each bound gets half of what is left to 1
[[nodiscard]] std::vector<Verdict>
judge(const Project& project, const Results& results, double confidence);

/// What a whole project comes to: fail if anything fails, else undecided if anything is, else
/// pass if anything passes. Recommendations have no say.
[[nodiscard]] Decision overall(const std::vector<Verdict>& verdicts) noexcept;

} // namespace isolux
