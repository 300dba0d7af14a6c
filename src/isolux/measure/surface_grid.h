#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/frame.h"
#include "isolux/base/receiver.h"
#include "isolux/base/units.h"

namespace isolux {

/// How many grid points along a side (EN 12464-1:2021, 4.4; the standard leaves the rounding
/// open).
enum class GridRounding { up, nearest, odd };

struct GridCounts {
    std::size_t columns = 1;
    std::size_t rows = 1;
};

/// Grid by the rule of EN 12464-1: p = 0.2 * 5^(log10 d) <= 10 m, METHODS "Grids".
/// d is the longer side, or the shorter one where the ratio is 2 or more.
[[nodiscard]] GridCounts make_standard_grid(Metre side_u, Metre side_v, GridRounding rounding);

/// A regular grid over a rectangle: point (column i, row j) lies at the centre of its cell.
struct GridLayout {
    Frame frame; ///< origin: corner of cell (0, 0); x: along columns, y: along rows, z: normal
    double width = 0.0;  ///< m along x
    double height = 0.0; ///< m along y
    GridCounts counts;
    /// Row-major cell of every point; points outside the surface's outline are left out.
    std::vector<std::size_t> cell_of_point;
};

/// A calculation surface: named points that are measured and summed up together.
struct CalculationSurface {
    std::string name;
    IlluminanceKind kind = IlluminanceKind::planar;
    std::vector<Receiver> receivers;
    std::optional<GridLayout> grid; ///< absent for single points and point files
    std::vector<Point3> outline;    ///< polygon, in world coordinates; may be empty
};

/// Points at the cell centres of a rectangle, those inside `outline` (world coordinates, in the
/// rectangle's plane; empty: all). A point on the outline counts as inside.
[[nodiscard]] CalculationSurface make_grid_surface(std::string name,
                                                   const Frame& corner_frame,
                                                   Metre width,
                                                   Metre height,
                                                   GridCounts counts,
                                                   std::vector<Point3> outline,
                                                   IlluminanceKind kind,
                                                   const UnitVector3& reference);

} // namespace isolux
