#pragma once

#include "isolux/base/angle.h"
#include "isolux/base/vec.h"

namespace isolux {

/// A rigid placement: where a local frame stands in the world. Named by what it gives, so that
/// chains read right to left: `world_from_luminaire`.
struct Frame {
    Point3 origin;
    UnitVector3 x = UnitVector3::from_unit({1, 0, 0});
    UnitVector3 y = UnitVector3::from_unit({0, 1, 0});
    UnitVector3 z = UnitVector3::from_unit({0, 0, 1});

    [[nodiscard]] Vector3 vector_from_local(const Vector3& v) const noexcept {
        return v.x * Vector3(x) + v.y * Vector3(y) + v.z * Vector3(z);
    }

    [[nodiscard]] Vector3 vector_to_local(const Vector3& v) const noexcept {
        return {dot(x, v), dot(y, v), dot(z, v)};
    }

    [[nodiscard]] Point3 point_from_local(const Vector3& v) const noexcept {
        return origin + vector_from_local(v);
    }

    [[nodiscard]] Vector3 point_to_local(const Point3& p) const noexcept {
        return vector_to_local(p - origin);
    }
};

/// Turns `v` about the unit axis `k` by `angle`, counter-clockwise seen from the tip of `k`
/// (Rodrigues' rotation formula).
[[nodiscard]] inline Vector3
rotate(const Vector3& v, const UnitVector3& k, Angle angle) noexcept {
    const double c = std::cos(angle.in_radians());
    const double s = std::sin(angle.in_radians());
    return c * v + s * cross(k, v) + ((1.0 - c) * dot(k, v)) * Vector3(k);
}

/// The frame turned about an axis through its own origin.
[[nodiscard]] inline Frame rotate(const Frame& f, const UnitVector3& k, Angle angle) noexcept {
    return {f.origin,
            UnitVector3(rotate(Vector3(f.x), k, angle)),
            UnitVector3(rotate(Vector3(f.y), k, angle)),
            UnitVector3(rotate(Vector3(f.z), k, angle))};
}

} // namespace isolux
