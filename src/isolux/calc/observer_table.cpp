#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "isolux/calc/observers.h"
#include "isolux/photometry/ugr_table.h"

namespace isolux {

namespace {

/// Extent of a surface's triangles in plan, and the area-weighted reflectance of its material.
struct RoomFace {
    Point3 lower{1e300, 1e300, 1e300};
    Point3 upper{-1e300, -1e300, -1e300};
    double area = 0.0;
    double reflected = 0.0;
};

double reflectance_of(const Material& material) {
    const auto* opaque = std::get_if<Opaque>(&material.scattering);
    return opaque != nullptr ? luminance_sum(opaque->diffuse) + opaque->mirror : 0.0;
}

void add(const Scene& scene, const Surface& surface, RoomFace& face) {
    for (std::size_t t = 0; t < surface.triangles; ++t) {
        const SceneTriangle& triangle = scene.triangles[surface.first_triangle + t];
        face.area += triangle.area;
        face.reflected += triangle.area * reflectance_of(scene.material(triangle.material));
        for (const Point3& p : triangle.corner) {
            face.lower = {std::min(face.lower.x, p.x),
                          std::min(face.lower.y, p.y),
                          std::min(face.lower.z, p.z)};
            face.upper = {std::max(face.upper.x, p.x),
                          std::max(face.upper.y, p.y),
                          std::max(face.upper.z, p.z)};
        }
    }
}

RoomFace face_of(const Scene& scene, const std::string& prefix) {
    RoomFace face;
    for (const Surface& s : scene.surfaces)
        if (s.is_shell && s.name.starts_with(prefix))
            add(scene, s, face);
    return face;
}

double mean_reflectance(const RoomFace& face) {
    return face.area > 0.0 ? face.reflected / face.area : 0.0;
}

bool is_inside(const RoomFace& floor, const Point3& p, double ceiling) {
    return p.x >= floor.lower.x && p.x <= floor.upper.x && p.y >= floor.lower.y
           && p.y <= floor.upper.y && p.z >= floor.lower.z && p.z <= ceiling + 1e-6;
}

/// The type that lights the room alone, its height, scale and length axis.
struct Lighting {
    const LuminairePhotometry* photometry = nullptr;
    double z = 0.0;
    double scale = 1.0;
    Vector3 length;
    std::string problem;
};

Lighting lighting_of(const Scene& scene, const RoomFace& floor, double ceiling) {
    Lighting l;
    std::optional<std::size_t> type;
    for (const Luminaire& lum : scene.luminaires) {
        const Frame& f = lum.placement.world_from_luminaire;
        if (lum.placement.scale <= 0.0 || !is_inside(floor, f.origin, ceiling))
            continue;
        const double scale = lum.placement.scale * scene.type_of(lum).flux_scale;
        const bool is_first = !type;
        if (!is_first
            && (*type != lum.placement.type.index() || std::abs(l.z - f.origin.z) > 1e-3
                || std::abs(scale - l.scale) > 1e-9 * scale))
            l.problem = "luminaires of different types, heights or dimming";
        if (f.z.z() < 1.0 - 1e-6)
            l.problem = "tilted luminaires";
        type = lum.placement.type.index();
        l.z = f.origin.z;
        l.scale = scale;
        const LuminaireType& t = scene.type_of(lum);
        l.photometry = std::get_if<LuminairePhotometry>(&t.source);
        l.length = in_metre(t.opening.extent_x) > in_metre(t.opening.extent_y) ? f.x : f.y;
    }
    if (!type)
        l.problem = "no luminaire";
    else if (l.photometry == nullptr && l.problem.empty())
        l.problem = "luminaires without a photometric file";
    return l;
}

std::size_t nearest_room(double across, double along) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ugr_rooms.size(); ++i) {
        const double d = std::hypot(std::log(across / ugr_rooms[i].across),
                                    std::log(along / ugr_rooms[i].along));
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

std::size_t nearest_reflectances(double ceiling, double walls, double plane) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ugr_reflectances.size(); ++i) {
        const UgrReflectances& r = ugr_reflectances[i];
        const double d = std::hypot(ceiling - r.ceiling, walls - r.walls, plane - r.plane);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)); }

} // namespace

TableRating rate_by_table(const Scene& scene, const std::string& room, const SightLine& sight) {
    const RoomFace floor = face_of(scene, room + "/floor");
    const RoomFace ceiling = face_of(scene, room + "/ceiling");
    const RoomFace walls = face_of(scene, room + "/wall");
    if (room.empty() || floor.area <= 0.0)
        return {std::nullopt, "table method: no room"};
    const double x = floor.upper.x - floor.lower.x;
    const double y = floor.upper.y - floor.lower.y;
    if (std::abs(floor.area - x * y) > 0.05 * x * y)
        return {std::nullopt, "table method: the room is no rectangle"};
    const Lighting l = lighting_of(scene, floor, ceiling.upper.z);
    const double height = l.z - sight.eye.z;
    if (!l.problem.empty() || height <= 0.0)
        return {std::nullopt,
                "table method: "
                    + (l.problem.empty() ? "luminaires below the eye" : l.problem)};
    const std::optional<UgrTable> table = make_ugr_table(*l.photometry);
    if (!table)
        return {std::nullopt, "table method: the luminaire has no luminous area"};
    const bool looks_along_x = std::abs(sight.direction.x()) > std::abs(sight.direction.y());
    const std::size_t r =
        nearest_room((looks_along_x ? y : x) / height, (looks_along_x ? x : y) / height);
    const std::size_t c = nearest_reflectances(
        mean_reflectance(ceiling), mean_reflectance(walls), mean_reflectance(floor));
    const bool is_endwise = std::abs(dot(l.length, sight.direction)) > std::sqrt(0.5);
    const UgrReflectances& rho = ugr_reflectances[c];
    return {(is_endwise ? table->endwise : table->crosswise)[r][c] + 8.0 * std::log10(l.scale),
            "table method: room " + std::to_string(ugr_rooms[r].across) + "H x "
                + std::to_string(ugr_rooms[r].along) + "H, reflectances " + percent(rho.ceiling)
                + "/" + percent(rho.walls) + "/" + percent(rho.plane) + ", seen "
                + (is_endwise ? "endwise" : "crosswise")};
}

} // namespace isolux
