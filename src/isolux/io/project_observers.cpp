#include "isolux/io/project_observers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "isolux/io/json_build.h"
#include "isolux/io/project_bands.h"
#include "isolux/io/project_reader.h"
#include "isolux/io/suggest.h"

namespace isolux {

namespace {

constexpr double default_spacing = 2.0; ///< m, of a grid of observers
constexpr std::size_t most_lines = 100'000;

UnitVector3 level(double angle_in_degrees) {
    const double a = degrees(angle_in_degrees).in_radians();
    return UnitVector3::from_unit({std::cos(a), std::sin(a), 0.0});
}

/// Degrees from +x towards +y, [x, y] or [x, y, z].
std::optional<UnitVector3> read_sight(const JsonNode& node) {
    if (!node.is(JsonValue::Kind::array)) {
        const std::optional<double> angle = read_number(node, any_angle);
        return angle ? std::optional(level(*angle)) : std::nullopt;
    }
    const auto v = read_numbers(node, 2, 3, "[x, y] or [x, y, z]", any_coordinate);
    if (!v)
        return std::nullopt;
    const Vector3 direction{(*v)[0], (*v)[1], v->size() == 3 ? (*v)[2] : 0.0};
    if (length(direction) > 0.0)
        return UnitVector3(direction);
    node.error("the vector has no length (no direction follows from it)");
    return std::nullopt;
}

/// Every way to look, `count` of them, tipped down by an angle.
std::vector<UnitVector3> all_around(int count, double down) {
    std::vector<UnitVector3> directions;
    const double dip = std::tan(degrees(down).in_radians());
    for (int i = 0; i < count; ++i) {
        const UnitVector3 d = level(360.0 * i / count);
        directions.push_back(UnitVector3(Vector3(d) - Vector3{0.0, 0.0, dip}));
    }
    return directions;
}

std::vector<UnitVector3>
read_directions(const JsonObject& object, bool is_grid, GlareScale scale) {
    std::vector<UnitVector3> directions;
    object.exclude("direction", {"directions"});
    if (const std::optional<JsonNode> one = object.find("direction")) {
        if (const std::optional<UnitVector3> d = read_sight(*one))
            directions.push_back(*d);
    } else if (const std::optional<JsonNode> list = object.find("directions")) {
        for (const JsonNode& node : read_list(*list, 1))
            if (const std::optional<UnitVector3> d = read_sight(node))
                directions.push_back(*d);
    } else if (scale == GlareScale::outdoor) {
        directions = all_around(8, 2.0);
    } else {
        directions = all_around(is_grid ? 4 : 12, 0.0);
    }
    return directions;
}

std::vector<Point3> read_eyes(const JsonObject& object, ProjectReader& reader) {
    std::vector<Point3> eyes;
    const std::optional<std::string> form =
        object.require_one_of({"position", "positions", "grid"});
    if (!form)
        return eyes;
    const JsonNode node = *object.find(*form);
    if (*form == "position") {
        if (const std::optional<Point3> p = read_point(node))
            eyes.push_back(*p);
        return eyes;
    }
    if (*form == "positions") {
        for (const JsonNode& item : read_list(node, 1))
            if (const std::optional<Point3> p = read_point(item))
                eyes.push_back(*p);
        return eyes;
    }
    const JsonObject grid(node, "a grid of observers", {"room", "height", "spacing", "edge"});
    const double height = grid.number("height", any_distance, seated_head_height);
    const double spacing = grid.number("spacing", any_length, default_spacing);
    const std::optional<JsonNode> edge = grid.find("edge");
    if (const Room* room = reader.find_room(grid))
        eyes = make_observer_grid(
            node, *room, height, spacing, edge ? read_distance(*edge) : std::nullopt, reader);
    return eyes;
}

std::string room_around(const Point3& eye, const ProjectReader& reader) {
    for (const Room& room : reader.project.scene.rooms)
        if (contains(room, eye))
            return room.name;
    return {};
}

void read_ground(const JsonObject& object, ProjectReader& reader, ObserverGroup& group) {
    const std::optional<JsonNode> node =
        group.scale == GlareScale::outdoor ? object.require("ground") : object.find("ground");
    const std::optional<std::string> name = node ? read_text(*node) : std::nullopt;
    if (!name)
        return;
    std::vector<std::string> names;
    for (std::size_t s = 0; s < reader.project.surfaces.size(); ++s) {
        names.push_back(reader.project.surfaces[s].name);
        if (names.back() == *name)
            group.ground = s;
    }
    if (!group.ground && !reader.lost_names.contains(*name))
        node->error(fmt::format("unknown surface \"{}\" (surfaces has no such name)", *name),
                    did_you_mean(*name, names));
}

std::optional<ObserverGroup>
read_group(const JsonNode& node, std::size_t number, ProjectReader& reader) {
    const JsonObject object(node,
                            "a group of observers",
                            {"name",
                             "position",
                             "positions",
                             "grid",
                             "direction",
                             "directions",
                             "rating",
                             "sources",
                             "ground",
                             "reflectance"});
    ObserverGroup group;
    group.name = object.text("name", fmt::format("observers {}", number));
    if (const std::optional<JsonNode> rating = object.find("rating")) {
        constexpr std::array<std::string_view, 2> words{"UGR", "GR"};
        group.scale = static_cast<GlareScale>(read_choice(*rating, words).value_or(0));
    }
    if (const std::optional<JsonNode> sources = object.find("sources")) {
        constexpr std::array<std::string_view, 2> words{"in front", "in table"};
        group.sources = static_cast<GlareSources>(read_choice(*sources, words).value_or(0));
    }
    group.ground_reflectance = object.number("reflectance", any_share, 0.2);
    read_ground(object, reader, group);
    const std::vector<Point3> eyes = read_eyes(object, reader);
    const std::vector<UnitVector3> directions =
        read_directions(object, object.has("grid"), group.scale);
    if (eyes.size() * directions.size() > most_lines) {
        node.error(fmt::format("{} lines of sight are too many (at most {} a group)",
                               eyes.size() * directions.size(),
                               most_lines));
        return std::nullopt;
    }
    for (const Point3& eye : eyes)
        for (const UnitVector3& d : directions)
            group.sight_lines.push_back({eye, d});
    if (group.sight_lines.empty())
        return std::nullopt;
    group.room = room_around(eyes.front(), reader);
    return group;
}

} // namespace

std::vector<Point3> make_observer_grid(const JsonNode& node,
                                       const Room& room,
                                       double height,
                                       double spacing,
                                       std::optional<double> edge,
                                       ProjectReader& reader) {
    JsonValue plane =
        json_object({{"room", json_text(room.name)}, {"height", json_number(height)}});
    if (edge)
        plane.members.push_back({"edge", json_number(*edge)});
    const JsonValue value = json_object(
        {{"work_plane", plane}, {"grid", json_object({{"spacing", json_number(spacing)}})}});
    Problems own(reader.problems.file());
    std::vector<Point3> eyes;
    if (const auto surface = read_one_surface(JsonNode(value, "", own), reader))
        for (const Receiver& r : surface->receivers)
            eyes.push_back(r.point);
    for (const Message& m : own.errors())
        node.error(m.what, m.hint);
    return eyes;
}

ObserverGroup
make_room_observers(const JsonNode& node, const Room& room, ProjectReader& reader) {
    ObserverGroup group;
    group.name = room.name + " observers";
    group.room = room.name;
    constexpr int directions = 4;
    constexpr double rounding_up = 1.02; // of the grid's columns and rows
    const double fewest = rounding_up
                          * std::sqrt(directions * std::abs(signed_area(room.footprint))
                                      / static_cast<double>(most_lines));
    const double spacing = std::max(default_spacing, fewest);
    if (spacing > default_spacing)
        node.notice(fmt::format("the observers of room \"{}\" stand {:.3g} m apart (every {} m "
                                "would make more than {} lines of sight)",
                                room.name,
                                spacing,
                                default_spacing,
                                most_lines));
    for (const Point3& eye : make_observer_grid(node,
                                                room,
                                                std::min(seated_head_height, room.height),
                                                spacing,
                                                std::nullopt,
                                                reader))
        for (const UnitVector3& d : all_around(directions, 0.0))
            group.sight_lines.push_back({eye, d});
    return group;
}

void read_observers(const JsonNode& node, ProjectReader& reader) {
    std::set<std::string> names;
    const std::vector<JsonNode> nodes = read_list(node);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::optional<ObserverGroup> group = read_group(nodes[i], i + 1, reader);
        if (!group)
            continue;
        if (!names.insert(group->name).second)
            nodes[i].error(fmt::format("the name \"{}\" is taken (observers are told apart by "
                                       "their names)",
                                       group->name));
        reader.project.observers.push_back(std::move(*group));
    }
}

} // namespace isolux
