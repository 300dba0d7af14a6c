#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "isolux/io/outline.h"
#include "isolux/io/project_spots.h"
#include "isolux/io/suggest.h"
#include "isolux/scene/scene_space.h"

namespace isolux {

namespace {

struct Orientation {
    std::optional<Point3> aim;
    double spin = 0.0; // all in degrees
    double rotation = 0.0;
    double tilt = 0.0;
    double azimuth = 0.0;
};

std::string in_words(const Point3& p) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

const LuminaireTypeEntry* find_type(const JsonObject& object, const ProjectReader& reader) {
    const std::optional<JsonNode> node = object.require("type");
    const std::optional<std::string> name = node ? read_text(*node) : std::nullopt;
    if (!name)
        return nullptr;
    if (const auto known = reader.luminaire_types.find(*name);
        known != reader.luminaire_types.end())
        return &known->second;
    std::vector<std::string> names;
    for (const auto& [known, entry] : reader.luminaire_types)
        names.push_back(known);
    node->error(
        fmt::format("unknown luminaire type \"{}\" (luminaire_types has no such member)",
                    *name),
        did_you_mean(*name, names));
    return nullptr;
}

Orientation read_orientation(const JsonObject& object) {
    object.exclude("aim", {"rotation", "tilt", "azimuth"});
    Orientation o;
    if (const std::optional<JsonNode> aim = object.find("aim"))
        o.aim = read_point(*aim);
    else if (const std::optional<JsonNode> spin = object.find("spin"))
        spin->error("\"spin\" turns about the aim (there is no \"aim\")",
                    "Use \"rotation\" instead?");
    o.spin = object.number("spin", any_angle, 0.0);
    o.rotation = object.number("rotation", any_angle, 0.0);
    o.tilt = object.number("tilt", any_angle, 0.0);
    o.azimuth = object.number("azimuth", any_angle, 0.0);
    return o;
}

/// The frame of one luminaire; `turned` brings its y axis where the x axis would lie.
Frame make_frame(const Spot& spot, const Orientation& o, bool turned) {
    const Frame frame = o.aim ? make_aimed_frame(spot.position, *o.aim, degrees(o.spin))
                              : make_tilted_frame(spot.position,
                                                  degrees(o.rotation),
                                                  degrees(o.tilt),
                                                  degrees(o.azimuth + spot.extra_azimuth));
    return turned ? Frame{frame.origin, -frame.y, frame.x, frame.z} : frame;
}

/// A hint for a luminaire that hangs outside: often only the height is wrong, or the unit.
std::string hint_for_outside(const Point3& p, const std::vector<Room>& rooms) {
    for (const Room& room : rooms)
        if (is_inside({p.x, p.y}, room.footprint))
            return fmt::format("Room \"{}\" reaches from z = {:.6g} m to {:.6g} m",
                               room.name,
                               room.floor_level,
                               room.floor_level + room.height);
    constexpr double far = 100.0; // m
    std::string hint;
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > far)
        hint = "Is it in metres? ";
    return hint + extents_in_words(rooms);
}

/// Reports the luminaires of an entry that are outside every room, once for each key that put
/// them there.
void check_inside(const std::vector<Spot>& spots, const ProjectReader& reader) {
    const std::vector<Room>& rooms = reader.project.scene.rooms;
    if (reader.rooms.empty() || reader.has_wrong_room())
        return;
    const auto is_outside = [&](const Spot& spot) {
        return std::none_of(rooms.begin(), rooms.end(), [&](const Room& room) {
            return contains(room, spot.position);
        });
    };
    for (auto spot = spots.begin(); spot != spots.end();) {
        const auto end = std::find_if(
            spot, spots.end(), [&](const Spot& s) { return s.pointer != spot->pointer; });
        const auto outside = std::count_if(spot, end, is_outside);
        const auto first = std::find_if(spot, end, is_outside);
        if (outside == 1)
            reader.problems.error(first->pointer,
                                  fmt::format("the luminaire at {} is outside every room (no "
                                              "wall would reflect its light)",
                                              in_words(first->position)),
                                  hint_for_outside(first->position, rooms));
        else if (outside > 1)
            reader.problems.error(
                first->pointer,
                fmt::format("{} luminaires are outside every room, the first at {} (no wall "
                            "would reflect their light)",
                            outside == end - spot
                                ? fmt::format("all {}", outside)
                                : fmt::format("{} of {}", outside, end - spot),
                            in_words(first->position)),
                hint_for_outside(first->position, rooms));
        spot = end;
    }
}

/// Reports an aim without a direction.
bool check_aim(const JsonNode& node,
               const Spot& spot,
               const Orientation& orientation,
               const ProjectReader& reader) {
    if (!orientation.aim || *orientation.aim != spot.position)
        return true;
    reader.problems.error(node.pointer() + "/aim",
                          "the aim equals the position (no direction follows from it)",
                          "Aim at the floor below?");
    return false;
}

void read_luminaire(const JsonNode& node, ProjectReader& reader) {
    const JsonObject object(node,
                            "a luminaire",
                            {"type",
                             "name",
                             "position",
                             "positions",
                             "field",
                             "line",
                             "ring",
                             "aim",
                             "spin",
                             "rotation",
                             "tilt",
                             "azimuth",
                             "dimming",
                             "group"});
    const LuminaireTypeEntry* type = find_type(object, reader);
    const std::vector<Spot> spots = read_spots(object, reader, type);
    const Orientation orientation = read_orientation(object);
    const double dimming = object.number("dimming", any_share, 1.0);
    const std::string group = object.has("group") ? object.text("group", {}) : std::string();
    const std::string type_name =
        object.has("type") && object.find("type")->is(JsonValue::Kind::text)
            ? object.find("type")->value().text
            : std::string("luminaire");
    const std::string name = object.text("name", type_name);
    const bool turns = std::any_of(
        spots.begin(), spots.end(), [](const Spot& s) { return s.extra_azimuth != 0.0; });
    if (orientation.aim && turns)
        node.error(
            "\"outwards\" does not go with \"aim\" (both say where the luminaires look)");
    check_inside(spots, reader);
    for (const Spot& spot : spots) {
        if (!check_aim(node, spot, orientation, reader) || type == nullptr || !type->id)
            continue;
        reader.project.scene.luminaires.push_back(
            {name,
             *type->id,
             make_frame(spot, orientation, type->turn_length_to_x),
             dimming * type->scale,
             group});
    }
}

/// What the members of a wrong entry say, whatever they are called: one of them may be the name
/// that others mean.
void note_texts(const JsonNode& entry, std::set<std::string>& names) {
    for (const JsonMember& member : entry.value().members)
        if (member.value.kind == JsonValue::Kind::text)
            names.insert(member.value.text);
}

/// Luminaires that share a name get numbers.
void number_names(std::vector<LuminairePlacement>& luminaires) {
    std::map<std::string, std::size_t> count;
    for (const LuminairePlacement& l : luminaires)
        ++count[l.name];
    std::map<std::string, std::size_t> number;
    for (LuminairePlacement& l : luminaires)
        if (count[l.name] > 1) {
            const std::size_t n = ++number[l.name];
            l.name = fmt::format("{} {}", l.name, n);
        }
}

} // namespace

void read_luminaires(const JsonNode& node, ProjectReader& reader) {
    const std::vector<JsonNode> nodes = read_list(node, 1);
    const std::size_t errors = reader.problems.errors().size();
    for (const JsonNode& item : nodes) {
        const std::size_t errors_before = reader.problems.errors().size();
        const std::size_t placed_before = reader.project.scene.luminaires.size();
        read_luminaire(item, reader);
        if (reader.problems.errors().size() > errors_before
            || reader.project.scene.luminaires.size() == placed_before)
            note_texts(item, reader.lost_names);
    }
    std::vector<LuminairePlacement>& luminaires = reader.project.scene.luminaires;
    number_names(luminaires);
    const bool all_off =
        std::all_of(luminaires.begin(), luminaires.end(), [](const LuminairePlacement& l) {
            return l.scale == 0.0;
        });
    if (all_off && !luminaires.empty() && reader.problems.errors().size() == errors)
        node.error("all luminaires are dimmed to 0 (there would be no light)");
}

} // namespace isolux
