#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "isolux/io/project_reader.h"
#include "isolux/io/suggest.h"
#include "isolux/io/text_file.h"
#include "isolux/scene/primitives.h"

namespace isolux {

namespace {

constexpr std::int64_t most_copies = 10'000;
constexpr double default_reflectance = 0.5;

std::optional<MeshFileFormat> read_format(const JsonNode& node) {
    const std::string& file = node.value().text;
    const std::size_t dot = file.rfind('.');
    std::string ending = dot == std::string::npos ? std::string() : file.substr(dot + 1);
    for (char& c : ending)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    constexpr std::array<std::string_view, 4> endings{"obj", "ply", "stl", "off"};
    const auto known = std::find(endings.begin(), endings.end(), ending);
    if (known != endings.end())
        return static_cast<MeshFileFormat>(known - endings.begin());
    node.error(
        fmt::format("\"{}\" is not a mesh file we read (obj, ply, stl and off are)", file));
    return std::nullopt;
}

std::optional<SurfaceMesh> read_mesh(const JsonNode& node, ProjectReader& reader) {
    if (!read_text(node, 4096))
        return std::nullopt;
    const std::optional<MeshFileFormat> format = read_format(node);
    const std::optional<std::string> bytes =
        format ? reader.read_file(node, FileLimits::mesh) : std::nullopt;
    if (!bytes)
        return std::nullopt;
    try {
        Parsed<SurfaceMesh> parsed =
            parse_mesh(*bytes, *format, reader.path_of(node).generic_string());
        reader.problems.add_notices(std::move(parsed.notices));
        if (!parsed.value.triangles().empty())
            return std::move(parsed.value);
        node.error("the mesh has no faces (light would not meet anything)");
    } catch (const InputError& error) {
        reader.problems.add_errors(error.messages());
    }
    return std::nullopt;
}

std::optional<SurfaceMesh> read_cylinder(const JsonNode& node) {
    const JsonObject object(node, "a cylinder", {"diameter", "height", "segments"});
    const std::optional<JsonNode> diameter = object.require("diameter");
    const std::optional<JsonNode> height = object.require("height");
    const std::optional<double> d =
        diameter ? read_number(*diameter, any_length) : std::nullopt;
    const std::optional<double> h = height ? read_number(*height, any_length) : std::nullopt;
    const std::optional<JsonNode> segments = object.find("segments");
    const std::optional<std::int64_t> n =
        segments ? read_integer(*segments, 3, 1000) : std::optional<std::int64_t>(32);
    if (!d || !h || !n)
        return std::nullopt;
    return make_cylinder(*d, *h, static_cast<int>(*n));
}

std::optional<SurfaceMesh>
read_shape(const JsonObject& object, const std::string& form, ProjectReader& reader) {
    const JsonNode node = *object.find(form);
    if (form == "mesh")
        return read_mesh(node, reader);
    object.exclude(form, {"materials"});
    if (form == "cylinder")
        return read_cylinder(node);
    if (form == "box") {
        const auto size = read_numbers(node, 3, 3, "[x, y, z]", any_length);
        return size ? std::optional(make_box({(*size)[0], (*size)[1], (*size)[2]}))
                    : std::nullopt;
    }
    const auto size = read_numbers(node, 2, 2, "[width, height]", any_length);
    return size ? std::optional(make_panel((*size)[0], (*size)[1])) : std::nullopt;
}

/// The object's frame: turned about the world's x, y and z in this order, then moved.
Frame read_frame(const JsonObject& object) {
    Frame frame;
    if (const std::optional<JsonNode> node = object.find("position"))
        frame.origin = read_point(*node).value_or(Point3{});
    const std::optional<JsonNode> node = object.find("rotation");
    if (!node)
        return frame;
    std::array<double, 3> turns{0.0, 0.0, 0.0};
    if (node->is(JsonValue::Kind::array)) {
        const auto given = read_numbers(*node, 3, 3, "[about x, about y, about z]", any_angle);
        if (given)
            std::copy(given->begin(), given->end(), turns.begin());
    } else {
        turns[2] = read_number(*node, any_angle).value_or(0.0);
    }
    const std::array axes{UnitVector3::from_unit({1, 0, 0}),
                          UnitVector3::from_unit({0, 1, 0}),
                          UnitVector3::from_unit({0, 0, 1})};
    for (std::size_t i = 0; i < axes.size(); ++i)
        if (turns[i] != 0.0)
            frame = rotate(frame, axes[i], degrees(turns[i]));
    return frame;
}

Vector3 read_scale(const JsonObject& object) {
    const Vector3 unscaled{1.0, 1.0, 1.0};
    const std::optional<JsonNode> node = object.find("scale");
    if (!node)
        return unscaled;
    std::vector<double> factors;
    if (node->is(JsonValue::Kind::array))
        factors =
            read_numbers(*node, 3, 3, "[x, y, z]", any_factor).value_or(std::vector<double>{});
    else if (const std::optional<double> factor = read_number(*node, any_factor))
        factors = {*factor, *factor, *factor};
    if (factors.size() != 3)
        return unscaled;
    if (std::find(factors.begin(), factors.end(), 0.0) != factors.end()) {
        node->error("a factor of 0 leaves nothing of the object (it must not be 0)");
        return unscaled;
    }
    return {factors[0], factors[1], factors[2]};
}

/// Where each copy stands, from the first one.
std::vector<Vector3> read_offsets(const JsonObject& object) {
    const std::vector<Vector3> single{{0.0, 0.0, 0.0}};
    const std::optional<JsonNode> node = object.find("array");
    if (!node)
        return single;
    const JsonObject array(*node, "an array", {"count", "spacing"});
    const std::optional<JsonNode> count_node = array.require("count");
    const std::optional<JsonNode> spacing_node = array.require("spacing");
    const NumberRange any_count{1.0, static_cast<double>(most_copies)};
    const auto count =
        count_node ? read_numbers(*count_node, 2, 3, "[nx, ny]", any_count) : std::nullopt;
    const auto spacing = spacing_node
                             ? read_numbers(*spacing_node, 2, 3, "[dx, dy]", any_coordinate)
                             : std::nullopt;
    if (!count || !spacing)
        return single;
    if (count->size() != spacing->size()) {
        node->error(fmt::format("count has {} numbers, spacing {} (they belong together)",
                                count->size(),
                                spacing->size()));
        return single;
    }
    std::array<std::int64_t, 3> n{1, 1, 1};
    for (std::size_t i = 0; i < count->size(); ++i) {
        const std::optional<std::int64_t> whole =
            read_integer(count_node->item(i), 1, most_copies);
        if (!whole)
            return single;
        n[i] = *whole;
    }
    if (n[0] * n[1] * n[2] > most_copies) {
        count_node->error(fmt::format(
            "{} copies are too many (at most {})", n[0] * n[1] * n[2], most_copies));
        return single;
    }
    const double dz = spacing->size() > 2 ? (*spacing)[2] : 0.0;
    std::vector<Vector3> offsets;
    for (std::int64_t k = 0; k < n[2]; ++k)
        for (std::int64_t j = 0; j < n[1]; ++j)
            for (std::int64_t i = 0; i < n[0]; ++i)
                offsets.push_back({static_cast<double>(i) * (*spacing)[0],
                                   static_cast<double>(j) * (*spacing)[1],
                                   static_cast<double>(k) * dz});
    return offsets;
}

/// What each slot of the shape is made of.
std::vector<MaterialId> read_slots(const JsonObject& object,
                                   const std::vector<std::string>& slots,
                                   ProjectReader& reader) {
    MaterialTable& materials = reader.materials;
    const std::optional<JsonNode> all = object.find("material");
    const MaterialId rest = all ? materials.resolve(*all) : materials.grey(default_reflectance);
    std::map<std::string, MaterialId> named;
    const std::optional<JsonNode> node = object.find("materials");
    if (node && !node->is(JsonValue::Kind::object)) {
        node->error(fmt::format("materials is an object {{\"name in the mesh\": material}} "
                                "(found {})",
                                kind_in_words(node->value())));
    } else if (node) {
        check_repeated_keys(*node);
        for (const JsonMember& member : node->value().members) {
            const JsonNode finish = node->member(member.key, member.value);
            named.emplace(member.key, materials.resolve(finish));
            if (std::find(slots.begin(), slots.end(), member.key) == slots.end())
                finish.notice(fmt::format("the mesh has no material \"{}\" (the entry is not "
                                          "used)",
                                          member.key),
                              did_you_mean(member.key, slots));
        }
    }
    std::vector<MaterialId> ids;
    for (const std::string& slot : slots) {
        const auto own = named.find(slot);
        const std::optional<MaterialId> known =
            own != named.end() ? own->second
                               : (slot.empty() ? std::nullopt : materials.find(slot));
        if (!known && !slot.empty())
            object.node().notice(
                fmt::format(
                    "the mesh's material \"{}\" is not known (\"material\", {}, applies)",
                    slot,
                    all ? "as given" : "0.5"),
                "Name it in \"materials\"?");
        ids.push_back(known.value_or(rest));
    }
    return ids;
}

void read_object(const JsonNode& node, std::size_t number, ProjectReader& reader) {
    const JsonObject object(node,
                            "an object",
                            {"name",
                             "box",
                             "cylinder",
                             "panel",
                             "mesh",
                             "position",
                             "rotation",
                             "scale",
                             "material",
                             "materials",
                             "array"});
    const std::optional<std::string> form =
        object.require_one_of({"box", "cylinder", "panel", "mesh"});
    const Frame frame = read_frame(object);
    const Vector3 scale = read_scale(object);
    const std::vector<Vector3> offsets = read_offsets(object);
    const std::optional<SurfaceMesh> shape =
        form ? read_shape(object, *form, reader) : std::nullopt;
    const std::vector<MaterialId> slots =
        read_slots(object, shape ? shape->slots() : std::vector<std::string>{""}, reader);
    const std::string name = object.text(
        "name", form ? fmt::format("{} {}", *form, number) : fmt::format("object {}", number));
    if (!shape)
        return;
    constexpr std::size_t most_triangles = 50'000'000;
    const std::size_t triangles = shape->triangles().size();
    if (triangles * offsets.size() > most_triangles) {
        node.error(fmt::format("{} copies of {} triangles are too many (at most {} triangles)",
                               offsets.size(),
                               triangles,
                               most_triangles));
        return;
    }
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        Frame copy = frame;
        copy.origin = frame.origin + offsets[i];
        reader.project.scene.objects.push_back(
            {offsets.size() == 1 ? name : fmt::format("{} {}", name, i + 1),
             shape->transformed(scale, copy),
             slots});
    }
}

} // namespace

void read_objects(const JsonNode& node, ProjectReader& reader) {
    std::size_t number = 0;
    for (const JsonNode& item : read_list(node))
        read_object(item, ++number, reader);
}

} // namespace isolux
