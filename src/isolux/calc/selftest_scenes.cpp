#include "isolux/calc/selftest_scenes.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace isolux {

namespace {

using Face = std::vector<std::uint32_t>;

struct Polyhedron {
    std::vector<Point3> points;
    std::vector<Face> faces;
};

/// Corners (0, +-1, +-golden ratio) and their cyclic permutations, faces seen from outside.
Polyhedron make_icosahedron() {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    return {{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
             {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
             {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
             {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}}};
}

/// Every triangle becomes four.
Polyhedron halve_edges(const Polyhedron& coarse) {
    Polyhedron fine{coarse.points, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(fine.points.size()));
        if (is_new)
            fine.points.push_back(midpoint(fine.points[a], fine.points[b]));
        return place->second;
    };
    for (const Face& f : coarse.faces) {
        const std::uint32_t ab = middle(f[0], f[1]);
        const std::uint32_t bc = middle(f[1], f[2]);
        const std::uint32_t ca = middle(f[2], f[0]);
        fine.faces.insert(fine.faces.end(),
                          {{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}});
    }
    return fine;
}

Point3 project_to_sphere(const Point3& p, double radius) {
    return Point3{} + radius * Vector3(UnitVector3(p - Point3{}));
}

void add_source(SceneDescription& scene, LuminaireType type, const Frame& frame) {
    const LuminaireTypeId id(scene.luminaire_types.size());
    scene.luminaire_types.push_back(std::move(type));
    LuminairePlacement placement;
    placement.name = "source " + std::to_string(scene.luminaires.size() + 1);
    placement.type = id;
    placement.world_from_luminaire = frame;
    scene.luminaires.push_back(std::move(placement));
}

} // namespace

Material make_grey(double reflectance) {
    return {"grey", Opaque{Rgb::grey(reflectance), 0.0}, Sides::both};
}

MaterialId add_material(SceneDescription& scene, double reflectance) {
    scene.materials.push_back(make_grey(reflectance));
    return MaterialId(scene.materials.size() - 1);
}

Object make_plate(std::string name, const std::array<Point3, 4>& corners, MaterialId material) {
    const std::vector<Face> faces{{0, 1, 2, 3}};
    return {std::move(name), SurfaceMesh(corners, faces), {material}};
}

SphereMesh make_sphere(double radius, int halvings, MaterialId material) {
    Polyhedron body = make_icosahedron();
    for (int i = 0; i < halvings; ++i) {
        body = halve_edges(body);
        for (Point3& p : body.points)
            p = project_to_sphere(p, radius);
    }
    for (Point3& p : body.points)
        p = project_to_sphere(p, radius);
    SphereMesh sphere;
    for (Face& f : body.faces) {
        std::swap(f[1], f[2]); // now the front faces inwards
        const Point3 &a = body.points[f[0]], &b = body.points[f[1]], &c = body.points[f[2]];
        const Vector3 twice_area = cross(b - a, c - a);
        sphere.area += 0.5 * length(twice_area);
        sphere.centres.push_back(a + ((b - a) + (c - a)) / 3.0);
        sphere.normals.emplace_back(twice_area);
    }
    sphere.object = {"sphere", SurfaceMesh(body.points, body.faces), {material}};
    return sphere;
}

Room make_box_room(
    double x, double y, double z, MaterialId floor, MaterialId ceiling, MaterialId wall) {
    Room room;
    room.name = "room";
    room.footprint = {{0, 0}, {x, 0}, {x, y}, {0, y}};
    room.height = z;
    room.floor = floor;
    room.ceiling = ceiling;
    room.walls.assign(4, wall);
    return room;
}

void add_isotropic_source(SceneDescription& scene, const Point3& position, Lumen flux) {
    LuminaireType type;
    type.name = "isotropic";
    type.source = IsotropicSource{flux};
    Frame frame;
    frame.origin = position;
    add_source(scene, std::move(type), frame);
}

void add_lambertian_source(SceneDescription& scene,
                           const Frame& frame,
                           const LuminousOpening& opening,
                           Lumen flux) {
    LuminaireType type;
    type.name = "lambertian";
    type.source = LambertianSource{flux};
    type.opening = opening;
    add_source(scene, std::move(type), frame);
}

} // namespace isolux
