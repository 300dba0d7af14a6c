#pragma once

#include <cstddef>
#include <string>

#include "isolux/calc/project.h"

namespace isolux {

/// Scenes of the experiments with pictures, one view each: "cornell box", "soft shadow"
/// (direct light of a square luminaire behind slats and blocks), "indirect" (a box lit by way
/// of its ceiling), "lens" (the blocks of the Cornell box through a lens of 40 mm).
/// @param side  pixels, square
[[nodiscard]] Project make_experiment_project(const std::string& name, std::size_t side);

} // namespace isolux
