#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "isolux/scene/scene.h"
#include "isolux/scene/triangulate.h"

namespace isolux {
namespace {

constexpr int most_findings = 5; ///< of one kind for one object; the rest is counted

std::string words(const Point3& p) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x, p.y, p.z);
}

std::string place_of(const Object& object) { return fmt::format("object '{}'", object.name); }

std::string place_of(const LuminairePlacement& l) {
    return fmt::format("luminaire '{}'", l.name);
}

bool is_in_a_room(const std::vector<Room>& rooms, const Point3& p) {
    return std::ranges::any_of(rooms, [&](const Room& room) { return contains(room, p); });
}

// Objects.

/// A sheet in one plane: its border is open on purpose.
bool is_flat(std::span<const MeshTriangle> triangles) {
    if (triangles.empty())
        return true;
    const Point3& origin = triangles[0].corner[0];
    const UnitVector3 normal(twice_vector_area(triangles[0].corner));
    return std::ranges::all_of(triangles, [&](const MeshTriangle& t) {
        return std::ranges::all_of(t.corner, [&](const Point3& p) {
            return std::abs(dot(normal, p - origin)) <= 1e-6 + 1e-9 * distance(p, origin);
        });
    });
}

std::string hint_for(MeshFinding::Kind kind) {
    switch (kind) {
    case MeshFinding::Kind::open_edge:
        return "Close the mesh, unless it is meant to be a sheet?";
    case MeshFinding::Kind::inside_out:
        return "Turn its faces round, if one of its materials has only a front?";
    default:
        return "Clean the mesh in the program that made it?";
    }
}

void inspect_mesh(const Object& object, std::vector<Message>& messages) {
    const bool flat = is_flat(object.mesh.triangles());
    std::map<MeshFinding::Kind, int> count;
    for (const MeshFinding& f : object.mesh.inspect()) {
        if (flat && f.kind == MeshFinding::Kind::open_edge)
            continue;
        if (++count[f.kind] <= most_findings)
            messages.push_back({place_of(object),
                                fmt::format("{}, at {}", f.text, words(f.place)),
                                hint_for(f.kind)});
    }
    for (const auto& [kind, n] : count)
        if (n > most_findings)
            messages.push_back({place_of(object),
                                fmt::format("{} more of the last kind", n - most_findings),
                                ""});
}

void inspect_position(const Object& object,
                      const std::vector<Room>& rooms,
                      std::vector<Message>& messages) {
    const auto triangles = object.mesh.triangles();
    const bool inside = std::ranges::any_of(triangles, [&](const MeshTriangle& t) {
        return std::ranges::any_of(t.corner,
                                   [&](const Point3& p) { return is_in_a_room(rooms, p); });
    });
    if (!inside && !triangles.empty())
        messages.push_back({place_of(object),
                            fmt::format("lies outside every room, around {} (no light of a "
                                        "room reaches it)",
                                        words(triangles[0].corner[0])),
                            "Is its position in metres and in the building's coordinates?"});
}

// Luminaires.

using Corners = std::array<Point3, 3>;

struct NamedTriangle {
    Corners corner;
    const std::string* surface;
};

struct Box {
    Point3 lower;
    Point3 upper;

    explicit Box(std::span<const Point3> points) : lower(points[0]), upper(points[0]) {
        for (const Point3& p : points) {
            lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
            upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
        }
    }

    [[nodiscard]] bool meets(const Box& o) const noexcept {
        return lower.x <= o.upper.x && o.lower.x <= upper.x && lower.y <= o.upper.y
               && o.lower.y <= upper.y && lower.z <= o.upper.z && o.lower.z <= upper.z;
    }
};

/// True if the segment goes right through the triangle, not only touching it: both ends at
/// least 0.1 mm beyond its plane.
bool goes_through(const Point3& a, const Point3& b, const Corners& t) {
    constexpr double touch = 1e-4;
    const Vector3 n = twice_vector_area(t);
    const UnitVector3 unit(n);
    const double from = dot(unit, a - t[0]), to = dot(unit, b - t[0]);
    if (from * to >= 0.0 || std::min(std::abs(from), std::abs(to)) < touch)
        return false;
    const Point3 p = a + from / (from - to) * (b - a);
    for (std::size_t i = 0; i < 3; ++i)
        if (dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), n) <= 0.0)
            return false;
    return true;
}

bool pierces(const Facet& facet, const Corners& t) {
    const auto& v = facet.vertices;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (goes_through(v[i], v[(i + 1) % v.size()], t))
            return true;
    for (std::size_t i = 1; i + 1 < v.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (goes_through(t[k], t[(k + 1) % 3], {v[0], v[i], v[i + 1]}))
                return true;
    return false;
}

const std::string* find_pierced(const Opening& opening,
                                const std::vector<NamedTriangle>& triangles) {
    std::vector<Point3> all;
    for (const Facet& f : opening.facets)
        all.insert(all.end(), f.vertices.begin(), f.vertices.end());
    if (all.empty())
        return nullptr;
    const Box box(all);
    for (const NamedTriangle& t : triangles)
        if (box.meets(Box(t.corner))
            && std::ranges::any_of(opening.facets,
                                   [&](const Facet& f) { return pierces(f, t.corner); }))
            return t.surface;
    return nullptr;
}

void inspect_luminaires(const SceneDescription& description, std::vector<Message>& messages) {
    std::vector<NamedTriangle> triangles;
    for (const Room& room : description.rooms)
        for (const auto& t : make_room_shell(room, description.rooms).mesh.triangles())
            triangles.push_back({t.corner, &room.name});
    for (const Object& object : description.objects)
        for (const auto& t : object.mesh.triangles())
            triangles.push_back({t.corner, &object.name});
    for (const LuminairePlacement& l : description.luminaires) {
        const Point3& p = l.world_from_luminaire.origin;
        if (!description.rooms.empty() && !is_in_a_room(description.rooms, p)) {
            messages.push_back(
                {place_of(l),
                 fmt::format("hangs outside every room, at {} (its light is lost)", words(p)),
                 "Is its position in the building's coordinates?"});
            continue;
        }
        const auto& type = description.luminaire_types[l.type.index()];
        const auto opening = to_world(make_opening(type.opening), l.world_from_luminaire);
        if (const std::string* surface = find_pierced(opening, triangles))
            messages.push_back(
                {place_of(l),
                 fmt::format("its luminous opening pierces '{}', near {} (part of "
                             "its light starts behind that surface)",
                             *surface,
                             words(p)),
                 "Move it, or check the size of its opening?"});
    }
}

} // namespace

std::vector<Message> inspect_scene(const SceneDescription& description) {
    std::vector<Message> messages;
    for (const Object& object : description.objects) {
        inspect_mesh(object, messages);
        if (!description.rooms.empty())
            inspect_position(object, description.rooms, messages);
    }
    inspect_luminaires(description, messages);
    return messages;
}

} // namespace isolux
