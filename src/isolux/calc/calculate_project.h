#pragma once

#include "isolux/calc/calculate.h"

namespace isolux {

/// calculate() for everything a project asks for: its surfaces, modelling, and a verdict for
/// each of its requirements.
/// @param scene  built from the project's description, which may be gone by now
[[nodiscard]] Results calculate_project(const Scene& scene,
                                        const Project& project,
                                        const Settings& settings,
                                        const Control& control = {});

} // namespace isolux
