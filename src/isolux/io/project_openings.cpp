#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "isolux/io/outline.h"
#include "isolux/io/project_reader.h"

namespace isolux {

namespace {

constexpr double rounding = 1e-6; // m; forgives sums such as 0.1 + 0.2

MaterialId
opening_material(const JsonObject& object, const WallOpening& opening, ProjectReader& reader) {
    MaterialTable& materials = reader.materials;
    const std::optional<JsonNode> node = object.find("material");
    if (!node)
        return opening.state == OpeningState::glazed ? *materials.find("window glass")
                                                     : materials.grey(0.5);
    const MaterialId id = materials.resolve(*node);
    if (opening.state == OpeningState::open)
        node->error("an open opening has no material (there is nothing)",
                    "Make its state \"closed\" or \"glazed\"?");
    else if (opening.state == OpeningState::glazed && !materials.is_pane(id))
        node->error("the material of a glazed opening is not a pane (it would be opaque)",
                    "Make its state \"closed\"?");
    else if (opening.state == OpeningState::closed && materials.is_pane(id))
        node->error("the material of a closed opening is a pane (light would pass)",
                    "Make its state \"glazed\"?");
    return id;
}

/// Reports an opening that reaches beyond its wall.
void check_within_wall(const JsonObject& object, const WallOpening& opening, const Room& room) {
    const std::vector<Point2>& corners = room.footprint;
    const double wall_length =
        distance(corners[opening.wall], corners[(opening.wall + 1) % corners.size()]);
    if (opening.offset + opening.width > wall_length + rounding)
        object.node().error(
            fmt::format("the opening ends {:.6g} m along wall {} (the wall is {:.6g} m long)",
                        opening.offset + opening.width,
                        opening.wall + 1,
                        wall_length));
    if (opening.sill + opening.height > room.height + rounding)
        object.node().error(
            fmt::format("the opening ends {:.6g} m above the floor (the room is {:.6g} m high)",
                        opening.sill + opening.height,
                        room.height));
}

bool do_overlap(const WallOpening& a, const WallOpening& b) {
    return a.wall == b.wall && a.offset + rounding < b.offset + b.width
           && b.offset + rounding < a.offset + a.width && a.sill + rounding < b.sill + b.height
           && b.sill + rounding < a.sill + a.height;
}

} // namespace

void read_opening(const JsonNode& node, ProjectReader& reader, Room& room) {
    const JsonObject object(
        node,
        "an opening",
        {"name", "wall", "offset", "sill", "width", "height", "state", "material"});
    WallOpening opening;
    opening.name = object.text("name", fmt::format("opening {}", room.openings.size() + 1));
    const std::optional<std::int64_t> number = object.require(
        "wall", [&](const JsonNode& wall) { return read_wall_number(wall, room.footprint); });
    const std::optional<double> offset = object.require("offset", read_distance);
    const std::optional<double> width = object.require("width", read_length);
    const std::optional<double> height = object.require("height", read_length);
    opening.sill = object.number("sill", any_distance, 0.0);
    if (const std::optional<JsonNode> state = object.find("state")) {
        constexpr std::array<std::string_view, 3> words{"open", "closed", "glazed"};
        opening.state = static_cast<OpeningState>(read_choice(*state, words).value_or(0));
    }
    opening.material = opening_material(object, opening, reader);
    if (number && static_cast<std::size_t>(*number) > room.footprint.size()) {
        object.find("wall")->error(
            fmt::format("there is no wall {} (the room has walls 1 to {})",
                        *number,
                        room.footprint.size()));
        return;
    }
    if (!number || !offset || !width || !height)
        return;
    opening.wall = static_cast<std::size_t>(*number - 1);
    opening.offset = *offset;
    opening.width = *width;
    opening.height = *height;
    check_within_wall(object, opening, room);
    for (const WallOpening& other : room.openings) {
        if (do_overlap(opening, other))
            node.error(fmt::format("the opening overlaps \"{}\" (each place of a wall belongs "
                                   "to one opening)",
                                   other.name));
        if (opening.name == other.name)
            node.error(fmt::format("the name \"{}\" is taken by another opening of this room "
                                   "(surfaces are found by name)",
                                   opening.name));
    }
    room.openings.push_back(std::move(opening));
}

} // namespace isolux
