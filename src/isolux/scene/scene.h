#pragma once

#include <string>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/base/ids.h"
#include "isolux/scene/luminaire.h"
#include "isolux/scene/material.h"
#include "isolux/scene/mesh.h"
#include "isolux/scene/ray_caster.h"
#include "isolux/scene/room.h"

namespace isolux {

/// A thing in a room: its surfaces (held by OpenMesh, in world coordinates) and what they are
/// made of, slot by slot.
struct Object {
    std::string name;
    SurfaceMesh mesh;
    std::vector<MaterialId> material_of_slot;
};

/// Everything `build_scene` needs: values only, files have been read.
struct SceneDescription {
    std::vector<Material> materials;
    std::vector<Room> rooms;
    std::vector<Object> objects;
    std::vector<LuminaireType> luminaire_types;
    std::vector<LuminairePlacement> luminaires;
};

/// A named piece of the scene: "office/floor", "office/wall 2", "desk 1".
struct Surface {
    std::string name;
    std::size_t first_triangle = 0;
    std::size_t triangles = 0;
    double area = 0.0; ///< m2, one side
    bool is_shell = false;
};

/// A door, a window or a hole in a wall of a room.
struct SceneOpening {
    std::string room;
    std::string name;
    Point2 from; ///< its ends along the wall
    Point2 to;
    double sill = 0.0;   ///< m above the floor
    double height = 0.0; ///< m
    OpeningState state = OpeningState::open;
};

struct SceneTriangle {
    std::array<Point3, 3> corner;
    UnitVector3 normal; ///< of the front; rooms' shells face inwards
    double area = 0.0;
    MaterialId material;
    SurfaceId surface;
};

struct Bounds {
    Point3 lower;
    Point3 upper;
};

/// The room as light meets it. Never changes after build_scene.
struct Scene {
    std::vector<Material> materials; ///< the last one is black: bodies of luminaires
    std::vector<Surface> surfaces;
    std::vector<SceneTriangle> triangles; ///< same order as the caster's TriangleId
    std::vector<LuminaireType> luminaire_types;
    std::vector<Luminaire> luminaires;
    Bounds bounds;
    double total_area = 0.0; ///< m2 of all triangles, one side
    RayCaster caster;
    std::vector<SceneOpening> openings;

    [[nodiscard]] const SceneTriangle& triangle(TriangleId id) const noexcept {
        return triangles[id.index()];
    }

    [[nodiscard]] const Material& material(MaterialId id) const noexcept {
        return materials[id.index()];
    }

    [[nodiscard]] const LuminaireType& type_of(const Luminaire& l) const noexcept {
        return luminaire_types[l.placement.type.index()];
    }
};

[[nodiscard]] Scene build_scene(SceneDescription description);

/// The shell of a room as OpenMesh holds it: floor, ceiling, walls with their openings cut out,
/// leaves and panes, columns. Slot names are "floor", "ceiling", "wall 1", ..., "opening
/// <name>".
[[nodiscard]] Object make_room_shell(const Room& room, std::span<const Room> neighbours);

/// Oddities of the built surfaces: meshes (inspect), luminaires whose opening pierces a
/// surface, luminaires outside every room, objects outside every room.
[[nodiscard]] std::vector<Message> inspect_scene(const SceneDescription& description);

} // namespace isolux
