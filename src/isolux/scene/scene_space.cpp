#include "isolux/scene/scene_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "isolux/scene/triangulate.h"

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

/// Solid angle of a triangle seen from p, signed by the side of p (van Oosterom and Strackee
/// 1983, doi:10.1109/TBME.1983.325207); 0 in its plane.
double signed_solid_angle(const std::array<Point3, 3>& t, const Point3& p) noexcept {
    constexpr double in_plane = 1e-6; // m
    const Vector3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double volume = dot(a, cross(b, c));
    if (std::abs(volume) <= in_plane * length(cross(b - a, c - a)))
        return 0.0;
    const double la = length(a), lb = length(b), lc = length(c);
    return 2.0
           * std::atan2(volume,
                        la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
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
    return p.x > b.lower.x && p.x < b.upper.x && p.y > b.lower.y && p.y < b.upper.y
           && p.z > b.lower.z && p.z < b.upper.z;
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

bool SceneSpace::is_inside(const Solid& solid, const Point3& p) noexcept {
    if (!is_within(solid.bounds, p))
        return false;
    double sum = 0.0; // 4 pi times how often the surface winds around p
    for (const auto& triangle : solid.triangles)
        sum += signed_solid_angle(triangle, p);
    // 1/2 on a face, less on an edge; inside 1 but for rounding.
    constexpr double enough = 0.75;
    return std::abs(sum) > enough * 4.0 * std::numbers::pi;
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
