#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/frame.h"
#include "isolux/base/receiver.h"
#include "isolux/base/units.h"

namespace isolux {

/// How many grid points along a side (EN 12464-1, 4.4; its editions round differently).
enum class GridRounding {
    up,      ///< the fewest points that keep both spacings at or below p
    nearest, ///< nearest whole number of d/p; its spacing, not p, divides the other side
    odd      ///< the fewest odd numbers that keep both spacings at or below p
};

struct GridCounts {
    std::size_t columns = 1;
    std::size_t rows = 1;
};

/// Largest grid spacing that EN 12464-1 allows: p = 0.2 * 5^(log10 d) <= 10 m, METHODS "Grids".
/// d is the longer side, or the shorter one where the ratio is 2 or more.
/// @pre side_u > 0, side_v > 0
[[nodiscard]] Metre standard_spacing(Metre side_u, Metre side_v);

/// Grid by the rule of EN 12464-1, METHODS "Grids". Cells are between half and twice as long as
/// wide. A side that overshoots a whole number of spacings by rounding error (1e-9) gets no
/// extra point.
/// @pre side_u > 0, side_v > 0
[[nodiscard]] GridCounts make_standard_grid(Metre side_u, Metre side_v, GridRounding rule);

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
/// rectangle's plane; empty: all). A point on the outline (1e-9 of the rectangle's diagonal)
/// counts as inside. Rows follow each other, columns run fastest.
///
/// The receivers' axis is the normal of the rectangle; cylindrical and semi-cylindrical ones
/// stand upright (world z) whatever the slope of the surface.
/// @param corner_frame  see GridLayout::frame
/// @param reference     semi-cylindrical: the way the receivers face
/// @pre width > 0, height > 0, counts at least 1 x 1
[[nodiscard]] CalculationSurface make_grid_surface(std::string name,
                                                   const Frame& corner_frame,
                                                   Metre width,
                                                   Metre height,
                                                   GridCounts counts,
                                                   std::vector<Point3> outline,
                                                   IlluminanceKind kind,
                                                   const UnitVector3& reference);

} // namespace isolux
