#pragma once

#include <span>
#include <vector>

#include "isolux/base/vec.h"

namespace isolux {

/// The part of a planar convex polygon on the side of `normal` of the plane through `point`
/// (Sutherland-Hodgman). Empty if nothing is left.
[[nodiscard]] std::vector<Point3>
clip_to_half_space(std::span<const Point3> polygon, const Point3& point, const Vector3& normal);

/// Projected solid angle of a polygon of uniform luminance 1, seen from `point` with normal
/// `normal`: the illuminance is L times this, METHODS eq. (12) (Lambert's formula). The polygon
/// is clipped against the receiver's plane, allocates nothing and may be any simple one; which
/// side of it is seen does not matter.
/// Exact to about 1e-12 of pi.
[[nodiscard]] double projected_solid_angle(std::span<const Point3> polygon,
                                           const Point3& point,
                                           const UnitVector3& normal) noexcept;

} // namespace isolux
