#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isolux/base/frame.h"
#include "isolux/io/project_reader.h"

namespace isolux {

/// A flat area to be measured: the rectangle that carries the grid, and what of it counts.
struct SurfaceArea {
    std::string name; ///< if the user gives none
    Frame frame;      ///< as GridLayout::frame
    double width = 0.0;
    double height = 0.0;
    std::vector<Point3> outline; ///< for pictures; points outside it are left out if `clips`
    bool clips = false;
    /// Of a floor plan: footprint and columns leave points out.
    const Room* room = nullptr;
    double edge = 0.0; ///< m of band along the walls of `room`
    /// Of a wall: these rooms' openings leave points out.
    const std::vector<Room>* rooms = nullptr;
};

/// Reads the member `form` of a surface: "work_plane", "floor", "ceiling", "wall", "rectangle"
/// or "polygon". Nothing means the error has been reported.
[[nodiscard]] std::optional<SurfaceArea>
read_area(const JsonNode& node, const std::string& form, const ProjectReader& reader);

/// The part of a room's floor plan at a height above its floor, an edge band left out.
/// Nothing is left: empty.
[[nodiscard]] std::optional<SurfaceArea>
make_plan_area(const Room& room, double height, double edge);

/// The band along the walls that EN 12464-1 allows to leave out of a work plane.
[[nodiscard]] double standard_edge(const Room& room) noexcept;

inline constexpr double standard_work_plane_height = 0.75; ///< m

/// Whether a point of the grid counts.
[[nodiscard]] bool is_measured(const SurfaceArea& area, const Point3& p);

} // namespace isolux
