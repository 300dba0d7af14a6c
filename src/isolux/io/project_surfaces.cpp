#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "isolux/io/points_file.h"
#include "isolux/io/project_areas.h"
#include "isolux/io/project_grid.h"
#include "isolux/io/project_reader.h"
#include "isolux/io/text_file.h"

namespace isolux {

namespace {

struct Quantity {
    IlluminanceKind kind = IlluminanceKind::planar;
    UnitVector3 reference = UnitVector3::from_unit({1, 0, 0});
};

std::optional<UnitVector3> read_facing(const JsonNode& node) {
    if (!node.is(JsonValue::Kind::array)) {
        const std::optional<double> angle = read_number(node, any_angle);
        if (!angle)
            return std::nullopt;
        const double a = degrees(*angle).in_radians();
        return UnitVector3::from_unit({std::cos(a), std::sin(a), 0.0});
    }
    const auto v = read_numbers(node, 2, 2, "[x, y]", any_coordinate);
    if (v && (*v)[0] == 0.0 && (*v)[1] == 0.0)
        node.error("the vector has no length (no direction follows from it)");
    else if (v)
        return UnitVector3(Vector3{(*v)[0], (*v)[1], 0.0});
    return std::nullopt;
}

Quantity read_quantity(const JsonObject& object) {
    constexpr std::array<std::string_view, 5> words{
        "illuminance", "cylindrical", "semi-cylindrical", "hemispherical", "mean-spherical"};
    Quantity quantity;
    if (const std::optional<JsonNode> node = object.find("quantity"))
        quantity.kind = static_cast<IlluminanceKind>(read_choice(*node, words).value_or(0));
    const std::optional<JsonNode> direction = object.find("direction");
    if (quantity.kind == IlluminanceKind::semi_cylindrical) {
        if (direction)
            quantity.reference = read_facing(*direction).value_or(quantity.reference);
        else
            object.node().error("the key \"direction\" is missing (which way does the "
                                "semi-cylinder face?)");
    } else if (direction) {
        direction->error(
            "only \"quantity\": \"semi-cylindrical\" has a direction (this surface "
            "has another quantity)");
    }
    return quantity;
}

Receiver make_receiver(const DirectedPoint& p, const Quantity& quantity) {
    const bool is_upright = quantity.kind == IlluminanceKind::cylindrical
                            || quantity.kind == IlluminanceKind::semi_cylindrical;
    return {p.point,
            is_upright ? UnitVector3::from_unit({0, 0, 1}) : p.normal,
            quantity.kind,
            quantity.reference};
}

std::vector<DirectedPoint> read_points(const JsonNode& node) {
    std::vector<DirectedPoint> points;
    for (const JsonNode& item : read_list(node, 1)) {
        const auto v =
            read_numbers(item, 3, 6, "[x, y, z] or [x, y, z, nx, ny, nz]", any_coordinate);
        if (!v)
            continue;
        if (v->size() == 4 || v->size() == 5) {
            item.error(fmt::format(
                "{} numbers ([x, y, z] or [x, y, z, nx, ny, nz] is expected)", v->size()));
            continue;
        }
        const Vector3 normal =
            v->size() == 6 ? Vector3{(*v)[3], (*v)[4], (*v)[5]} : Vector3{0.0, 0.0, 1.0};
        if (length(normal) == 0.0)
            item.error("the normal has no length (which way does the point face?)");
        else
            points.push_back({{(*v)[0], (*v)[1], (*v)[2]}, UnitVector3(normal)});
    }
    return points;
}

std::vector<DirectedPoint> read_points_file(const JsonNode& node, ProjectReader& reader) {
    if (!read_text(node, 4096))
        return {};
    const std::optional<std::string> text = reader.read_file(node, FileLimits::points);
    if (!text)
        return {};
    try {
        std::vector<DirectedPoint> points =
            parse_points(*text, reader.path_of(node).generic_string());
        if (static_cast<double>(points.size()) <= most_grid_points)
            return points;
        node.error(fmt::format(
            "{} points are too many (at most {} a surface)", points.size(), most_grid_points));
    } catch (const InputError& error) {
        reader.problems.add_errors(error.messages());
    }
    return {};
}

/// Drops the points that are not measured.
void leave_out(CalculationSurface& surface, const SurfaceArea& area) {
    std::vector<Receiver> receivers;
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < surface.receivers.size(); ++i)
        if (is_measured(area, surface.receivers[i].point)) {
            receivers.push_back(surface.receivers[i]);
            cells.push_back(surface.grid->cell_of_point[i]);
        }
    surface.receivers = std::move(receivers);
    surface.grid->cell_of_point = std::move(cells);
}

std::optional<CalculationSurface> make_area_surface(const JsonNode& node,
                                                    const SurfaceArea& area,
                                                    const GridWish& wish,
                                                    const Quantity& quantity) {
    const std::optional<GridCounts> counts = choose_counts(wish, area.width, area.height);
    if (!counts) {
        const bool is_automatic = !wish.spacing && !wish.counts;
        node.error(fmt::format("the grid has too many points (at most {} a surface)",
                               most_grid_points),
                   is_automatic ? fmt::format(
                       "Is the size of {:.6g} m x {:.6g} m in metres?", area.width, area.height)
                                : "Is the spacing in metres?");
        return std::nullopt;
    }
    CalculationSurface surface =
        make_grid_surface(area.name,
                          area.frame,
                          Metre(area.width),
                          Metre(area.height),
                          *counts,
                          area.clips ? area.outline : std::vector<Point3>{},
                          quantity.kind,
                          quantity.reference);
    surface.outline = area.outline;
    leave_out(surface, area);
    if (!surface.receivers.empty())
        return surface;
    node.error("no point of the grid lies on the surface (nothing would be measured)",
               "Choose a finer grid?");
    return std::nullopt;
}

std::optional<CalculationSurface>
read_surface(const JsonObject& object, std::size_t number, ProjectReader& reader) {
    const Quantity quantity = read_quantity(object);
    const std::optional<JsonNode> grid = object.find("grid");
    const GridWish wish = grid ? read_grid(*grid) : GridWish{};
    const std::optional<std::string> form = object.require_one_of({"work_plane",
                                                                   "floor",
                                                                   "ceiling",
                                                                   "wall",
                                                                   "rectangle",
                                                                   "polygon",
                                                                   "points",
                                                                   "points_file"});
    if (!form)
        return std::nullopt;
    const JsonNode node = *object.find(*form);
    if (*form != "points" && *form != "points_file") {
        std::optional<SurfaceArea> area = read_area(node, *form, reader);
        if (area && area->name.empty())
            area->name = fmt::format("surface {}", number);
        return area ? make_area_surface(object.node(), *area, wish, quantity) : std::nullopt;
    }
    object.exclude(*form, {"grid"});
    CalculationSurface surface;
    surface.name = fmt::format("points {}", number);
    surface.kind = quantity.kind;
    const std::vector<DirectedPoint> points =
        *form == "points" ? read_points(node) : read_points_file(node, reader);
    for (const DirectedPoint& p : points)
        surface.receivers.push_back(make_receiver(p, quantity));
    return surface.receivers.empty() ? std::nullopt : std::optional(std::move(surface));
}

/// Names that the user gave must differ; made-up names get a number until they do.
class SurfaceNames {
public:
    /// @param entry  which entry of "surfaces" it is, from 1
    void claim(const JsonNode& node, const std::string& name, std::size_t entry) {
        const auto [taken, is_new] = names_.emplace(lower(name), entry);
        if (!is_new)
            node.error(fmt::format("the surface name \"{}\" is taken by entry {} of "
                                   "\"surfaces\" (it names the result files)",
                                   name,
                                   taken->second));
    }

