#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "isolux/base/ids.h"
#include "isolux/base/receiver.h"
#include "isolux/base/vec.h"
#include "isolux/scene/ray_order.h"

namespace isolux {

/// A triangle as the ray tracer sees it. `is_pane`: clear glass, light passes dimmed.
struct CasterTriangle {
    std::array<Point3, 3> corner{};
    bool is_pane = false;
    bool is_shell =
        false; ///< wall of a room: where two rooms touch, the side that faces the ray counts
    double refractive_index = 1.52;      ///< panes only
    double internal_transmittance = 1.0; ///< panes only
};

struct SurfaceHit {
    TriangleId triangle;
    double distance = 0.0; ///< m, along the ray
    Point3 position;       ///< on the triangle, in double precision
    UnitVector3 normal;    ///< geometric, on the side the ray came from
    bool is_front = true;  ///< the ray met the triangle's front
};

/// Joins two points that are already offset from their surfaces.
struct SightSegment {
    Point3 a;
    Point3 b;
};

/// Distances in metres from a point to the surfaces around it.
struct SurfaceDistances {
    double nearest = 0.0;
    double second = 0.0;
    UnitVector3 nearest_normal; ///< of the front of the nearest surface, where one is in reach
};

inline constexpr std::size_t packet_size = 16;

/// What light asks the scene, in double precision. Coordinates are recentred before they become
/// the ray tracer's floats. Safe to call from any number of threads.
class RayCaster {
public:
    explicit RayCaster(std::span<const CasterTriangle> triangles);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;

    /// The nearest surface, panes included. @param max_distance  in metres
    [[nodiscard]] std::optional<SurfaceHit>
    find_first_hit(const Point3& origin,
                   const UnitVector3& direction,
                   double max_distance = 1e30) const noexcept;

    /// The same without an end for up to packet_size lines at once: `hits[i]` is what
    /// `lines[i]` meets. Coherent lines are fast.
    void find_first_hits16(std::span<const SightLine> lines,
                           std::span<std::optional<SurfaceHit>> hits) const noexcept;

    /// `p` moved off its surface to the side of `free_side` by a length that float arithmetic
    /// cannot lose (METHODS, "Ray tracer"). Rays start from and end at such points.
    [[nodiscard]] Point3 offset_point(const Point3& p,
                                      const UnitVector3& free_side) const noexcept;
    [[nodiscard]] Point3 offset_point(const Point3& p, const Vector3& free_side) const noexcept;

    /// 0 if an opaque surface stands between the two points, else the product of the panes'
    /// transmittances. Ends are taken as they are: offset them first. The last 1e-5 of the
    /// segment and two offsets there do not count, so that `b` may touch a surface.
    [[nodiscard]] double transmittance(const Point3& a, const Point3& b) const noexcept;

    /// The same for up to packet_size segments at once. Results whose `wanted` bit is 0 are
    /// left alone; their segments are read.
    void transmittance16(std::span<const SightSegment> segments,
                         std::uint32_t wanted,
                         std::span<float> result,
                         RayOrder order = RayOrder::bundled) const noexcept;

    [[nodiscard]] bool has_panes() const noexcept;

    /// How far `p` is from the nearest opaque surface and from the nearest one that is not the
    /// same surface gone on (another plane, turned by more than 20 degrees or shifted). Looks
    /// no farther than `radius`; what is farther counts as `radius`.
    [[nodiscard]] SurfaceDistances find_nearest_surfaces(const Point3& p,
                                                         double radius) const noexcept;

    /// How far `p` is from the nearest opaque surface that is not wholly behind the plane
    /// through `p` with this normal, at most `radius`. @param normal  null: from any surface
    [[nodiscard]] double find_nearest_ahead(const Point3& p,
                                            const UnitVector3* normal,
                                            double radius) const noexcept;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace isolux
