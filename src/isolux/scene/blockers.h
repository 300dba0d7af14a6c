#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "isolux/scene/caster_piece.h"
#include "isolux/scene/embree_scene.h"
#include "isolux/scene/ray_caster.h"

namespace isolux {

/// The last parameter of the segment from a to `to` that counts, METHODS eq. (43).
[[nodiscard]] inline double end_of(const Vector3& to, double length_of_segment) noexcept {
    return 1.0 - 1e-5 - 2.0 * float_offset(to) / length_of_segment;
}

/// What can stand between two points: opaque triangles in one search tree, panes in another.
/// Coordinates are relative to the caster's centre.
class Blockers {
public:
    /// @param panes  must live as long as this
    Blockers(std::span<const Piece> opaque, std::span<const Piece> panes);

    /// Opaque triangles and panes by their place in what was given; none without any.
    [[nodiscard]] const std::optional<EmbreeScene>& opaque() const noexcept { return opaque_; }

    [[nodiscard]] const std::optional<EmbreeScene>& panes() const noexcept { return panes_; }

    /// False is certain: no pane meets the segment.
    [[nodiscard]] bool may_meet_pane(const Vector3& p, const Vector3& q) const noexcept {
        return panes_.has_value() && box_.may_meet(p, q);
    }

    /// See RayCaster.
    [[nodiscard]] double transmittance(const Vector3& from, const Vector3& to) const noexcept;

    /// The same for `wanted` segments of a packet; their results are 1 before.
    /// @param rays  the segments, relative to `centre`, with their ends; may be changed
    void transmittance16(std::span<const SightSegment> segments,
                         const Point3& centre,
                         RayPacket& rays,
                         std::uint32_t wanted,
                         std::span<float> result,
                         RayOrder order) const noexcept;

private:
    [[nodiscard]] double
    dim(std::uint32_t pane, const Vector3& way, double distance) const noexcept;
    [[nodiscard]] double pass_panes(const Vector3& from, const Vector3& to) const noexcept;
    void pass_panes16(std::span<const SightSegment> segments,
                      const Point3& centre,
                      RayPacket& rays,
                      std::uint32_t wanted,
                      std::span<float> result) const noexcept;

    std::span<const Piece> pieces_; ///< the panes
    PaneBox box_;
    std::optional<EmbreeScene> opaque_;
    std::optional<EmbreeScene> panes_;
};

} // namespace isolux
