#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/base/ids.h"
#include "isolux/base/vec.h"
#include "isolux/scene/material.h"
#include "isolux/scene/ray_caster.h"

namespace isolux {

/// The float-safe step off a surface at `p`, in metres, METHODS eq. (43).
[[nodiscard]] inline double float_offset(const Vector3& p) noexcept {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) * 0x1p-20 + 1e-5;
}

/// A triangle in double precision, relative to the caster's centre.
struct Piece {
    Vector3 a;
    Vector3 ab;
    Vector3 ac;
    UnitVector3 normal;
    TriangleId id;
    bool is_shell = false;
    ClearPane pane; ///< panes only

    [[nodiscard]] Vector3 at(double u, double v) const noexcept { return a + u * ab + v * ac; }
};

[[nodiscard]] Piece
make_piece(const CasterTriangle& triangle, TriangleId id, const Point3& centre);

/// True if `p` lies within `reach` (m) of the triangle.
[[nodiscard]] bool is_on(const Piece& piece, const Vector3& p, double reach) noexcept;

/// For every shell triangle the shell triangles that lie back to back with it, within about
/// `reach` (m): the other sides of walls that two rooms share.
[[nodiscard]] std::vector<std::vector<std::uint32_t>>
find_twins(const std::vector<Piece>& pieces, double reach);

/// Distance in metres from `p` to the nearest point of a triangle: over its inside the distance
/// to the plane, elsewhere that to the nearest edge.
[[nodiscard]] double distance_to(const Piece& piece, const Vector3& p) noexcept;

/// Whether two triangles are parts of one surface as far as light is concerned: hardly turned
/// against each other, and neither in front of the other.
[[nodiscard]] bool continues(const Piece& p, const Piece& q) noexcept;

/// A box about all panes, in the ray tracer's precision: most rays have nothing to do with it.
struct PaneBox {
    Vector3 lower{1e30, 1e30, 1e30};
    Vector3 upper{-1e30, -1e30, -1e30};

    explicit PaneBox(std::span<const Piece> panes);

    /// False is certain: the box about the segment and this one have nothing in common.
    [[nodiscard]] bool may_meet(const Vector3& p, const Vector3& q) const noexcept {
        return std::min(p.x, q.x) <= upper.x && std::max(p.x, q.x) >= lower.x
               && std::min(p.y, q.y) <= upper.y && std::max(p.y, q.y) >= lower.y
               && std::min(p.z, q.z) <= upper.z && std::max(p.z, q.z) >= lower.z;
    }
};

} // namespace isolux
