#pragma once

#include <span>

#include "isolux/base/units.h"
#include "isolux/base/vec.h"
#include "isolux/validate/inverse_square.h"

/// Shadows and mirror images of sources of one luminance, by clipping polygons.
namespace isolux {

/// The edge of an opaque half-plane: a straight line and the side of it that is open.
struct OccludingEdge {
    Point3 point;      ///< on the edge
    Vector3 direction; ///< along the edge
    Vector3 open_side; ///< from the edge away from the half-plane
};

/// Penumbra: illuminance from a convex polygon partly hidden by a half-plane. The part seen is
/// what lies on the open side of the plane through the receiver and the edge.
/// @pre the half-plane is between receiver and polygon
[[nodiscard]] Lux penumbra_illuminance(std::span<const Point3> polygon,
                                       CandelaPerSquareMetre luminance,
                                       const OccludingEdge& edge,
                                       const Point3& point,
                                       const UnitVector3& normal);

/// A flat, convex mirror.
struct FlatMirror {
    std::span<const Point3> outline;
    double reflectance = 1.0;
};

[[nodiscard]] Point3 mirror_image(const Point3& p, const FlatMirror& mirror) noexcept;

/// Light of a point source by way of the mirror, without the direct light: reflectance times
/// that of the image, if the line from the image to the receiver crosses the mirror and source
/// and receiver are on one side of it. Planar receivers only.
[[nodiscard]] Lux mirrored_illuminance(const IdealPointSource& source,
                                       const FlatMirror& mirror,
                                       const Point3& point,
                                       const UnitVector3& normal);

/// Light of a convex polygon of one luminance by way of the mirror: its image, clipped by the
/// pyramid of receiver and mirror. @pre the polygon is on the receiver's side of the mirror
[[nodiscard]] Lux mirrored_illuminance(std::span<const Point3> polygon,
                                       CandelaPerSquareMetre luminance,
                                       const FlatMirror& mirror,
                                       const Point3& point,
                                       const UnitVector3& normal);

} // namespace isolux
