#pragma once

#include <optional>

#include "isolux/measure/surface_grid.h"
#include "isolux/scene/scene.h"

/// The areas of EN 12464-1 that follow from a task area.
namespace isolux {

inline constexpr double seated_head_height = 1.2; ///< m
inline constexpr double surrounding_width = 0.5;  ///< m
inline constexpr double background_width = 3.0;   ///< m, next to the immediate surroundings

/// Whether a surface is a grid that faces up, around which there can be a band.
[[nodiscard]] bool is_level_grid(const CalculationSurface& surface);

/// The band of 0.5 m around a level task area, at its height, inside the room and off the edge
/// zone along its walls. Nothing where the task area leaves no such band, or is no level grid.
/// @param room  may be null: no walls
[[nodiscard]] std::optional<CalculationSurface> make_surrounding(const CalculationSurface& task,
                                                                 const Room* room);

/// What lies up to 3 m beyond that band, likewise.
[[nodiscard]] std::optional<CalculationSurface> make_background(const CalculationSurface& task,
                                                                const Room* room);

/// Drops points of a ceiling that a luminaire mounted on it covers.
void leave_out_luminaires(CalculationSurface& ceiling, const SceneDescription& scene);

} // namespace isolux
