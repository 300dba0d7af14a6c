#include "isolux/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "isolux/scene/triangulate.h"

namespace isolux {
namespace {

/// How far rays start off a facet at least, whatever point of it they leave
/// (RayCaster::offset_point).
double least_ray_offset(const Facet& facet, const Point3& centre) noexcept {
    const auto nearest = [&](auto coordinate) {
        double lower = std::numeric_limits<double>::infinity();
        double upper = -lower;
        for (const Point3& p : facet.vertices) {
            lower = std::min(lower, coordinate(p) - coordinate(centre));
            upper = std::max(upper, coordinate(p) - coordinate(centre));
        }
        return std::max({lower, -upper, 0.0});
    };
    const double reach = std::max({nearest([](const Point3& p) { return p.x; }),
                                   nearest([](const Point3& p) { return p.y; }),
                                   nearest([](const Point3& p) { return p.z; })});
    return reach * 0x1p-20 + 1e-5;
}

/// Where the black body of an opening's facet lies along the facet's normal. Behind a solid
/// opening's faces: a tenth of a millimetre inside, or more where the scene is large. On a flat
/// opening: in front of it by half of what rays start off it. So an opening set flush into a
/// ceiling covers the ceiling, and light still starts before the body.
double body_shift(const Facet& facet, OpeningForm form, const Point3& centre) noexcept {
    if (form == OpeningForm::flat)
        return 0.5 * least_ray_offset(facet, centre);
    double reach = 0.0;
    for (const Point3& p : facet.vertices)
        reach = std::max(reach, distance(p, centre));
    return -std::max(1e-4, 4.0 * (reach * 0x1p-20 + 1e-5));
}

class SceneBuilder {
public:
    void add_object(const Object& object, bool is_shell);
    void add_body(const Luminaire& luminaire, MaterialId black, const Point3& centre);
    [[nodiscard]] Bounds bounds() const noexcept;

    std::vector<Surface> surfaces;
    std::vector<SceneTriangle> triangles;

private:
    void begin(std::string name, bool is_shell) {
        surfaces.push_back({std::move(name), triangles.size(), 0, 0.0, is_shell});
    }

