#include <algorithm>

#include <fmt/format.h>

#include "isolux/io/outline.h"
#include "isolux/io/project_reader.h"

namespace isolux {

namespace {

constexpr std::size_t corners_of_round_column = 24;

std::optional<std::vector<Point2>> read_column_outline(const JsonObject& object) {
    const std::optional<std::string> form =
        object.require_one_of({"outline", "size", "diameter"});
    if (!form)
        return std::nullopt;
    if (*form == "outline") {
        object.exclude("outline", {"centre"});
        const JsonNode node = *object.find("outline");
        std::optional<std::vector<Point2>> outline = read_outline(node);
        if (!outline || !check_outline(node, *outline))
            return std::nullopt;
        if (signed_area(*outline) < 0.0)
            std::reverse(outline->begin(), outline->end());
        return outline;
    }
    const std::optional<Point2> centre = object.require("centre", read_point2);
    const JsonNode node = *object.find(*form);
    if (*form == "diameter") {
        const std::optional<double> diameter = read_number(node, any_length);
        if (!centre || !diameter)
            return std::nullopt;
        return make_round_outline(*centre, *diameter, corners_of_round_column);
    }
    const std::optional<Point2> size = read_size2(node);
    if (!centre || !size)
        return std::nullopt;
    const double x = 0.5 * size->x;
    const double y = 0.5 * size->y;
    return std::vector<Point2>{{centre->x - x, centre->y - y},
                               {centre->x + x, centre->y - y},
                               {centre->x + x, centre->y + y},
                               {centre->x - x, centre->y + y}};
}

} // namespace

void read_column(const JsonNode& node, ProjectReader& reader, Room& room) {
    const JsonObject object(
        node, "a column", {"outline", "centre", "size", "diameter", "material"});
    std::optional<std::vector<Point2>> outline = read_column_outline(object);
    Column column;
    const std::optional<JsonNode> material = object.find("material");
    column.material = material ? reader.materials.resolve(*material) : room.walls.front();
    if (!outline)
        return;
    column.outline = std::move(*outline);
    if (!is_inside(column.outline.front(), room.footprint)
        || border_distance(column.outline, room.footprint) < shortest_wall)
        node.error(
            "the column does not stand free inside the footprint (columns and walls must "
            "not touch)",
            "Make a column at a wall part of the footprint?");
    for (std::size_t i = 0; i < room.columns.size(); ++i) {
        const std::vector<Point2>& other = room.columns[i].outline;
        if (border_distance(column.outline, other) < shortest_wall
            || is_inside(column.outline.front(), other)
            || is_inside(other.front(), column.outline))
            node.error(
                fmt::format("the column touches column {} (columns must stand apart)", i + 1));
    }
    room.columns.push_back(std::move(column));
}

} // namespace isolux
