#include "isolux/io/project_spots.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/io/outline.h"

namespace isolux {

namespace {

constexpr std::int64_t most_luminaires = 10'000; // of one entry
constexpr double air_gap = 1e-3; // m between the ceiling and the top of the opening

/// How many luminaires; 0 if that is wrong.
std::int64_t require_count(const JsonObject& object, std::string_view key) {
    const std::optional<JsonNode> node = object.require(key);
    return node ? read_integer(*node, 1, most_luminaires).value_or(0) : 0;
}

bool is_in_column(const Room& room, const Point2& p) {
    return std::any_of(room.columns.begin(), room.columns.end(), [&](const Column& c) {
        return is_inside(p, c.outline);
    });
}

/// The rectangle that a field fills: the room's bounding rectangle or a part of it.
std::optional<Rectangle2> read_field_area(const JsonObject& field, const Room& room) {
    Rectangle2 area = bounding_rectangle(room.footprint);
    const std::optional<JsonNode> corner_node = field.find("corner");
    const std::optional<JsonNode> size_node = field.find("size");
    if (!corner_node && !size_node)
        return area;
    const std::optional<Point2> corner =
        corner_node ? read_point2(*corner_node) : std::optional(area.lower);
    const std::optional<Point2> size =
        size_node ? read_size2(*size_node)
                  : std::optional(Point2{area.upper.x - corner.value_or(area.lower).x,
                                         area.upper.y - corner.value_or(area.lower).y});
    if (!corner || !size)
        return std::nullopt;
    if (size->x <= 0.0 || size->y <= 0.0) {
        corner_node->error("the corner lies beyond the room (nothing is left to fill)");
        return std::nullopt;
    }
    return Rectangle2{*corner, {corner->x + size->x, corner->y + size->y}};
}

/// z of the photometric centres of a field; nothing if that is not in the room (reported).
std::optional<double> read_field_height(const JsonObject& field,
                                        const Room& room,
                                        const ProjectReader& reader,
                                        const LuminaireTypeEntry* type) {
    const double ceiling = room.floor_level + room.height;
    field.exclude("height", {"suspended"});
    if (const std::optional<JsonNode> node = field.find("height")) {
        const std::optional<double> height = read_length(*node);
        if (!height || *height <= room.height)
            return height ? std::optional(room.floor_level + *height) : std::nullopt;
        node->error(fmt::format("{} m is above the ceiling (room \"{}\" is {} m high)",
                                *height,
                                room.name,
                                room.height));
        return std::nullopt;
    }
    if (const std::optional<JsonNode> node = field.find("suspended")) {
        const std::optional<double> below = read_length(*node);
        if (!below || *below < room.height)
            return below ? std::optional(ceiling - *below) : std::nullopt;
        node->error(
            fmt::format("{} m below the ceiling is below the floor (room \"{}\" is {} m "
                        "high)",
                        *below,
                        room.name,
                        room.height));
        return std::nullopt;
    }
    double above_centre = 0.0;
    if (type != nullptr && type->id) {
        const auto& types = reader.project.scene.luminaire_types;
        above_centre = 0.5 * in_metre(types[type->id->index()].opening.extent_z);
    }
    return ceiling - above_centre - air_gap;
}

std::vector<Spot>
read_field(const JsonNode& node, const ProjectReader& reader, const LuminaireTypeEntry* type) {
    const JsonObject field(
        node, "a field", {"room", "rows", "columns", "height", "suspended", "corner", "size"});
    const std::int64_t rows = require_count(field, "rows");
    const std::int64_t columns = require_count(field, "columns");
    const Room* room = reader.find_room(field);
    if (room == nullptr || rows == 0 || columns == 0)
        return {};
    if (rows * columns > most_luminaires) {
        node.error(fmt::format("{} luminaires are too many (at most {} an entry)",
                               rows * columns,
                               most_luminaires));
        return {};
    }
    const std::optional<Rectangle2> area = read_field_area(field, *room);
    const std::optional<double> z = read_field_height(field, *room, reader, type);
    if (!area || !z)
        return {};
    const double dx = area->width() / static_cast<double>(columns);
    const double dy = area->depth() / static_cast<double>(rows);
    std::vector<Spot> spots;
    for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i) {
            const Point2 p{area->lower.x + (static_cast<double>(i) + 0.5) * dx,
                           area->lower.y + (static_cast<double>(j) + 0.5) * dy};
            if (is_inside(p, room->footprint) && !is_in_column(*room, p))
                spots.push_back({{p.x, p.y, *z}, node.pointer()});
        }
    const auto left_out = static_cast<std::size_t>(rows * columns) - spots.size();
    if (spots.empty())
        node.error(fmt::format(
            "no luminaire of the field lies in room \"{}\" (all are left out)", room->name));
    else if (left_out > 0)
        node.notice(fmt::format("{} of {} luminaires fall outside room \"{}\" or into a column "
                                "(they are left out)",
                                left_out,
                                rows * columns,
                                room->name));
    return spots;
}

std::vector<Spot> read_line(const JsonNode& node) {
    const JsonObject line(node, "a line", {"from", "to", "count"});
    const std::optional<Point3> from = line.require("from", read_point);
    const std::optional<Point3> to = line.require("to", read_point);
    const std::int64_t count = require_count(line, "count");
    if (!from || !to || count == 0)
        return {};
    if (count > 1 && *from == *to) {
        node.error("the line starts where it ends (its luminaires would hang in one place)");
        return {};
    }
    std::vector<Spot> spots;
    for (std::int64_t i = 0; i < count; ++i) {
        const double t =
            count == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(count - 1);
        spots.push_back({*from + t * (*to - *from), node.pointer()});
    }
    return spots;
}

std::vector<Spot> read_ring(const JsonNode& node) {
    const JsonObject ring(node, "a ring", {"centre", "radius", "count", "start", "outwards"});
    const std::optional<Point3> centre = ring.require("centre", read_point);
    const std::optional<double> radius = ring.require("radius", read_length);
    const std::int64_t count = require_count(ring, "count");
    const double start = ring.number("start", any_angle, 0.0);
    const bool outwards = ring.boolean("outwards", false);
    if (!centre || !radius)
        return {};
    std::vector<Spot> spots;
    for (std::int64_t i = 0; i < count; ++i) {
        const double angle =
            start + 360.0 * static_cast<double>(i) / static_cast<double>(count);
        const double a = degrees(angle).in_radians();
        spots.push_back({*centre + *radius * Vector3{std::cos(a), std::sin(a), 0.0},
                         node.pointer(),
                         outwards ? angle : 0.0});
    }
    return spots;
}

} // namespace

std::vector<Spot> read_spots(const JsonObject& object,
                             const ProjectReader& reader,
                             const LuminaireTypeEntry* type) {
    const std::optional<std::string> form =
        object.require_one_of({"position", "positions", "field", "line", "ring"});
    if (!form)
        return {};
    const JsonNode node = *object.find(*form);
    if (*form == "field")
        return read_field(node, reader, type);
    if (*form == "line")
        return read_line(node);
    if (*form == "ring")
        return read_ring(node);
    std::vector<JsonNode> nodes{node};
    if (*form == "positions")
        nodes = read_list(node, 1);
    std::vector<Spot> spots;
    for (const JsonNode& item : nodes)
        if (const std::optional<Point3> position = read_point(item))
            spots.push_back({*position, item.pointer()});
    return spots;
}

} // namespace isolux
