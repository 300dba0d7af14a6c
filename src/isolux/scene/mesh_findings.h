#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/scene/mesh.h"

namespace isolux {

/// What is odd about a surface given as polygons over shared points: degenerate and duplicate
/// faces, open borders (one finding each, with its length), edges where more than two faces
/// meet or two that are wound against each other, closed pieces turned inside out.
[[nodiscard]] std::vector<MeshFinding>
find_oddities(std::span<const Point3> points,
              std::span<const std::vector<std::uint32_t>> faces);

} // namespace isolux
