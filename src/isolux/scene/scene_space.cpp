#include "isolux/scene/scene_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace isolux {
namespace {

bool is_closed(const SurfaceMesh& mesh) {
    return std::ranges::none_of(mesh.inspect(), [](const MeshFinding& f) {
        return f.kind == MeshFinding::Kind::open_edge;
    });
}

bool lets_light_through(const Object& object, const std::vector<Material>& materials) {
    return std::ranges::any_of(object.material_of_slot, [&](MaterialId id) {
        return id.index() < materials.size()
               && std::holds_alternative<ClearPane>(materials[id.index()].scattering);
    });
}

constexpr double on_surface = 1e-6; ///< m

/// Whether the vertical through p meets the triangle. Two triangles with a common edge never
/// both claim a line through it, for each edge is judged the same way in both.
bool covers(const std::array<Point3, 3>& t, const Point3& p) noexcept {
    bool is_inside = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point3 *a = &t[i], *b = &t[(i + 1) % 3];
        if ((a->y > p.y) == (b->y > p.y))
            continue;
        if (b->y < a->y)
            std::swap(a, b);
        if (a->x + (p.y - a->y) / (b->y - a->y) * (b->x - a->x) > p.x)
            is_inside = !is_inside;
    }
    return is_inside;
}

/// Column of a coordinate in a grid.
std::size_t cell_of(double x, double lower, double upper, std::size_t columns) noexcept {
    const double place = (x - lower) / (upper - lower) * static_cast<double>(columns);
    return place > 0.0 ? std::min(columns - 1, static_cast<std::size_t>(place)) : 0;
}

void widen(Bounds& bounds, const Point3& p) {
    bounds.lower = {std::min(bounds.lower.x, p.x),
                    std::min(bounds.lower.y, p.y),
                    std::min(bounds.lower.z, p.z)};
    bounds.upper = {std::max(bounds.upper.x, p.x),
                    std::max(bounds.upper.y, p.y),
                    std::max(bounds.upper.z, p.z)};
}

bool is_within(const Bounds& b, const Point3& p) noexcept {
    return p.x > b.lower.x + on_surface && p.x < b.upper.x - on_surface
           && p.y > b.lower.y + on_surface && p.y < b.upper.y - on_surface
           && p.z > b.lower.z + on_surface && p.z < b.upper.z - on_surface;
}

} // namespace

SceneSpace::SceneSpace(const SceneDescription& description) : rooms_(description.rooms) {
    for (std::size_t i = 0; i < description.objects.size(); ++i) {
        const Object& object = description.objects[i];
        if (lets_light_through(object, description.materials) || !is_closed(object.mesh))
            continue;
        Solid solid;
        solid.object = i;
        for (const MeshTriangle& t : object.mesh.triangles())
            solid.triangles.push_back(t.corner);
        if (solid.triangles.empty())
            continue;
        solid.bounds = {solid.triangles[0][0], solid.triangles[0][0]};
        for (const auto& triangle : solid.triangles)
            for (const Point3& p : triangle)
                widen(solid.bounds, p);
        sort_into_cells(solid);
        const auto hangs_in = [&](const LuminairePlacement& l) {
            return is_inside(solid, l.world_from_luminaire.origin);
        };
        if (std::ranges::none_of(description.luminaires, hangs_in)) // else a room of its own
            solids_.push_back(std::move(solid));
    }
}

bool SceneSpace::is_outside(const Point3& p) const noexcept {
    return !rooms_.empty()
           && std::ranges::none_of(rooms_, [&](const Room& r) { return contains(r, p); });
}

void SceneSpace::sort_into_cells(Solid& solid) {
    struct Range {
        std::size_t x0, x1, y0, y1;
    };

    const Bounds& bounds = solid.bounds;
    const auto range_of = [&](const std::array<Point3, 3>& t) {
        const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
        const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
        const std::size_t n = solid.columns;
        return Range{cell_of(x0, bounds.lower.x, bounds.upper.x, n),
                     cell_of(x1, bounds.lower.x, bounds.upper.x, n),
                     cell_of(y0, bounds.lower.y, bounds.upper.y, n),
                     cell_of(y1, bounds.lower.y, bounds.upper.y, n)};
    };
    const double triangles = static_cast<double>(solid.triangles.size());
    const double most_entries = 1000.0 + 8.0 * triangles;
    for (solid.columns = 1 + static_cast<std::size_t>(std::sqrt(triangles));;
         solid.columns = (solid.columns + 1) / 2) {
        double entries = 0.0;
        for (const auto& t : solid.triangles) {
            const Range r = range_of(t);
            entries += static_cast<double>((r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1));
        }
        if (entries <= most_entries || solid.columns == 1)
            break;
    }
    solid.cells.resize(solid.columns * solid.columns);
    for (std::size_t i = 0; i < solid.triangles.size(); ++i) {
        const Range r = range_of(solid.triangles[i]);
        for (std::size_t y = r.y0; y <= r.y1; ++y)
            for (std::size_t x = r.x0; x <= r.x1; ++x)
                solid.cells[y * solid.columns + x].push_back(static_cast<std::uint32_t>(i));
    }
}

