#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/measure/surface_grid.h"
#include "isolux/viz/drawing.h"

namespace isolux {

/// Values at the centres of a regular grid's cells; cells without a value are holes.
struct CellField {
    GridCounts counts;
    double width = 0.0;         ///< m
    double height = 0.0;        ///< m
    std::vector<double> values; ///< row-major, counts.columns * counts.rows; NaN: no value
};

/// The field of a grid's point values.
/// @pre values.size() == grid.cell_of_point.size()
[[nodiscard]] CellField make_cell_field(const GridLayout& grid, std::span<const double> values);

/// Gives the wanted cells that have no value one continued from their neighbours, so that a
/// picture clipped to a slanting outline has no gaps. Not for results.
/// @param wanted  one for each cell
[[nodiscard]] CellField fill_cells(CellField field, const std::vector<bool>& wanted);

/// What lies at or above one illuminance. Metres in the grid's own (u, v).
struct Contour {
    double level = 0.0;
    std::vector<Polyline> region; ///< closed loops, even-odd, of all places with E >= level
    std::vector<Polyline> lines;  ///< where E == level; a ring repeats its first point
};

/// The field cut along its contours by VTK: polygons, each inside one band between two levels.
struct Bands {
    struct Polygon {
        std::uint32_t end = 0;  ///< where its corners end and those of the next begin
        std::uint32_t band = 0; ///< how many levels are at or below it
    };

    std::vector<Point2> points;         ///< metres in the grid's own (u, v)
    std::vector<std::uint32_t> corners; ///< points, of one polygon after the other
    std::vector<Polygon> polygons;

    /// Counter-clockwise.
    [[nodiscard]] std::span<const std::uint32_t>
    corners_of(std::size_t polygon) const noexcept {
        const std::size_t begin = polygon > 0 ? polygons[polygon - 1].end : 0;
        return std::span(corners).subspan(begin, polygons[polygon].end - begin);
    }
};

/// @param levels  ascending
[[nodiscard]] Bands cut_into_bands(const CellField& field, std::span<const double> levels);

/// Contours of the field as smooth_to_lattice continues it, computed by VTK. The domain is the
/// union of the valued cells.
/// @param levels  ascending
[[nodiscard]] std::vector<Contour> make_contours(const CellField& field,
                                                 std::span<const double> levels);

/// Outline of the union of the valued cells: closed loops, even-odd.
[[nodiscard]] std::vector<Polyline> outline_of_cells(const CellField& field);

} // namespace isolux
