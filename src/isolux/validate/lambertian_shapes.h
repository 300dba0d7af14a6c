#pragma once

#include <span>

#include "isolux/base/angle.h"
#include "isolux/base/units.h"
#include "isolux/base/vec.h"

/// Illuminance from shapes of one luminance in empty space. Nothing hides the shape, and where
/// it is not said otherwise the whole of it is above the receiver's horizon.
namespace isolux {

/// An axis-parallel rectangle in a plane parallel to the receiver's, at `height` above it:
/// x0..x1 by y0..y1 counted from the foot of the receiver's normal. Four corner terms; Lambert
/// 1760.
struct ParallelRectangle {
    double x0, x1, y0, y1; ///< m
    double height;         ///< m, > 0
};

[[nodiscard]] Lux illuminance_from(const ParallelRectangle& shape,
                                   CandelaPerSquareMetre luminance) noexcept;

/// A rectangle in a plane perpendicular to the receiver's, `distance` away from its normal:
/// y0..y1 along the wall, z0..z1 above the receiver. What is below the receiver (z < 0) is cut
/// off.
struct PerpendicularRectangle {
    double y0, y1, z0, z1; ///< m
    double distance;       ///< m, > 0
};

[[nodiscard]] Lux illuminance_from(const PerpendicularRectangle& shape,
                                   CandelaPerSquareMetre luminance) noexcept;

/// A horizontal disc of radius a; the receiver is `height` h away from its plane and `offset` x
/// from its axis.
struct LambertianDisc {
    double radius; ///< m
    double height; ///< m, > 0
    double offset; ///< m, >= 0
};

/// On a plane parallel to the disc: (pi L/2)(1 - (t - a2)/sqrt((t + a2)^2 - 4 a2 x2)), t = x2 +
/// h2.
[[nodiscard]] Lux illuminance_from(const LambertianDisc& shape,
                                   CandelaPerSquareMetre luminance) noexcept;

/// On a plane perpendicular to the disc's that faces its axis:
/// (pi L h/(2 x)) ((t + a2)/sqrt((t + a2)^2 - 4 a2 x2) - 1). @pre offset >= radius
[[nodiscard]] Lux vertical_illuminance_from(const LambertianDisc& shape,
                                            CandelaPerSquareMetre luminance) noexcept;

/// A sphere of radius `radius` whose centre is `distance` away; `tilt` is the angle between the
/// receiver's normal and the direction of the centre. Cut by the horizon where it dips below.
struct LambertianSphere {
    double radius;
    double distance; ///< > radius
    Angle tilt;
};

[[nodiscard]] Lux illuminance_from(const LambertianSphere& shape,
                                   CandelaPerSquareMetre luminance) noexcept;

/// A thin Lambertian line: a piece dx has the intensity i0 cos(psi) dx at psi from the plane
/// across the line. It runs from x0 to x1 (m, from the foot of the perpendicular from the
/// receiver), parallel to the receiver's plane and `height` above it, `distance` from the
/// receiver. The whole line emits pi^2 i0 lumen per metre.
struct LambertianLine {
    double x0, x1;
    double height;
    double distance; ///< >= height
};

/// (i0 h/(2 D2)) [psi + sin psi cos psi] between the ends. `intensity_per_metre` i0 in cd/m.
[[nodiscard]] Lux illuminance_from(const LambertianLine& shape,
                                   double intensity_per_metre) noexcept;

/// Any simple polygon of one luminance on both sides, cut by the horizon, METHODS eq. (12).
[[nodiscard]] Lux polygon_illuminance(std::span<const Point3> polygon,
                                      CandelaPerSquareMetre luminance,
                                      const Point3& point,
                                      const UnitVector3& normal) noexcept;

} // namespace isolux
