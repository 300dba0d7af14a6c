#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "isolux/io/outline.h"
#include "isolux/io/project_reader.h"

namespace isolux {

namespace {

/// The focal lengths photographers speak of belong to a picture so wide.
constexpr double full_frame_mm = 36.0;
constexpr std::size_t usual_long_side = 640;
constexpr double plan_margin = 1.05;            ///< picture over room
constexpr double usual_plan_height = 2.0 / 3.0; ///< of the room's

bool is_fisheye(Projection p) noexcept {
    return p != Projection::perspective && p != Projection::orthographic;
}

Projection read_projection(const JsonObject& object) {
    constexpr std::array<std::string_view, 5> words{"perspective",
                                                    "orthographic",
                                                    "fisheye",
                                                    "equal-area fisheye",
                                                    "stereographic fisheye"};
    if (const std::optional<JsonNode> node = object.find("projection"))
        return static_cast<Projection>(read_choice(*node, words).value_or(0));
    return Projection::perspective;
}

/// A key that this projection has no use for.
void refuse(const JsonObject& object, const char* key, const char* why) {
    if (const std::optional<JsonNode> node = object.find(key))
        node->error(fmt::format("\"{}\" has no meaning here ({})", key, why));
}

void read_field_of_view(const JsonObject& object, Camera& camera) {
    if (camera.projection == Projection::orthographic) {
        refuse(object, "field_of_view", "parallel rays span no angle: give \"width\"");
        refuse(object, "focal_length", "parallel rays span no angle: give \"width\"");
        camera.width = object.require("width", read_length).value_or(1.0);
        return;
    }
    refuse(object, "width", "only an orthographic view is so many metres wide");
    if (is_fisheye(camera.projection)) {
        refuse(object, "focal_length", "a fisheye is described by its field of view");
        camera.field_of_view =
            degrees(object.number("field_of_view", {0.0, 360.0, true, " degrees"}, 180.0));
        const bool is_whole = camera.field_of_view.in_degrees() >= 360.0;
        if (is_whole && camera.projection == Projection::stereographic)
            object.find("field_of_view")
                ->error("a stereographic view of 360 degrees is endless (it must be below)",
                        "Use an equal-area fisheye?");
        return;
    }
    object.exclude("focal_length", {"field_of_view"});
    if (const std::optional<JsonNode> node = object.find("focal_length")) {
        const double f = read_number(*node, {1.0, 1e4, false, " mm"}).value_or(31.0);
        camera.field_of_view = radians(2.0 * std::atan(0.5 * full_frame_mm / f));
    } else {
        camera.field_of_view =
            degrees(object.number("field_of_view", {0.0, 175.0, true, " degrees"}, 60.0));
    }
}

void read_lens(const JsonObject& object, Camera& camera) {
    if (camera.projection != Projection::perspective) {
        for (const char* key : {"aperture", "f_number", "focus_distance"})
            refuse(object, key, "only a perspective view has a lens");
        return;
    }
    object.exclude("f_number", {"aperture"});
    if (const std::optional<JsonNode> node = object.find("aperture")) {
        camera.lens_radius =
            0.5e-3 * read_number(*node, {0.0, 1000.0, true, " mm"}).value_or(0.0);
    } else if (const std::optional<JsonNode> f = object.find("f_number")) {
        const double number = read_number(*f, {0.1, 1000.0}).value_or(1.0);
        const double focal_mm =
            0.5 * full_frame_mm / std::tan(0.5 * camera.field_of_view.in_radians());
        camera.lens_radius = 0.5e-3 * focal_mm / number;
    }
    if (const std::optional<JsonNode> node = object.find("focus_distance")) {
        camera.focus_distance = read_length(*node).value_or(0.0);
        if (camera.lens_radius <= 0.0)
            node->notice("a pinhole shows everything sharp (the focus distance does nothing)",
                         "Give \"aperture\" or \"f_number\" too?");
    }
}

/// @param aspect  width over height that suits what is seen; 0 for the usual
void read_resolution(const JsonObject& object, double aspect, Camera& camera) {
    camera.columns = usual_long_side;
    camera.rows = 400;
    if (is_fisheye(camera.projection))
        camera.columns = camera.rows = 512;
    else if (aspect > 0.0) {
        const auto pixels = [](double share) {
            return std::max<std::size_t>(
                1, static_cast<std::size_t>(std::lround(share * usual_long_side)));
        };
        camera.columns = pixels(std::min(1.0, aspect));
        camera.rows = pixels(std::min(1.0, 1.0 / aspect));
    }
    const std::optional<JsonNode> node = object.find("resolution");
    if (!node)
        return;
    const std::vector<JsonNode> sides = read_list(*node, 2);
    if (sides.size() > 2)
        node->error(fmt::format("the list has {} elements ([columns, rows] is expected)",
                                sides.size()));
    if (sides.size() != 2)
        return;
    const auto columns = read_integer(sides[0], 1, most_pixels_a_side);
    const auto rows = read_integer(sides[1], 1, most_pixels_a_side);
    if (columns && rows) {
        camera.columns = static_cast<std::size_t>(*columns);
        camera.rows = static_cast<std::size_t>(*rows);
    }
}

/// A room from above: places the eye. @return what the picture shows; nothing: the error has
/// been reported
std::optional<Rectangle2>
read_plan(const JsonNode& node, const ProjectReader& reader, Camera& camera) {
    const JsonObject plan(node, "a plan", {"room", "height"});
    const Room* room = plan.is_object() ? reader.find_room(plan) : nullptr;
    if (room == nullptr)
        return std::nullopt;
    const double height = plan.number("height", any_length, usual_plan_height * room->height);
    if (height >= room->height) {
        plan.find("height")->error(
            fmt::format("{} m is not below the ceiling (room \"{}\" is {} m high)",
                        height,
                        room->name,
                        room->height));
        return std::nullopt;
    }
    const Rectangle2 area = bounding_rectangle(room->footprint);
    camera.projection = Projection::orthographic;
    camera.position = {0.5 * (area.lower.x + area.upper.x),
                       0.5 * (area.lower.y + area.upper.y),
                       room->floor_level + height};
    camera.target = camera.position - Vector3{0, 0, height};
    camera.up = {0, 1, 0};
    return area;
}

bool read_placement(const JsonObject& object, Camera& camera) {
    const std::optional<Point3> position = object.require("position", read_point);
    const std::optional<Point3> target = object.require("target", read_point);
    if (!position || !target)
        return false;
    if (*position == *target) {
        object.find("target")->error(
            "the target equals the position (no direction follows from it)");
        return false;
    }
    camera.position = *position;
    camera.target = *target;
    if (const std::optional<JsonNode> node = object.find("up"))
        if (const std::optional<Vector3> up = read_vector(*node)) {
            camera.up = *up;
            if (length(*up) == 0.0)
                node->error("the vector is zero (it has no direction)");
        }
    return true;
}

void read_view(const JsonNode& node, ProjectReader& reader) {
    const JsonObject object(node,
                            "a view",
                            {"name",
                             "position",
                             "target",
                             "up",
                             "plan",
                             "projection",
                             "field_of_view",
                             "focal_length",
                             "width",
                             "aperture",
                             "f_number",
                             "focus_distance",
                             "resolution"});
    if (!object.is_object())
        return;
    View view;
    if (const std::optional<JsonNode> name = object.require("name")) {
        view.name = read_text(*name).value_or("");
        const auto& views = reader.project.views;
        if (std::any_of(
                views.begin(), views.end(), [&](const View& v) { return v.name == view.name; }))
            name->error(
                fmt::format("another view is named \"{}\" (names must be unique)", view.name));
    }
    Camera& camera = view.camera;
    if (const std::optional<JsonNode> plan = object.find("plan")) {
        object.exclude("plan",
                       {"position",
                        "target",
                        "up",
                        "projection",
                        "field_of_view",
                        "focal_length",
                        "width"});
        const std::optional<Rectangle2> area = read_plan(*plan, reader, camera);
        if (!area)
            return;
        read_resolution(object, area->width() / area->depth(), camera);
        const double aspect =
            static_cast<double>(camera.columns) / static_cast<double>(camera.rows);
        camera.width = plan_margin * std::max(area->width(), area->depth() * aspect);
    } else {
        camera.projection = read_projection(object);
        if (!read_placement(object, camera))
            return;
        read_field_of_view(object, camera);
        read_resolution(object, 0.0, camera);
    }
    read_lens(object, camera);
    reader.project.views.push_back(std::move(view));
}

} // namespace

void read_views(const JsonNode& node, ProjectReader& reader) {
    for (const JsonNode& item : read_list(node))
        read_view(item, reader);
}

} // namespace isolux
