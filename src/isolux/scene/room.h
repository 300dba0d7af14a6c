#pragma once

#include <string>
#include <vector>

#include "isolux/base/ids.h"
#include "isolux/base/vec.h"

namespace isolux {

struct Point2 {
    double x = 0.0;
    double y = 0.0;

    friend constexpr bool operator==(const Point2&, const Point2&) = default;
};

enum class OpeningState {
    open,   ///< a hole: light passes
    closed, ///< a leaf of its own material
    glazed  ///< a clear pane
};

/// A rectangular opening (door, window) in one wall of a room.
struct WallOpening {
    std::string name;
    std::size_t wall =
        0; ///< index of the footprint edge, counted from vertex `wall` to `wall + 1`
    double offset = 0.0; ///< m from the wall's first corner along the wall
    double sill = 0.0;   ///< m above the floor
    double width = 0.0;
    double height = 0.0;
    OpeningState state = OpeningState::open;
    MaterialId material; ///< of the leaf or the pane; not used when open
};

/// A column: a hole in the footprint, from floor to ceiling.
struct Column {
    std::vector<Point2> outline;
    MaterialId material;
};

/// A room with vertical walls over a simple polygon.
struct Room {
    std::string name;
    std::vector<Point2> footprint; ///< simple polygon, counter-clockwise seen from above
    double floor_level = 0.0;      ///< m
    double height = 0.0;           ///< m
    MaterialId floor;
    MaterialId ceiling;
    std::vector<MaterialId> walls; ///< one for each footprint edge
    std::vector<WallOpening> openings;
    std::vector<Column> columns;
};

[[nodiscard]] bool contains(const Room& room,
                            const Point3& p) noexcept; ///< borders count as inside
[[nodiscard]] double signed_area(const std::vector<Point2>& polygon) noexcept;
[[nodiscard]] bool is_simple(const std::vector<Point2>& polygon) noexcept;

} // namespace isolux