    void add(const std::array<Point3, 3>& corner, MaterialId material);
};

void SceneBuilder::add(const std::array<Point3, 3>& corner, MaterialId material) {
    const Vector3 n = twice_vector_area(corner);
    Surface& surface = surfaces.back();
    const double area = 0.5 * length(n);
    triangles.push_back(
        {corner, UnitVector3(n), area, material, SurfaceId(surfaces.size() - 1)});
    surface.area += area;
    ++surface.triangles;
}

/// One surface for each slot of the object's mesh.
void SceneBuilder::add_object(const Object& object, bool is_shell) {
    const auto all = object.mesh.triangles();
    const auto& slots = object.mesh.slots();
    for (std::size_t slot = 0; slot < slots.size(); ++slot) {
        const auto is_here = [slot](const MeshTriangle& t) { return t.slot == slot; };
        if (std::ranges::none_of(all, is_here))
            continue;
        begin(slots[slot].empty() ? object.name : object.name + "/" + slots[slot], is_shell);
        for (const MeshTriangle& t : all)
            if (is_here(t))
                add(t.corner, object.material_of_slot[slot]);
    }
}

/// Black facets on a flat opening, or just inside a solid one.
void SceneBuilder::add_body(const Luminaire& luminaire,
                            MaterialId black,
                            const Point3& centre) {
    if (luminaire.opening.facets.empty())
        return;
    begin(luminaire.placement.name + "/body", false);
    for (const Facet& facet : luminaire.opening.facets) {
        const Vector3 shift =
            body_shift(facet, luminaire.opening.form, centre) * Vector3(facet.normal);
        for (std::size_t i = 1; i + 1 < facet.vertices.size(); ++i)
            add({facet.vertices[0] + shift,
                 facet.vertices[i] + shift,
                 facet.vertices[i + 1] + shift},
                black);
    }
}

Bounds SceneBuilder::bounds() const noexcept {
    if (triangles.empty())
        return {};
    constexpr double inf = std::numeric_limits<double>::infinity();
    Bounds b{{inf, inf, inf}, {-inf, -inf, -inf}};
    for (const auto& t : triangles)
        for (const Point3& p : t.corner) {
            b.lower = {
                std::min(b.lower.x, p.x), std::min(b.lower.y, p.y), std::min(b.lower.z, p.z)};
            b.upper = {
                std::max(b.upper.x, p.x), std::max(b.upper.y, p.y), std::max(b.upper.z, p.z)};
        }
    return b;
}

RayCaster make_caster(const SceneBuilder& built, const std::vector<Material>& materials) {
    std::vector<CasterTriangle> triangles;
    triangles.reserve(built.triangles.size());
    for (const SceneTriangle& t : built.triangles) {
        CasterTriangle c{.corner = t.corner,
                         .is_shell = built.surfaces[t.surface.index()].is_shell};
        if (const auto* pane =
                std::get_if<ClearPane>(&materials[t.material.index()].scattering)) {
            c.is_pane = true;
            c.refractive_index = pane->refractive_index;
            c.internal_transmittance = pane->internal_transmittance;
        }
        triangles.push_back(c);
    }
    return RayCaster(triangles);
}

std::vector<Luminaire> hang_luminaires(const SceneDescription& description) {
    std::vector<Luminaire> luminaires;
    for (const LuminairePlacement& placement : description.luminaires) {
        const auto& type = description.luminaire_types[placement.type.index()];
        luminaires.push_back(
            {placement,
             to_world(make_opening(type.opening), placement.world_from_luminaire),
             placement.scale * luminous_flux(type)});
    }
    return luminaires;
}

/// The point the ray caster will count coordinates from: bodies lie where their openings do.
Point3 middle_of(const SceneBuilder& built, const std::vector<Luminaire>& luminaires) {
    Bounds b = built.bounds();
    bool is_empty = built.triangles.empty();
    for (const Luminaire& l : luminaires)
        for (const Facet& f : l.opening.facets)
            for (const Point3& p : f.vertices) {
                if (is_empty)
                    b = {p, p};
                is_empty = false;
                b.lower = {std::min(b.lower.x, p.x),
                           std::min(b.lower.y, p.y),
                           std::min(b.lower.z, p.z)};
                b.upper = {std::max(b.upper.x, p.x),
                           std::max(b.upper.y, p.y),
                           std::max(b.upper.z, p.z)};
            }
    return midpoint(b.lower, b.upper);
}

/// Where the openings of the rooms' walls are.
std::vector<SceneOpening> find_openings(const std::vector<Room>& rooms) {
    std::vector<SceneOpening> openings;
    for (const Room& room : rooms)
        for (const WallOpening& o : room.openings) {
            const Point2& a = room.footprint[o.wall];
            const Point2& b = room.footprint[(o.wall + 1) % room.footprint.size()];
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const auto at = [&](double along) {
                const double t = along / length;
                return Point2{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
            };
            openings.push_back({room.name,
                                o.name,
                                at(o.offset),
                                at(o.offset + o.width),
                                o.sill,
                                o.height,
                                o.state});
        }
    return openings;
}

} // namespace

Scene build_scene(SceneDescription description) {
    SceneBuilder built;
    for (const Room& room : description.rooms)
        built.add_object(make_room_shell(room, description.rooms), true);
    for (const Object& object : description.objects)
        built.add_object(object, false);

    description.materials.push_back({"black", Opaque{}, Sides::both});
    const MaterialId black(description.materials.size() - 1);
    auto luminaires = hang_luminaires(description);
    const Point3 centre = middle_of(built, luminaires);
    for (const Luminaire& luminaire : luminaires)
        if (description.luminaire_types[luminaire.placement.type.index()].body
            == BodyModel::absorbing)
            built.add_body(luminaire, black, centre);

    double total_area = 0.0;
    for (const SceneTriangle& t : built.triangles)
        total_area += t.area;
    RayCaster caster = make_caster(built, description.materials);
    const Bounds bounds = built.bounds();
    return {std::move(description.materials),
            std::move(built.surfaces),
            std::move(built.triangles),
            std::move(description.luminaire_types),
            std::move(luminaires),
            bounds,
            total_area,
            std::move(caster),
            find_openings(description.rooms)};
}

} // namespace isolux
