#include "isolux/io/project_json.h"

#include <algorithm>

#include <fmt/format.h>

#include "isolux/io/json_lines.h"
#include "isolux/io/project_observers.h"
#include "isolux/io/project_reader.h"
#include "isolux/io/schema_check.h"
#include "isolux/io/sha256.h"
#include "isolux/io/suggest.h"
#include "isolux/io/text_file.h"

namespace isolux {

ProjectReader::ProjectReader(std::filesystem::path path, Problems& collected)
    : folder(path.parent_path()), problems(collected) {
    project.name = path.stem().string();
}

std::filesystem::path ProjectReader::path_of(const JsonNode& node) const {
    return (folder / std::filesystem::path(node.value().text)).lexically_normal();
}

std::optional<std::string> ProjectReader::read_file(const JsonNode& node,
                                                    std::uintmax_t largest) {
    try {
        std::string bytes = read_file_bytes(path_of(node), largest);
        add_input(node.value().text, bytes);
        return bytes;
    } catch (const InputError& error) {
        for (const Message& message : error.messages())
            node.error(message.what, message.hint);
        return std::nullopt;
    }
}

void ProjectReader::add_input(std::string file, std::string_view bytes) {
    project.inputs.push_back({std::move(file), sha256(bytes)});
}

const Room* ProjectReader::find_room(const JsonObject& owner) const {
    const std::optional<JsonNode> node = owner.find("room");
    std::vector<std::string> names;
    for (const RoomEntry& room : rooms)
        names.push_back(room.name);
    const auto room_of = [&](const RoomEntry& entry) {
        return entry.index ? &project.scene.rooms[*entry.index] : nullptr;
    };
    if (!node) {
        if (rooms.size() == 1)
            return room_of(rooms.front());
        owner.node().error(fmt::format("the key \"room\" is missing (the project has {} rooms)",
                                       rooms.size()));
        return nullptr;
    }
    const std::optional<std::string> name = read_text(*node);
    if (!name)
        return nullptr;
    for (const RoomEntry& entry : rooms)
        if (entry.name == *name)
            return room_of(entry);
    node->error(fmt::format("unknown room \"{}\" (rooms has no such name)", *name),
                did_you_mean(*name, names));
    return nullptr;
}

bool ProjectReader::has_wrong_room() const noexcept {
    return std::any_of(
        rooms.begin(), rooms.end(), [](const RoomEntry& room) { return !room.index; });
}

namespace {

std::string in_words(const Point2& p) { return fmt::format("({:.6g}, {:.6g})", p.x, p.y); }

} // namespace

std::string walls_in_words(const std::vector<Point2>& footprint) {
    constexpr std::size_t most_walls = 8;
    if (footprint.size() < 3 || footprint.size() > most_walls)
        return "Wall 1 runs from the footprint's first corner to its second, and so on";
    std::string words = fmt::format(
        "Wall 1 runs from {} to {}, ", in_words(footprint[0]), in_words(footprint[1]));
    for (std::size_t i = 1; i < footprint.size(); ++i) {
        const bool is_last = i + 1 == footprint.size();
        words += fmt::format("{}wall {} {} {}",
                             i == 1 ? "" : ", ",
                             i + 1,
                             is_last ? "back to" : "on to",
                             in_words(footprint[is_last ? 0 : i + 1]));
    }
    return words;
}

std::optional<std::int64_t> read_wall_number(const JsonNode& node,
                                             const std::vector<Point2>& footprint) {
    if (!node.is(JsonValue::Kind::text))
        return read_integer(node, 1, 1'000'000);
    node.error("the number of a wall is expected here (found text)", walls_in_words(footprint));
    return std::nullopt;
}

std::optional<double> read_distance(const JsonNode& node) {
    return read_number(node, any_distance);
}

std::optional<Point3> read_point(const JsonNode& node) {
    const auto v = read_numbers(node, 3, 3, "[x, y, z]", any_coordinate);
    return v ? std::optional(Point3{(*v)[0], (*v)[1], (*v)[2]}) : std::nullopt;
}

std::optional<Vector3> read_vector(const JsonNode& node) {
    const std::optional<Point3> p = read_point(node);
    return p ? std::optional(Vector3{p->x, p->y, p->z}) : std::nullopt;
}

std::optional<Point2> read_point2(const JsonNode& node) {
    const auto v = read_numbers(node, 2, 2, "[x, y]", any_coordinate);
    return v ? std::optional(Point2{(*v)[0], (*v)[1]}) : std::nullopt;
}

std::optional<Point2> read_size2(const JsonNode& node) {
    const auto v = read_numbers(node, 2, 2, "[x, y]", any_length);
    return v ? std::optional(Point2{(*v)[0], (*v)[1]}) : std::nullopt;
}

std::optional<std::vector<Point2>> read_outline(const JsonNode& node) {
    const std::vector<JsonNode> nodes = read_list(node, 3);
    std::vector<Point2> outline;
    for (const JsonNode& item : nodes)
        if (const std::optional<Point2> p = read_point2(item))
            outline.push_back(*p);
    return outline.size() >= 3 && outline.size() == nodes.size() ? std::optional(outline)
                                                                 : std::nullopt;
}

namespace {

/// Without a version nothing else is sure to mean what we think. @return false: stop here
bool check_version(const JsonObject& object) {
    const std::optional<JsonNode> node = object.find("isolux");
    if (!node) {
        object.node().error(
            "the key \"isolux\" is missing (it tells the version of the format)",
            "Add \"isolux\": 1?");
        return true;
    }
    if (node->is(JsonValue::Kind::number) && node->value().number == 1.0)
        return true;
    node->error("this version of the format is not known (the only one is 1)",
                "Is a newer isolux needed?");
    return false;
}

void read_everything(const JsonObject& object, ProjectReader& reader) {
    if (const std::optional<JsonNode> node = object.find("$schema"))
        static_cast<void>(read_text(*node, 4096));
    reader.project.name = object.text("name", reader.project.name);
    if (const std::optional<JsonNode> node = object.find("description")) {
        if (node->is(JsonValue::Kind::text))
            reader.project.description = node->value().text;
        else
            static_cast<void>(read_text(*node));
    }
    if (const std::optional<JsonNode> node = object.find("maintenance_factor"))
        reader.maintenance = read_maintenance(*node).value_or(MaintenanceFactor{});
    reader.states_maintenance = object.has("maintenance_factor");
    if (const std::optional<JsonNode> node = object.find("settings"))
        read_settings(*node, reader.project.settings);
    if (const std::optional<JsonNode> node = object.find("materials"))
        reader.materials.define(*node);
    if (const std::optional<JsonNode> node = object.find("rooms"))
        read_rooms(*node, reader);
    if (const std::optional<JsonNode> node = object.find("objects"))
        read_objects(*node, reader);
    if (const std::optional<JsonNode> node = object.require("luminaire_types"))
        read_luminaire_types(*node, reader);
    if (const std::optional<JsonNode> node = object.require("luminaires"))
        read_luminaires(*node, reader);
    if (const std::optional<JsonNode> node = object.find("surfaces"))
        read_surfaces(*node, reader);
    else
        add_default_surfaces(reader);
    for (const LuminairePlacement& l : reader.project.scene.luminaires)
        ++reader.project.schedule[l.type.index()].count;
    if (const std::optional<JsonNode> node = object.find("observers"))
        read_observers(*node, reader);
    read_requirements(object, reader);
    if (reader.problems.errors().empty())
        read_energy(object, reader);
    if (const std::optional<JsonNode> node = object.find("scenes"))
        read_scenes(*node, reader);
    if (const std::optional<JsonNode> node = object.find("views"))
        read_views(*node, reader);
    if (reader.project.surfaces.empty())
        reader.problems.notice("", "no calculation surface (nothing is measured)");
}

[[noreturn]] void throw_all(const Problems& problems, std::string_view text) {
    constexpr std::size_t most_messages = 200;
    std::vector<Message> messages = problems.errors();
    if (messages.size() > most_messages) {
        const std::size_t more = messages.size() - most_messages;
        messages.resize(most_messages);
        messages.push_back({problems.file(),
                            fmt::format("{} more problems (only the first are listed)", more),
                            {}});
    }
    add_lines(messages, problems.file(), text);
    throw InputError(std::move(messages));
}

} // namespace

Project parse_project(std::string_view text, const std::filesystem::path& path) {
    const std::string file = path.generic_string();
    const JsonValue document = parse_json(text, file);
    Problems problems(file);
    ProjectReader reader(path, problems);
    reader.project.file = {file, sha256(text)};
    const JsonObject object(JsonNode(document, "", problems),
                            "a project",
                            {"$schema",
                             "isolux",
                             "name",
                             "description",
                             "maintenance_factor",
                             "settings",
                             "materials",
                             "rooms",
                             "objects",
                             "luminaire_types",
                             "luminaires",
                             "surfaces",
                             "standards",
                             "requirements",
                             "observers",
                             "energy",
                             "scenes",
                             "views"});
    if (object.is_object() && check_version(object)) {
        read_everything(object, reader);
        for (const SchemaFinding& finding : check_project_schema(text))
            if (!problems.has_error_near(finding.pointer))
                problems.error(finding.pointer,
                               "does not match the schema (" + finding.reason + ")");
    }
    if (!problems.errors().empty())
        throw_all(problems, text);
    reader.project.scene.materials = reader.materials.materials();
    reader.project.notices = problems.notices();
    add_lines(reader.project.notices, file, text);
    return std::move(reader.project);
}

Project read_project(const std::filesystem::path& path) {
    return parse_project(read_file_bytes(path, FileLimits::project), path);
}

} // namespace isolux
