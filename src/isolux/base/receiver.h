#pragma once

#include <string_view>

#include "isolux/base/vec.h"

namespace isolux {

/// The illuminances of CIE S 017: on a plane, cylindrical, semi-cylindrical, hemispherical and
/// mean spherical. Every one of them is pi L under a uniform luminance L.
enum class IlluminanceKind {
    planar,           ///< on the plane with normal `axis`
    cylindrical,      ///< axis `axis`, usually vertical
    semi_cylindrical, ///< axis `axis`, facing `reference`
    hemispherical,    ///< dome around `axis`
    mean_spherical,   ///< no direction at all
};

/// A measurement point: where, which way, and what. Receives illuminance.
struct Receiver {
    Point3 point;
    UnitVector3 axis; ///< the normal, or the axis of the body
    IlluminanceKind kind = IlluminanceKind::planar;
    UnitVector3 reference =
        UnitVector3::from_unit({1, 0, 0}); ///< semi-cylindrical: the way it faces
};

/// Receives luminance: from `eye`, looking along `direction`.
struct SightLine {
    Point3 eye;
    UnitVector3 direction;
};

} // namespace isolux
