#pragma once

#include <span>
#include <vector>

#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

/// What must be measured for the glare of all groups: the illuminance at each eye on the plane
/// it faces, one surface a group in their order.
[[nodiscard]] std::vector<CalculationSurface>
observer_surfaces(std::span<const ObserverGroup> groups);

/// Rates every observer, METHODS "Glare".
/// @param at_the_eyes  results of observer_surfaces()
/// @param surfaces     results of the project's own surfaces
[[nodiscard]] std::vector<ObserverGroupResult>
rate_observers(const Scene& scene,
               const Project& project,
               std::span<const SurfaceResult> at_the_eyes,
               std::span<const SurfaceResult> surfaces);

/// UGR by the table method for one line of sight, METHODS "UGR table": the nearest standard
/// room. Only for a rectangular room lit by one type with a photometric file at one height.
struct TableRating {
    std::optional<double> value;
    std::string note;
};

[[nodiscard]] TableRating
rate_by_table(const Scene& scene, const std::string& room, const SightLine& sight);

} // namespace isolux
