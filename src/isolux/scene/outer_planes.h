#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/base/vec.h"
#include "isolux/scene/caster_piece.h"
#include "isolux/scene/embree_scene.h"

namespace isolux {

/// Planes that bound a scene: floors, ceilings and outer walls, with next to nothing beyond
/// them. What lies in such a plane cannot stand between two points on the inner side of it,
/// METHODS "Ray tracer".
class OuterPlanes {
public:
    OuterPlanes() = default;
    explicit OuterPlanes(std::span<const Piece> pieces);

    /// Whether a triangle lies in one of the planes.
    [[nodiscard]] bool hold(const Piece& piece) const noexcept;

    /// Whether both points are inside of all planes.
    [[nodiscard]] bool enclose(const Vector3& p, const Vector3& q) const noexcept;

    /// Whether both ends of all `wanted` rays are; a ray ends at 1.
    [[nodiscard]] bool enclose(const RayPacket& rays, std::uint32_t wanted) const noexcept;

    [[nodiscard]] bool empty() const noexcept { return planes_.empty(); }

    /// A plane in the ray tracer's precision: x, y and z of its normal, and how far along it
    /// the inside goes.
    struct Rounded {
        float x, y, z, limit;
    };

private:
    /// normal . p <= offset inside.
    struct Plane {
        UnitVector3 normal;
        double offset = 0.0; ///< m
        double spare = 0.0;  ///< m; nearer counts as in it
    };

    std::vector<Plane> planes_;
    std::vector<Rounded> rounded_; ///< the same
};

} // namespace isolux
