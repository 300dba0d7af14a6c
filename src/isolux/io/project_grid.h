#pragma once

#include <optional>

#include "isolux/io/json_node.h"
#include "isolux/measure/surface_grid.h"
#include "isolux/scene/room.h"

namespace isolux {

inline constexpr double most_grid_points = 1e6; ///< of one surface

/// How the grid is to be chosen; the default is the standard's rule.
struct GridWish {
    GridRounding rounding = GridRounding::up;
    std::optional<Point2> spacing; ///< m along columns and rows, at most
    std::optional<GridCounts> counts;
};

/// Reads a surface's "grid".
[[nodiscard]] GridWish read_grid(const JsonNode& node);

/// Columns and rows for an area of this size; nothing if there would be too many points.
[[nodiscard]] std::optional<GridCounts>
choose_counts(const GridWish& wish, double width, double height);

} // namespace isolux
