#include "isolux/io/project_bands.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "isolux/io/outline.h"
#include "isolux/io/project_areas.h"

namespace isolux {

namespace {

/// Points of a band lie no farther apart, m: two rows across half a metre.
constexpr double widest_spacing = 0.25;

/// In plan, counter-clockwise or not. Empty for what is no level grid.
std::vector<Point2> outline_of(const CalculationSurface& s) {
    std::vector<Point2> plan;
    if (!is_level_grid(s))
        return plan;
    if (!s.outline.empty()) {
        for (const Point3& p : s.outline)
            plan.push_back({p.x, p.y});
        return plan;
    }
    const GridLayout& g = *s.grid;
    for (const auto& [u, v] :
         {std::pair{0.0, 0.0}, {g.width, 0.0}, {g.width, g.height}, {0.0, g.height}}) {
        const Point3 p = g.frame.point_from_local({u, v, 0.0});
        plan.push_back({p.x, p.y});
    }
    return plan;
}

double distance_to(const Point2& p, const std::vector<Point2>& outline) {
    return is_inside(p, outline) ? 0.0 : distance_to_border(p, outline);
}

/// Whether a point is in the room, off its columns and its edge zone.
bool is_in_reach(const Room* room, const Point3& p) {
    if (room == nullptr)
        return true;
    SurfaceArea area;
    area.room = room;
    area.edge = standard_edge(*room);
    return is_measured(area, p);
}

std::optional<CalculationSurface> make_band(const CalculationSurface& task,
                                            const Room* room,
                                            double inner,
                                            double outer,
                                            double finest) {
    const std::vector<Point2> outline = outline_of(task);
    if (outline.empty())
        return std::nullopt;
    Rectangle2 box = bounding_rectangle(outline);
    box.lower = {box.lower.x - outer, box.lower.y - outer};
    box.upper = {box.upper.x + outer, box.upper.y + outer};
    if (room != nullptr) {
        const Rectangle2 walls = bounding_rectangle(room->footprint);
        box.lower = {std::max(box.lower.x, walls.lower.x),
                     std::max(box.lower.y, walls.lower.y)};
        box.upper = {std::min(box.upper.x, walls.upper.x),
                     std::min(box.upper.y, walls.upper.y)};
    }
    if (box.width() <= 0.0 || box.depth() <= 0.0)
        return std::nullopt;
    const double p =
        std::min(finest, in_metre(standard_spacing(Metre(box.width()), Metre(box.depth()))));
    const auto count = [p](double side) {
        return static_cast<std::size_t>(std::max(1.0, std::ceil(side / p - 1e-9)));
    };
    const double z = task.receivers.front().point.z;
    CalculationSurface all = make_grid_surface("",
                                               Frame{{box.lower.x, box.lower.y, z}},
                                               Metre(box.width()),
                                               Metre(box.depth()),
                                               {count(box.width()), count(box.depth())},
                                               {},
                                               IlluminanceKind::planar,
                                               {});
    CalculationSurface band = all;
    band.receivers.clear();
    band.grid->cell_of_point.clear();
    for (std::size_t i = 0; i < all.receivers.size(); ++i) {
        const Point3& at = all.receivers[i].point;
        const double d = distance_to({at.x, at.y}, outline);
        if (d <= inner || d > outer || !is_in_reach(room, at))
            continue;
        band.receivers.push_back(all.receivers[i]);
        band.grid->cell_of_point.push_back(all.grid->cell_of_point[i]);
    }
    return band.receivers.empty() ? std::nullopt : std::optional(std::move(band));
}

/// Half the extents of a luminaire in plan about its axis, m; a point has none.
bool covers(const LuminaireType& type, const LuminairePlacement& l, const Point3& p) {
    constexpr double on_ceiling = 0.15; // m below it
    const Vector3 local = l.world_from_luminaire.point_to_local(p);
    if (std::abs(p.z - l.world_from_luminaire.origin.z) > on_ceiling)
        return false;
    return std::abs(local.x) <= 0.5 * in_metre(type.opening.extent_x)
           && std::abs(local.y) <= 0.5 * in_metre(type.opening.extent_y);
}

} // namespace

bool is_level_grid(const CalculationSurface& surface) {
    constexpr double level = 1.0 - 1e-9;
    return surface.grid && surface.grid->frame.z.z() >= level;
}

std::optional<CalculationSurface> make_surrounding(const CalculationSurface& task,
                                                   const Room* room) {
    return make_band(task, room, 0.0, surrounding_width, widest_spacing);
}

std::optional<CalculationSurface> make_background(const CalculationSurface& task,
                                                  const Room* room) {
    return make_band(task,
                     room,
                     surrounding_width,
                     surrounding_width + background_width,
                     4.0 * widest_spacing);
}

void leave_out_luminaires(CalculationSurface& ceiling, const SceneDescription& scene) {
    std::vector<Receiver> receivers;
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; i < ceiling.receivers.size(); ++i) {
        const Point3& p = ceiling.receivers[i].point;
        if (std::ranges::any_of(scene.luminaires, [&](const LuminairePlacement& l) {
                return covers(scene.luminaire_types[l.type.index()], l, p);
            }))
            continue;
        receivers.push_back(ceiling.receivers[i]);
        cells.push_back(ceiling.grid->cell_of_point[i]);
    }
    ceiling.receivers = std::move(receivers);
    ceiling.grid->cell_of_point = std::move(cells);
}

} // namespace isolux
