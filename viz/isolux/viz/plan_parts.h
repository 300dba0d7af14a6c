#pragma once

#include <span>
#include <vector>

#include "isolux/calc/plan.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/viz/map_page.h"

namespace isolux {

/// What the symbols of a plan mean: luminaire types that hang, objects, surfaces, rooms.
[[nodiscard]] std::vector<LegendEntry> make_plan_entries(const Plan& plan, bool has_surfaces);

/// Objects, rooms, calculation surfaces, luminaires with the numbers of their types, names of
/// surfaces and rooms.
void draw_plan_parts(MapPage& page,
                     const Plan& plan,
                     std::span<const CalculationSurface> surfaces);

/// A surface as a closed line, seen from above: its outline, else the grid's rectangle.
[[nodiscard]] Polyline surface_outline(const CalculationSurface& surface);

} // namespace isolux
