#pragma once

#include <string>

#include "isolux/calc/denoise_experiment.h"
#include "isolux/calc/filter_experiment.h"
#include "isolux/viz/drawing.h"

/// What the experiments with pictures found, as text, JSON, CSV and charts.
namespace isolux {

/// @param name  of the experiment
[[nodiscard]] std::string to_text(const FilterComparison& comparison, const std::string& name);
[[nodiscard]] std::string to_json(const FilterComparison& comparison, const std::string& name);
[[nodiscard]] std::string to_csv(const FilterComparison& comparison);
[[nodiscard]] Drawing draw(const FilterComparison& comparison, const std::string& name);

[[nodiscard]] std::string to_text(const DenoiseStudy& study);
[[nodiscard]] std::string to_json(const DenoiseStudy& study);
[[nodiscard]] std::string to_csv(const DenoiseStudy& study);
[[nodiscard]] Drawing draw(const DenoiseStudy& study);

} // namespace isolux