bool SceneSpace::is_inside(const Solid& solid, const Point3& p) noexcept {
    if (!is_within(solid.bounds, p))
        return false;
    // Up from p, how often does one leave the object more than one enters it? A point next to
    // an upright face is inside only if all places around it are.
    for (const double dx : {-on_surface, on_surface})
        for (const double dy : {-on_surface, on_surface}) {
            const Point3 q{p.x + dx, p.y + dy, p.z};
            const Bounds& b = solid.bounds;
            const std::size_t n = solid.columns;
            const std::size_t cell = cell_of(q.y, b.lower.y, b.upper.y, n) * n
                                     + cell_of(q.x, b.lower.x, b.upper.x, n);
            int leaves = 0;
            for (const std::uint32_t i : solid.cells[cell]) {
                const std::array<Point3, 3>& t = solid.triangles[i];
                const Vector3 normal = cross(t[1] - t[0], t[2] - t[0]);
                if (normal.z == 0.0 || !covers(t, q))
                    continue;
                const double z =
                    t[0].z - (normal.x * (q.x - t[0].x) + normal.y * (q.y - t[0].y)) / normal.z;
                if (std::abs(z - q.z) <= on_surface)
                    return false;
                if (z > q.z)
                    leaves += normal.z > 0.0 ? 1 : -1;
            }
            if (leaves == 0)
                return false;
        }
    return true;
}

std::optional<std::size_t> SceneSpace::object_around(const Point3& p) const noexcept {
    const auto around =
        std::ranges::find_if(solids_, [&](const Solid& s) { return is_inside(s, p); });
    return around == solids_.end() ? std::nullopt : std::optional(around->object);
}

bool SceneSpace::has_open_wall() const noexcept {
    return std::ranges::any_of(rooms_, [](const Room& room) {
        return std::ranges::any_of(room.openings, [](const WallOpening& o) {
            return o.state != OpeningState::closed;
        });
    });
}

bool SceneSpace::looks_through_opening(const Point3& from,
                                       const Vector3& along) const noexcept {
    for (const Room& room : rooms_)
        for (const WallOpening& o : room.openings) {
            const Point2 a = room.footprint[o.wall];
            const Point2 b = room.footprint[(o.wall + 1) % room.footprint.size()];
            const double wall = std::hypot(b.x - a.x, b.y - a.y);
            const Vector3 u{(b.x - a.x) / wall, (b.y - a.y) / wall, 0.0};
            const Vector3 n{-u.y, u.x, 0.0};
            const Point3 corner{a.x, a.y, room.floor_level + o.sill};
            const double t = dot(n, corner - from) / dot(n, along);
            if (o.state == OpeningState::closed || !(t > 0.0) || !std::isfinite(t))
                continue;
            const Vector3 p = from + t * along - corner;
            const double beside = dot(u, p) - o.offset;
            if (beside >= 0.0 && beside <= o.width && p.z >= 0.0 && p.z <= o.height)
                return true;
        }
    return false;
}

std::string extents_in_words(const std::vector<Room>& rooms) {
    constexpr std::size_t most_rooms = 3;
    std::string words;
    for (std::size_t i = 0; i < rooms.size() && i < most_rooms; ++i) {
        Point2 lower = rooms[i].footprint.front(), upper = lower;
        for (const Point2& p : rooms[i].footprint) {
            lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
            upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
        }
        words += fmt::format("{} \"{}\" reaches from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, "
                             "{:.6g}, {:.6g})",
                             i == 0 ? "Room" : ", room",
                             rooms[i].name,
                             lower.x,
                             lower.y,
                             rooms[i].floor_level,
                             upper.x,
                             upper.y,
                             rooms[i].floor_level + rooms[i].height);
    }
    return words;
}

} // namespace isolux
