#include "isolux/io/project_areas.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "isolux/io/outline.h"

namespace isolux {

namespace {

constexpr double rounding = 1e-6; // m

const UnitVector3 along_x = UnitVector3::from_unit({1, 0, 0});
const UnitVector3 along_y = UnitVector3::from_unit({0, 1, 0});
const UnitVector3 up = UnitVector3::from_unit({0, 0, 1});

Frame make_frame(const Point3& origin, const UnitVector3& x, const UnitVector3& normal) {
    return {origin, x, UnitVector3(cross(normal, x)), normal};
}

void report_nothing_left(const JsonNode& node, double edge, const Room& room) {
    node.error(fmt::format("an edge band of {:.4g} m leaves nothing of room \"{}\" (no point "
                           "would be measured)",
                           edge,
                           room.name),
               "Make \"edge\" smaller?");
}

std::optional<SurfaceArea> read_work_plane(const JsonNode& node, const ProjectReader& reader) {
    const JsonObject object(node, "a work plane", {"room", "height", "edge"});
    const Room* room = reader.find_room(object);
    const double height = object.number("height", any_distance, standard_work_plane_height);
    double edge = object.number("edge", any_distance, 0.0);
    if (room == nullptr)
        return std::nullopt;
    if (!object.has("edge"))
        edge = standard_edge(*room);
    if (height > room->height) {
        object.find("height").value_or(node).error(fmt::format(
            "the work plane at {} m is above the ceiling (room \"{}\" is {} m high)",
            height,
            room->name,
            room->height));
        return std::nullopt;
    }
    std::optional<SurfaceArea> area = make_plan_area(*room, height, edge);
    if (area)
        area->name = room->name + " work plane";
    else
        report_nothing_left(node, edge, *room);
    return area;
}

std::optional<SurfaceArea> read_floor_or_ceiling(const JsonNode& node,
                                                 const std::string& form,
                                                 const ProjectReader& reader) {
    const JsonObject object(node, "a " + form, {"room", "edge"});
    const Room* room = reader.find_room(object);
    const double edge = object.number("edge", any_distance, 0.0);
    if (room == nullptr)
        return std::nullopt;
    const bool is_ceiling = form == "ceiling";
    std::optional<SurfaceArea> area =
        make_plan_area(*room, is_ceiling ? room->height : 0.0, edge);
    if (!area) {
        report_nothing_left(node, edge, *room);
        return std::nullopt;
    }
    area->name = room->name + " " + form;
    if (is_ceiling) // turned about its x axis, so that it is seen from below
        area->frame =
            make_frame(area->frame.point_from_local({0.0, area->height, 0.0}), along_x, -up);
    return area;
}

std::optional<SurfaceArea> read_wall(const JsonNode& node, const ProjectReader& reader) {
    if (node.is(JsonValue::Kind::text)) {
        node.error("a wall is an object {\"number\": 1} (found text)",
                   reader.project.scene.rooms.size() == 1
                       ? walls_in_words(reader.project.scene.rooms.front().footprint)
                       : std::string());
        return std::nullopt;
    }
    const JsonObject object(node, "a wall", {"room", "number", "edge"});
    const Room* room = reader.find_room(object);
    const std::optional<std::int64_t> number =
        object.require("number", [&](const JsonNode& wall) {
            return read_wall_number(wall,
                                    room != nullptr ? room->footprint : std::vector<Point2>{});
        });
    const double edge = object.number("edge", any_distance, 0.0);
    if (room == nullptr || !number)
        return std::nullopt;
    const std::size_t walls = room->footprint.size();
    if (static_cast<std::size_t>(*number) > walls) {
        object.find("number")->error(fmt::format(
            "there is no wall {} (room \"{}\" has walls 1 to {})", *number, room->name, walls));
        return std::nullopt;
    }
    SurfaceArea area;
    const auto wall = static_cast<std::size_t>(*number - 1);
    const Point2 first = room->footprint[wall];
    const Point2 last = room->footprint[(wall + 1) % walls];
    area.width = distance(first, last) - 2.0 * edge;
    area.height = room->height - 2.0 * edge;
    if (area.width <= 0.0 || area.height <= 0.0) {
        node.error(fmt::format("an edge band of {:.4g} m leaves nothing of the wall (no point "
                               "would be measured)",
                               edge),
                   "Make \"edge\" smaller?");
        return std::nullopt;
    }
    // Seen from inside, the wall's last corner is on the left.
    const UnitVector3 x(Vector3{first.x - last.x, first.y - last.y, 0.0});
    const UnitVector3 inwards(cross(x, up));
    const Point3 corner{last.x, last.y, room->floor_level};
    area.frame = make_frame(corner + edge * Vector3(x) + edge * Vector3(up), x, inwards);
    area.name = fmt::format("{} wall {}", room->name, *number);
    area.rooms = &reader.project.scene.rooms;
    return area;
}

std::optional<UnitVector3> read_direction(const JsonNode& node) {
    const std::optional<Vector3> v = read_vector(node);
    if (v && length(*v) == 0.0)
        node.error("the vector has no length (no direction follows from it)");
    return v && length(*v) > 0.0 ? std::optional(UnitVector3(*v)) : std::nullopt;
}

std::optional<SurfaceArea> read_corner_rectangle(const JsonObject& object) {
    object.exclude("corner", {"size", "normal", "rotation"});
    const std::optional<Vector3> u = object.require("u", read_vector);
    const std::optional<Vector3> v = object.require("v", read_vector);
    const std::optional<Point3> corner = read_point(*object.find("corner"));
    if (!corner || !u || !v)
        return std::nullopt;
    SurfaceArea area;
    area.width = length(*u);
    area.height = length(*v);
    if (area.width == 0.0 || area.height == 0.0) {
        object.find(area.width == 0.0 ? "u" : "v")
            ->error("the side has no length (the rectangle has no area)");
        return std::nullopt;
    }
    constexpr double right_angle = 1e-6; // cosine; a thousandth of a millimetre a metre
    if (std::abs(dot(*u, *v)) > right_angle * area.width * area.height) {
        object.find("v")->error(
            "v is not at right angles to u (the area would not be a rectangle)",
            "Use \"polygon\"?");
        return std::nullopt;
    }
    area.frame = make_frame(*corner, UnitVector3(*u), UnitVector3(cross(*u, *v)));
    return area;
}

std::optional<SurfaceArea> read_centre_rectangle(const JsonObject& object) {
    object.exclude("centre", {"u", "v"});
    const std::optional<Point3> centre = read_point(*object.find("centre"));
    const std::optional<Point2> size = object.require("size", read_size2);
    const std::optional<JsonNode> normal_node = object.find("normal");
    const std::optional<UnitVector3> normal =
        normal_node ? read_direction(*normal_node) : std::optional(up);
    const double rotation = object.number("rotation", any_angle, 0.0);
    if (!centre || !size || !normal)
        return std::nullopt;
    constexpr double vertical = 1e-9;
    const bool is_level = std::hypot(normal->x(), normal->y()) < vertical;
    const UnitVector3 x = is_level ? along_x : UnitVector3(cross(up, *normal));
    SurfaceArea area;
    area.width = size->x;
    area.height = size->y;
    area.frame = make_frame(*centre, x, *normal);
    if (rotation != 0.0)
        area.frame = rotate(area.frame, *normal, degrees(rotation));
    area.frame.origin =
        area.frame.point_from_local({-0.5 * area.width, -0.5 * area.height, 0.0});
    return area;
}

/// Newell's normal: twice the vector area.
Vector3 vector_area(const std::vector<Point3>& corners) {
    Vector3 sum;
    for (std::size_t i = 0; i < corners.size(); ++i)
        sum = sum
              + cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    return sum;
}

/// The smallest rectangle along the first side that holds the polygon.
std::optional<SurfaceArea> frame_polygon(const JsonNode& node,
                                         const std::vector<Point3>& corners) {
    const Vector3 normal = vector_area(corners);
    const Vector3 first = corners[1] - corners[0];
    if (length(normal) < rounding * rounding || length(first) < rounding) {
        node.error("the polygon has no area (or corners that coincide)");
        return std::nullopt;
    }
    SurfaceArea area;
    area.outline = corners;
    area.clips = true;
    const UnitVector3 z(normal);
    const UnitVector3 x(first - dot(first, z) * Vector3(z));
    area.frame = make_frame(corners[0], x, z);
    std::vector<Point2> plan;
    double furthest_off = 0.0;
    double reach = 0.0;
    for (const Point3& p : corners) {
        const Vector3 local = area.frame.point_to_local(p);
        plan.push_back({local.x, local.y});
        furthest_off = std::max(furthest_off, std::abs(local.z));
        reach = std::max(reach, length(local));
    }
    if (furthest_off > rounding * (1.0 + reach)) {
        node.error(
            fmt::format("the polygon is not flat (a corner is {:.3g} m off the plane of the "
                        "others)",
                        furthest_off));
        return std::nullopt;
    }
    if (!check_outline(node, plan))
        return std::nullopt;
    const Rectangle2 bounds = bounding_rectangle(plan);
    area.width = bounds.width();
    area.height = bounds.depth();
    area.frame.origin = area.frame.point_from_local({bounds.lower.x, bounds.lower.y, 0.0});
    return area;
}

std::optional<SurfaceArea> read_polygon(const JsonNode& node) {
    const std::vector<JsonNode> nodes = read_list(node, 3);
    std::vector<Point3> corners;
    for (const JsonNode& item : nodes)
        if (const std::optional<Point3> p = read_point(item))
            corners.push_back(*p);
    if (corners.size() < 3 || corners.size() < nodes.size())
        return std::nullopt;
    return frame_polygon(node, corners);
}

/// Whether a hole or pane of some room's wall is at this place: nothing there receives light.
/// A neighbour's opening is an opening of the wall behind it, too.
bool is_in_opening(const std::vector<Room>& rooms, const Point3& p) {
    for (const Room& room : rooms)
        for (const WallOpening& o : room.openings) {
            const Point2 a = room.footprint[o.wall];
            const Point2 b = room.footprint[(o.wall + 1) % room.footprint.size()];
            const double wall_length = distance(a, b);
            const Point2 d{(b.x - a.x) / wall_length, (b.y - a.y) / wall_length};
            const double along = d.x * (p.x - a.x) + d.y * (p.y - a.y);
            const double beside = d.x * (p.y - a.y) - d.y * (p.x - a.x);
            const double above = p.z - room.floor_level - o.sill;
            if (o.state != OpeningState::closed && std::abs(beside) < 10.0 * rounding
                && along > o.offset && along < o.offset + o.width && above > 0.0
                && above < o.height)
                return true;
        }
    return false;
}

} // namespace

double standard_edge(const Room& room) noexcept {
    constexpr double widest = 0.5;         // m
    constexpr double share_of_side = 0.15; // EN 12464-1:2021
    const Rectangle2 bounds = bounding_rectangle(room.footprint);
    return std::min(widest, share_of_side * std::min(bounds.width(), bounds.depth()));
}

std::optional<SurfaceArea> make_plan_area(const Room& room, double height, double edge) {
    const Rectangle2 bounds = bounding_rectangle(room.footprint);
    SurfaceArea area;
    area.width = bounds.width() - 2.0 * edge;
    area.height = bounds.depth() - 2.0 * edge;
    if (area.width <= 0.0 || area.height <= 0.0)
        return std::nullopt;
    const double z = room.floor_level + height;
    area.frame = make_frame({bounds.lower.x + edge, bounds.lower.y + edge, z}, along_x, up);
    area.room = &room;
    area.edge = edge;
    std::vector<Point2> outline = make_inset(room.footprint, edge);
    if (outline.empty())
        outline = room.footprint;
    for (const Point2& p : outline)
        area.outline.push_back({p.x, p.y, z});
    return area;
}

std::optional<SurfaceArea>
read_area(const JsonNode& node, const std::string& form, const ProjectReader& reader) {
    if (form == "work_plane")
        return read_work_plane(node, reader);
    if (form == "floor" || form == "ceiling")
        return read_floor_or_ceiling(node, form, reader);
    if (form == "wall")
        return read_wall(node, reader);
    if (form == "polygon")
        return read_polygon(node);
    const JsonObject object(
        node, "a rectangle", {"corner", "u", "v", "centre", "size", "normal", "rotation"});
    const std::optional<std::string> given = object.require_one_of({"corner", "centre"});
    if (!given)
        return std::nullopt;
    return *given == "corner" ? read_corner_rectangle(object) : read_centre_rectangle(object);
}

bool is_measured(const SurfaceArea& area, const Point3& p) {
    if (area.rooms != nullptr)
        return !is_in_opening(*area.rooms, p);
    if (area.room == nullptr)
        return true;
    const Room& room = *area.room;
    const Point2 plan{p.x, p.y};
    const auto is_in = [&](const Column& c) {
        return is_inside(plan, c.outline) || distance_to_border(plan, c.outline) < rounding;
    };
    return is_inside(plan, room.footprint)
           && distance_to_border(plan, room.footprint) >= area.edge - rounding
           && std::none_of(room.columns.begin(), room.columns.end(), is_in);
}

} // namespace isolux
