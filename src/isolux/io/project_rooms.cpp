#include <algorithm>

#include <fmt/format.h>

#include "isolux/io/outline.h"
#include "isolux/io/project_reader.h"

namespace isolux {

bool check_outline(const JsonNode& node, const std::vector<Point2>& outline) {
    constexpr std::size_t most_corners = 1000;
    if (outline.size() > most_corners) {
        node.error(
            fmt::format("{} corners are too many (at most {})", outline.size(), most_corners));
        return false;
    }
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        if (distance(outline[i], outline[next]) >= shortest_wall)
            continue;
        node.error(fmt::format("corners {} and {} coincide (no wall fits between them)",
                               i + 1,
                               next + 1),
                   next == 0 ? "Leave out the last corner: the outline closes by itself" : "");
        return false;
    }
    if (!is_simple(outline)) {
        node.error("the outline crosses or touches itself (it has no clear inside)",
                   "Are two corners in the wrong order?");
        return false;
    }
    return true;
}

namespace {

std::optional<std::vector<Point2>> read_footprint(const JsonObject& room) {
    const std::optional<std::string> form = room.require_one_of({"size", "footprint"});
    if (!form)
        return std::nullopt;
    const JsonNode node = *room.find(*form);
    if (*form == "size") {
        const std::optional<Point2> size = read_size2(node);
        if (!size)
            return std::nullopt;
        return std::vector<Point2>{{0, 0}, {size->x, 0}, {size->x, size->y}, {0, size->y}};
    }
    std::optional<std::vector<Point2>> outline = read_outline(node);
    if (!outline || !check_outline(node, *outline))
        return std::nullopt;
    if (signed_area(*outline) < 0.0) {
        node.error("the footprint runs clockwise (walls are numbered counter-clockwise seen "
                   "from above)",
                   "Write the corners in the opposite order?");
        return std::nullopt;
    }
    return outline;
}

std::optional<std::size_t> wall_number(std::string_view key) {
    constexpr std::string_view word = "wall ";
    if (key.substr(0, word.size()) != word || key.size() == word.size() || key.size() > 10)
        return std::nullopt;
    std::size_t number = 0;
    for (const char c : key.substr(word.size())) {
        if (c < '0' || c > '9')
            return std::nullopt;
        number = 10 * number + static_cast<std::size_t>(c - '0');
    }
    return number;
}

bool is_wall_key(std::string_view key) { return wall_number(key).has_value(); }

void read_finishes(const JsonObject& room_object, ProjectReader& reader, Room& room) {
    constexpr double floor = 0.2; // the usual design values of interiors
    constexpr double ceiling = 0.7;
    constexpr double wall = 0.5;
    MaterialTable& materials = reader.materials;
    const std::size_t walls = room.footprint.size();
    room.floor = materials.grey(floor);
    room.ceiling = materials.grey(ceiling);
    room.walls.assign(walls, materials.grey(wall));
    const std::optional<JsonNode> node = room_object.find("reflectances");
    if (!node)
        return;
    const JsonObject finishes(
        *node, "reflectances", {"floor", "ceiling", "walls"}, is_wall_key);
    if (const std::optional<JsonNode> given = finishes.find("floor"))
        room.floor = materials.resolve(*given);
    if (const std::optional<JsonNode> given = finishes.find("ceiling"))
        room.ceiling = materials.resolve(*given);
    if (const std::optional<JsonNode> given = finishes.find("walls"))
        room.walls.assign(walls, materials.resolve(*given));
    for (const JsonMember& member : node->value().members) {
        const std::optional<std::size_t> number = wall_number(member.key);
        if (!number)
            continue;
        const JsonNode given = node->member(member.key, member.value);
        if (*number < 1 || *number > walls)
            given.error(
                fmt::format("there is no {} (the room has walls 1 to {})", member.key, walls));
        else
            room.walls[*number - 1] = materials.resolve(given);
    }
}

void move(std::vector<Point2>& outline, const Point2& by) {
    for (Point2& p : outline)
        p = {p.x + by.x, p.y + by.y};
}

std::string
read_room_name(const JsonObject& object, const ProjectReader& reader, bool is_only) {
    const std::string fallback =
        is_only ? "room" : fmt::format("room {}", reader.rooms.size() + 1);
    std::string name = object.text("name", fallback);
    for (const RoomEntry& other : reader.rooms)
        if (other.name == name)
            object.node().error(
                fmt::format("the room name \"{}\" is taken (rooms are found by name)", name));
    return name;
}

/// "6 m x 4 m, 3 m high"
std::string size_in_words(const Rectangle2& bounds, double height) {
    return fmt::format(
        "{:.6g} m x {:.6g} m, {:.6g} m high", bounds.width(), bounds.depth(), height);
}

/// Reports a room of a size that only another unit explains. @return false: it is an error
bool check_size(const JsonObject& object, const Room& room) {
    constexpr double longest = 1000.0; // m
    constexpr double highest = 100.0;
    constexpr double unusual_height = 30.0;
    const Rectangle2 bounds = bounding_rectangle(room.footprint);
    const double side = std::max(bounds.width(), bounds.depth());
    const char* unit =
        room.height > highest && room.height < 1500.0 ? "centimetres" : "millimetres";
    if (side > longest || room.height > highest) {
        object.node().error(fmt::format("the room is {} (at most {} m x {} m, {} m high)",
                                        size_in_words(bounds, room.height),
                                        longest,
                                        longest,
                                        highest),
                            fmt::format("Are these {}? isolux takes metres", unit));
        return false;
    }
    if (room.height > unusual_height)
        object.find("height")
            .value_or(object.node())
            .notice(fmt::format("the room is {} (higher than {} m)",
                                size_in_words(bounds, room.height),
                                unusual_height),
                    "Are these centimetres? isolux takes metres");
    return true;
}

std::optional<Room> read_room(const JsonObject& object, ProjectReader& reader) {
    Room room;
    const std::optional<std::vector<Point2>> footprint = read_footprint(object);
    const std::optional<double> height = object.require("height", read_length);
    room.floor_level = object.number("floor_level", any_coordinate, 0.0);
    const std::optional<JsonNode> position_node = object.find("position");
    const Point2 position =
        position_node ? read_point2(*position_node).value_or(Point2{}) : Point2{};
    if (!footprint || !height)
        return std::nullopt;
    room.footprint = *footprint;
    room.height = *height;
    if (!check_size(object, room))
        return std::nullopt;
    read_finishes(object, reader, room);
    if (const std::optional<JsonNode> openings = object.find("openings"))
        for (const JsonNode& opening : read_list(*openings))
            read_opening(opening, reader, room);
    if (const std::optional<JsonNode> columns = object.find("columns"))
        for (const JsonNode& column : read_list(*columns))
            read_column(column, reader, room);
    move(room.footprint, position);
    for (Column& column : room.columns)
        move(column.outline, position);
    return room;
}

/// Reports a room that shares space with an earlier one.
void check_overlap(const JsonNode& node, const Room& room, const std::vector<Room>& others) {
    const Rectangle2 bounds = bounding_rectangle(room.footprint);
    for (const Room& other : others) {
        const Rectangle2 theirs = bounding_rectangle(other.footprint);
        const bool is_apart =
            bounds.lower.x > theirs.upper.x || theirs.lower.x > bounds.upper.x
            || bounds.lower.y > theirs.upper.y || theirs.lower.y > bounds.upper.y
            || room.floor_level + shortest_wall > other.floor_level + other.height
            || other.floor_level + shortest_wall > room.floor_level + room.height;
        if (!is_apart && do_overlap(room.footprint, other.footprint))
            node.error(
                fmt::format("room \"{}\" overlaps room \"{}\" (each place belongs to one "
                            "room)",
                            room.name,
                            other.name),
                "Give it a \"position\" beside the other?");
    }
}

} // namespace

void read_rooms(const JsonNode& node, ProjectReader& reader) {
    const std::vector<JsonNode> nodes = read_list(node);
    for (const JsonNode& item : nodes) {
        const JsonObject object(item,
                                "a room",
                                {"name",
                                 "size",
                                 "footprint",
                                 "position",
                                 "floor_level",
                                 "height",
                                 "reflectances",
                                 "openings",
                                 "columns"});
        RoomEntry entry{read_room_name(object, reader, nodes.size() == 1), std::nullopt};
        if (std::optional<Room> room = read_room(object, reader)) {
            room->name = entry.name;
            check_overlap(item, *room, reader.project.scene.rooms);
            entry.index = reader.project.scene.rooms.size();
            reader.project.scene.rooms.push_back(std::move(*room));
        }
        reader.rooms.push_back(std::move(entry));
    }
}

} // namespace isolux
