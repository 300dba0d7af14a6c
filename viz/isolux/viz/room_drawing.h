#pragma once

#include <span>
#include <string>

#include "isolux/calc/plan.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/viz/drawing.h"

namespace isolux {

/// A straight piece of a room's outline.
struct WallLine {
    Point2 from;
    Point2 to;
    Point2 outside; ///< unit vector away from the room

    [[nodiscard]] double length() const noexcept;
};

/// The straight pieces of a room's outline, columns included: collinear neighbours are one.
[[nodiscard]] std::vector<WallLine> find_walls(const PlanOutline& room);

/// Area that the faces of an outline cover, m2; holes are not in the faces.
[[nodiscard]] double area_of(const PlanOutline& outline);

/// The luminaires between a room's floor and ceiling and within its outline.
[[nodiscard]] std::vector<PlanLuminaire> luminaires_in(const Plan& plan,
                                                       const PlanOutline& room);

/// Plan of one room: outline with the length of each wall, furniture, luminaires to scale with
/// the number of their type and an arrow towards C0, calculation surfaces.
[[nodiscard]] Drawing draw_room(const PlanOutline& room,
                                const Plan& plan,
                                std::span<const CalculationSurface> surfaces,
                                const std::string& project,
                                double largest_width = 230.0);

} // namespace isolux
