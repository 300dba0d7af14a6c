#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isolux/calc/plan.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/viz/drawing.h"
#include "isolux/viz/map_page.h"

namespace isolux {

/// How a surface lies on paper: as in the floor plan, or seen from its front.
struct SurfaceView {
    bool is_plan = true;
    Point3 origin; ///< becomes (0, 0)
    UnitVector3 right = UnitVector3::from_unit({1, 0, 0});
    UnitVector3 up = UnitVector3::from_unit({0, 1, 0});

    [[nodiscard]] Point2 project(const Point3& p) const noexcept;
    [[nodiscard]] std::vector<Polyline> project(const std::vector<Polyline>& grid_lines,
                                                const GridLayout& grid) const;
};

/// Horizontal surfaces, and points that do not share one plane, lie as in the floor plan in
/// world coordinates; others have their lower left corner at (0, 0).
[[nodiscard]] SurfaceView make_surface_view(const CalculationSurface& surface);

/// Where the surface's points, cells and outline lie on the view.
[[nodiscard]] Extent surface_extent(const CalculationSurface& surface, const SurfaceView& view);

/// The part of a plan that belongs to a horizontal surface: the room around its middle, the
/// objects and luminaires between that room's floor and ceiling. Everything, where it lies in
/// no room; nothing for other views.
[[nodiscard]] Plan
select_visible(const Plan& plan, const CalculationSurface& surface, const SurfaceView& view);

/// What a map shows: the surface and, where it fills much of it or has no grid, its whole room.
[[nodiscard]] Extent
map_extent(const CalculationSurface& surface, const SurfaceView& view, const Plan& visible);

/// Air around what is drawn, and at least a metre each way.
[[nodiscard]] Extent with_margin(const Extent& e);

} // namespace isolux
