#pragma once

#include <vector>

#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

/// Power density and LENI of every room, METHODS "Energy".
[[nodiscard]] std::vector<EnergyResult>
energy_of(const Project& project, const Scene& scene, const Results& results);

} // namespace isolux
