#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/calc/contributions.h"
#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

/// Levels of the sources of a table from those of the luminaires. Nothing where luminaires of
/// one source want different levels: the table does not tell them apart.
[[nodiscard]] std::optional<std::vector<double>>
source_levels(std::span<const LightSource> sources, std::span<const double> factors);

/// How finely a calculation must tell light apart so that all scenes can be made of it.
[[nodiscard]] SourceSplit split_for(const Scene& scene, std::span<const LightScene> scenes);

/// One scene, METHODS eq. (115): every replicate of every surface is combined anew, so that
/// statistics, errors and verdicts come out as of a run with these levels. No ray is traced.
/// @param results       of the run that `contributions` comes from
/// @param requirements  those on surfaces are judged; of the others the verdicts say why not
/// @return nothing where source_levels() has none
[[nodiscard]] std::optional<SceneResult>
evaluate_scene(const Contributions& contributions,
               const LightScene& scene,
               const Results& results,
               std::span<const ProjectRequirement> requirements,
               double confidence);

} // namespace isolux
