#include "isolux/validate/inverse_square.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

namespace isolux {

namespace {

using std::numbers::pi;

/// What the receiver makes of unit luminance per steradian from the direction `w`.
double response(const Receiver& receiver, const UnitVector3& w) noexcept {
    const double cos_g = dot(receiver.axis, w);
    switch (receiver.kind) {
    case IlluminanceKind::planar:
        return std::max(0.0, cos_g);
    case IlluminanceKind::cylindrical:
        return length(cross(receiver.axis, w)) / pi;
    case IlluminanceKind::semi_cylindrical: {
        // sin g cos a is the part of w along the reference made perpendicular to the axis.
        const Vector3 axis = receiver.axis;
        const Vector3 facing = receiver.reference;
        const UnitVector3 u(facing - dot(facing, axis) * axis);
        return (length(cross(axis, w)) + dot(u, w)) / pi;
    }
    case IlluminanceKind::hemispherical:
        return 0.25 * (1.0 + cos_g);
    case IlluminanceKind::mean_spherical:
        return 0.25;
    }
    return 0.0;
}

} // namespace

Candela point_source_intensity(const IdealPointSource& source,
                               const UnitVector3& direction) noexcept {
    const double flux = in_lumen(source.flux);
    if (!source.exponent)
        return Candela(flux / (4.0 * pi));
    const double n = *source.exponent;
    const double c = dot(source.axis, direction);
    return Candela(c > 0.0 ? flux * (n + 1.0) / (2.0 * pi) * std::pow(c, n) : 0.0);
}

Lux point_source_illuminance(const IdealPointSource& source,
                             const Receiver& receiver) noexcept {
    const Vector3 d = source.position - receiver.point;
    ISOLUX_EXPECT(length(d) > 0.0);
    const UnitVector3 w(d);
    return Lux(response(receiver, w) * in_candela(point_source_intensity(source, -w))
               / length_squared(d));
}

} // namespace isolux