    [[nodiscard]] std::string make(const std::string& wish) {
        std::string name = wish;
        for (int n = 2; !names_.emplace(lower(name), 0).second; ++n)
            name = fmt::format("{} {}", wish, n);
        return name;
    }

private:
    /// Result files may lie on disks that do not tell upper from lower case.
    static std::string lower(std::string text) {
        for (char& c : text)
            c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        return text;
    }

    std::map<std::string, std::size_t> names_;
};

JsonObject surface_object(const JsonNode& node) {
    return JsonObject(node,
                      "a surface",
                      {"name",
                       "work_plane",
                       "floor",
                       "ceiling",
                       "wall",
                       "rectangle",
                       "polygon",
                       "points",
                       "points_file",
                       "grid",
                       "quantity",
                       "direction"});
}

} // namespace

std::optional<CalculationSurface> read_one_surface(const JsonNode& node,
                                                   ProjectReader& reader) {
    return read_surface(surface_object(node), reader.project.surfaces.size() + 1, reader);
}

void read_surfaces(const JsonNode& node, ProjectReader& reader) {
    std::vector<JsonObject> objects;
    SurfaceNames names;
    for (const JsonNode& item : read_list(node)) {
        objects.push_back(surface_object(item));
        if (const std::optional<JsonNode> name = objects.back().find("name"))
            if (const std::optional<std::string> given = read_text(*name))
                names.claim(*name, *given, objects.size());
    }
    for (std::size_t i = 0; i < objects.size(); ++i) {
        std::optional<CalculationSurface> surface = read_surface(objects[i], i + 1, reader);
        const JsonValue* name = objects[i].node().value().find("name");
        if (!surface) {
            if (name != nullptr)
                reader.lost_names.insert(name->text);
            continue;
        }
        surface->name = name != nullptr ? name->text : names.make(surface->name);
        reader.project.surfaces.push_back(std::move(*surface));
    }
}

void add_default_surfaces(ProjectReader& reader) {
    SurfaceNames names;
    for (const Room& room : reader.project.scene.rooms) {
        const double height = std::min(standard_work_plane_height, room.height);
        std::optional<SurfaceArea> area = make_plan_area(room, height, standard_edge(room));
        if (!area)
            continue;
        area->name = names.make(room.name + " work plane");
        const JsonValue nothing;
        const JsonNode node(nothing, "/rooms", reader.problems);
        if (std::optional<CalculationSurface> surface = make_area_surface(node, *area, {}, {}))
            reader.project.surfaces.push_back(std::move(*surface));
    }
}

} // namespace isolux
