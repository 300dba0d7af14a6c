#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "isolux/base/vec.h"
#include "isolux/scene/ray_order.h"

namespace isolux {

/// A piece of a straight line: from + t direction for t in [near, far].
struct TracedRay {
    Vector3 from;
    Vector3 direction; ///< any length but zero
    double near = 0.0;
    double far = 1.0;
};

/// Where a ray meets a triangle, as the ray tracer tells it, in float precision: at corner 0 +
/// u (corner 1 - corner 0) + v (corner 2 - corner 0).
struct TracedHit {
    std::uint32_t triangle = 0;
    double u = 0.0;
    double v = 0.0;
    double t = 0.0; ///< in lengths of the ray's direction
};

/// Sixteen rays side by side, already in the ray tracer's own precision.
struct alignas(64) RayPacket {
    static constexpr std::size_t width = 16;
    using Lanes = std::array<float, width>;

    Lanes from_x, from_y, from_z;
    Lanes direction_x, direction_y, direction_z;
    Lanes near, far;

    void set(std::size_t lane, const TracedRay& ray) noexcept {
        from_x[lane] = static_cast<float>(ray.from.x);
        from_y[lane] = static_cast<float>(ray.from.y);
        from_z[lane] = static_cast<float>(ray.from.z);
        direction_x[lane] = static_cast<float>(ray.direction.x);
        direction_y[lane] = static_cast<float>(ray.direction.y);
        direction_z[lane] = static_cast<float>(ray.direction.z);
        near[lane] = static_cast<float>(ray.near);
        far[lane] = static_cast<float>(ray.far);
    }
};

/// Where the rays of a packet meet triangles.
struct alignas(64) PacketHits {
    std::array<std::uint32_t, RayPacket::width> triangle;
    RayPacket::Lanes u, v, t;

    [[nodiscard]] TracedHit operator[](std::size_t lane) const noexcept {
        const double a = std::clamp<double>(u[lane], 0.0, 1.0);
        const double b = std::clamp<double>(v[lane], 0.0, 1.0 - a);
        return {triangle[lane], a, b, static_cast<double>(t[lane])};
    }
};

/// Triangles in a search tree of Embree, watertight ("robust"). Only its source file knows
/// which Embree it is (3.13 or 4), and only there coordinates become float. Safe to query from
/// any number of threads.
class EmbreeScene {
public:
    /// @param corners  three for each triangle; at least one triangle
    /// @throws DeviceError
    explicit EmbreeScene(std::span<const Vector3> corners);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;

    [[nodiscard]] std::optional<TracedHit> find_first_hit(const TracedRay& ray) const noexcept;
    [[nodiscard]] bool is_occluded(const TracedRay& ray) const noexcept;

    /// Bit i is set if ray i is occluded; only rays whose bit in `wanted` is set are traced,
    /// the other lanes may hold anything.
    [[nodiscard]] std::uint32_t
    find_occluded(const RayPacket& rays, std::uint32_t wanted, RayOrder order) const noexcept;

    /// Bit i is set if ray i meets a triangle; then `hits` tells the first one.
    [[nodiscard]] std::uint32_t find_first_hits(const RayPacket& rays,
                                                std::uint32_t wanted,
                                                PacketHits& hits) const noexcept;

    /// Calls `visit` with every triangle whose box meets the sphere about `p` as large as it is
    /// by then, in an order that only the triangles decide; it may be called with others, too.
    /// @param visit  returns how large the sphere is from now on, m; it must not grow. Must not
    /// throw
    void visit_near(const Vector3& p,
                    double radius,
                    const std::function<double(std::uint32_t triangle)>& visit) const noexcept;

private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

} // namespace isolux
