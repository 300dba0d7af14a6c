#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/base/frame.h"
#include "isolux/base/vec.h"

namespace isolux {

enum class MeshFileFormat { obj, ply, stl, off };

/// A triangle with the index of its material slot (an OBJ's `usemtl`), see
/// SurfaceMesh::slots().
struct MeshTriangle {
    std::array<Point3, 3> corner; ///< counter-clockwise seen from the front
    std::uint32_t slot = 0;
};

/// One thing that is odd about a mesh, and where.
struct MeshFinding {
    enum class Kind { degenerate, open_edge, non_manifold_edge, inside_out, duplicate_face };
    Kind kind;
    Point3 place;
    std::string text; ///< in words, without the file's name
};

/// A surface held by OpenMesh. Faces that OpenMesh cannot connect (non-manifold ones) are kept
/// and reported, never dropped: light meets them all the same.
class SurfaceMesh {
public:
    SurfaceMesh();
    /// @param faces  polygons (3 or more corners, simple, planar) as indices into `points`
    /// @param slot_of_face  material slot of each face; empty: all slot 0
    SurfaceMesh(std::span<const Point3> points,
                std::span<const std::vector<std::uint32_t>> faces,
                std::span<const std::uint32_t> slot_of_face = {},
                std::vector<std::string> slots = {""});
    ~SurfaceMesh();
    SurfaceMesh(SurfaceMesh&&) noexcept;
    SurfaceMesh& operator=(SurfaceMesh&&) noexcept;

    /// Every face, split into triangles. Faces without area are left out: no light meets them.
    [[nodiscard]] std::vector<MeshTriangle> triangles() const;
    [[nodiscard]] const std::vector<std::string>& slots() const noexcept;
    /// A copy, stretched by `scale` along its own axes (all nonzero; a negative product mirrors
    /// the surface and keeps its front outside), then placed.
    [[nodiscard]] SurfaceMesh transformed(const Vector3& scale,
                                          const Frame& world_from_object) const;
    /// Degenerate faces, open borders, non-manifold edges, a closed surface turned inside out.
    [[nodiscard]] std::vector<MeshFinding> inspect() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Reads a mesh file from its bytes. @throws InputError naming `source` and, for text, the
/// line.
[[nodiscard]] Parsed<SurfaceMesh>
parse_mesh(std::string_view bytes, MeshFileFormat format, std::string_view source);

} // namespace isolux
