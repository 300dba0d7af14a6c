#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "isolux/calc/plan.h"
#include "isolux/calc/results.h"
#include "isolux/viz/drawing.h"

namespace isolux {

/// What a map says besides the surface itself.
struct MapNotes {
    std::string project;              ///< shown beside the title; may be empty
    double confidence = 0.95;         ///< of all intervals, Results::confidence
    double tolerance = 0.01;          ///< asked for, Settings::tolerance
    double absolute_tolerance = 1e-4; ///< lx, Settings::absolute_tolerance
    double largest_width = 230.0;     ///< of the map's frame, mm
};

/// False-colour map of one calculation surface.
///
/// Colour bands and isolux lines (bilinear between the points, constant from the outer points
/// to the border), values in lx at the points where there is room, lowest and highest point,
/// Em, U0, Emin and Emax with their intervals, scale. Horizontal surfaces lie as in the floor
/// plan, world x to the right and y up, with rooms, objects and luminaires; others are seen
/// from their front, world z up, in metres from their lower left corner. Surfaces without a
/// grid show coloured points.
[[nodiscard]] Drawing
draw_map(const SurfaceResult& result, const Plan& plan, const MapNotes& notes);

/// Floor plan: rooms, objects, luminaires to scale with an arrow towards C0 and a number for
/// their type, calculation surfaces.
[[nodiscard]] Drawing draw_plan_map(const Plan& plan,
                                    std::span<const CalculationSurface> surfaces,
                                    const std::string& project);

/// Write `stem`.svg and `stem`.png, each under a temporary name first.
/// @throws WriteError
void write_map(const std::filesystem::path& stem,
               const SurfaceResult& result,
               const Plan& plan,
               const MapNotes& notes);
void write_plan_map(const std::filesystem::path& stem,
                    const Plan& plan,
                    std::span<const CalculationSurface> surfaces,
                    const std::string& project);

} // namespace isolux
