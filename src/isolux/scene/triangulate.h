#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/base/vec.h"
#include "isolux/scene/room.h"

namespace isolux {

/// Corners of a triangle as indices into the points it was made from.
using TriangleCorners = std::array<std::uint32_t, 3>;

/// Splits a simple polygon with holes into triangles by cutting ears; holes are first joined to
/// the outline by bridges. Points on a straight edge are kept, so that neighbours that share
/// them meet without a gap.
/// @param rings  outline first, counter-clockwise; then holes, clockwise
/// @return       counter-clockwise triangles; indices count the rings' points one after another
[[nodiscard]] std::vector<TriangleCorners>
triangulate(const std::vector<std::vector<Point2>>& rings);

/// The same for one planar polygon in space; triangles turn like the polygon.
[[nodiscard]] std::vector<TriangleCorners> triangulate(std::span<const Point3> polygon);

/// Twice the vector area of a polygon (Newell): along its normal, as long as twice its area.
[[nodiscard]] Vector3 twice_vector_area(std::span<const Point3> polygon) noexcept;

} // namespace isolux
