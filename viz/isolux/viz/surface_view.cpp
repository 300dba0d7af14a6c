#include "isolux/viz/surface_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "isolux/viz/label_layout.h"

namespace isolux {

namespace {

/// Normals within 18 degrees of the vertical count as horizontal surfaces.
constexpr double plan_normal_z = 0.95;

/// Floats and project files agree to this, m.
constexpr double slack = 0.01;

/// The common normal of surfaces that are not seen from above.
std::optional<UnitVector3> front_normal(const CalculationSurface& surface) {
    if (surface.grid) {
        if (std::abs(surface.grid->frame.z.z()) > plan_normal_z)
            return std::nullopt;
        return surface.grid->frame.z;
    }
    if (surface.receivers.size() < 2 || surface.kind != IlluminanceKind::planar)
        return std::nullopt;
    const Receiver& first = surface.receivers.front();
    if (std::abs(first.axis.z()) > plan_normal_z)
        return std::nullopt;
    for (const Receiver& r : surface.receivers)
        if (std::abs(dot(first.axis, r.point - first.point)) > slack
            || dot(first.axis, r.axis) < 1.0 - 1e-6)
            return std::nullopt;
    return first.axis;
}

std::vector<Point3> characteristic_points(const CalculationSurface& surface) {
    std::vector<Point3> points = surface.outline;
    if (surface.grid && points.empty()) {
        const GridLayout& g = *surface.grid;
        for (const double u : {0.0, g.width})
            for (const double v : {0.0, g.height})
                points.push_back(g.frame.point_from_local({u, v, 0.0}));
    } else if (!surface.grid) {
        for (const Receiver& r : surface.receivers)
            points.push_back(r.point);
    }
    return points;
}

Extent extent_of(const PlanOutline& outline) {
    Extent e;
    for (const Polyline& l : outline.lines)
        for (const Point2& p : l)
            e.include(p);
    return e;
}

bool touches(const Extent& a, const Extent& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y
           && b.low.y <= a.high.y;
}

/// The room around a point: of several storeys the highest floor below it.
const PlanOutline* find_room(const Plan& plan, const Point3& p) {
    const PlanOutline* best = nullptr;
    for (const PlanOutline& room : plan.rooms) {
        if (p.z < room.lower - slack || p.z > room.upper + slack)
            continue;
        const bool is_around =
            std::any_of(room.faces.begin(), room.faces.end(), [&](const Polyline& face) {
                return is_inside(std::span(&face, 1), {p.x, p.y});
            });
        if (is_around && (best == nullptr || room.lower > best->lower))
            best = &room;
    }
    return best;
}

} // namespace

Point2 SurfaceView::project(const Point3& p) const noexcept {
    return {dot(right, p - origin), dot(up, p - origin)};
}

std::vector<Polyline> SurfaceView::project(const std::vector<Polyline>& grid_lines,
                                           const GridLayout& grid) const {
    std::vector<Polyline> result;
    for (const Polyline& line : grid_lines) {
        result.emplace_back();
        for (const Point2& p : line)
            result.back().push_back(project(grid.frame.point_from_local({p.x, p.y, 0.0})));
    }
    return result;
}

SurfaceView make_surface_view(const CalculationSurface& surface) {
    SurfaceView view;
    const std::optional<UnitVector3> normal = front_normal(surface);
    if (!normal)
        return view;
    view.is_plan = false;
    const Vector3 z{0.0, 0.0, 1.0};
    view.up = UnitVector3(z - dot(z, *normal) * Vector3(*normal));
    view.right = UnitVector3(cross(view.up, *normal));
    const std::vector<Point3> points = characteristic_points(surface);
    view.origin = points.front();
    const Extent e = surface_extent(surface, view);
    view.origin = view.origin + e.low.x * Vector3(view.right) + e.low.y * Vector3(view.up);
    return view;
}

Extent surface_extent(const CalculationSurface& surface, const SurfaceView& view) {
    Extent e;
    for (const Point3& p : characteristic_points(surface))
        e.include(view.project(p));
    if (e.is_empty())
        e = {{0.0, 0.0}, {0.0, 0.0}};
    return e;
}

Plan select_visible(const Plan& plan,
                    const CalculationSurface& surface,
                    const SurfaceView& view) {
    if (!view.is_plan)
        return {};
    Vector3 sum;
    double count = 0.0;
    for (const Receiver& r : surface.receivers) {
        sum = sum + (r.point - Point3{});
        count += 1.0;
    }
    const PlanOutline* room =
        count > 0.0 ? find_room(plan, Point3{} + (1.0 / count) * sum) : nullptr;
    // The middle of an L lies outside: any point that is in a room will do.
    for (std::size_t p = 0; room == nullptr && p < surface.receivers.size(); ++p)
        room = find_room(plan, surface.receivers[p].point);
    if (room == nullptr)
        return plan;
    Plan visible;
    visible.types = plan.types;
    visible.rooms = {*room};
    const Extent extent = extent_of(*room).grown(slack, 0.0);
    for (const PlanOutline& object : plan.objects)
        if (object.upper >= room->lower - slack && object.lower <= room->upper + slack
            && touches(extent_of(object), extent))
            visible.objects.push_back(object);
    for (const PlanLuminaire& l : plan.luminaires) {
        const Extent at{{l.position.x, l.position.y}, {l.position.x, l.position.y}};
        if (l.position.z >= room->lower - slack && l.position.z <= room->upper + slack
            && touches(at, extent))
            visible.luminaires.push_back(l);
    }
    return visible;
}

Extent
map_extent(const CalculationSurface& surface, const SurfaceView& view, const Plan& visible) {
    constexpr double whole_room_share = 0.4; // of the room's width or height
    Extent e = surface_extent(surface, view);
    if (visible.rooms.size() == 1) {
        const Extent room = extent_of(visible.rooms.front());
        if (!surface.grid || e.width() > whole_room_share * room.width()
            || e.height() > whole_room_share * room.height()) {
            e.include(room.low);
            e.include(room.high);
        }
    }
    return with_margin(e);
}

Extent with_margin(const Extent& e) {
    const double larger = std::max(e.width(), e.height());
    const double smaller = std::min(e.width(), e.height());
    return e.grown(std::clamp(0.2 * smaller, 0.01 * larger, 0.03 * larger),
                   std::max(0.05 * larger, 1.0));
}

} // namespace isolux
