#include "isolux/scene/blockers.h"

#include <array>
#include <bit>
#include <vector>

#include "isolux/scene/material.h"

namespace isolux {

namespace {

/// Nothing without triangles: then there is nothing to ask, either.
std::optional<EmbreeScene> build(std::span<const Piece> pieces) {
    if (pieces.empty())
        return std::nullopt;
    std::vector<Vector3> corners;
    corners.reserve(3 * pieces.size());
    for (const Piece& p : pieces)
        corners.insert(corners.end(), {p.a, p.a + p.ab, p.a + p.ac});
    return EmbreeScene(corners);
}

} // namespace

Blockers::Blockers(std::span<const Piece> opaque, std::span<const Piece> panes)
    : pieces_(panes), box_(panes), opaque_(build(opaque)), panes_(build(panes)) {}

/// Transmittance of a pane that a segment crosses.
double Blockers::dim(std::uint32_t pane, const Vector3& way, double distance) const noexcept {
    const double cos_theta = std::abs(dot(pieces_[pane].normal, way)) / distance;
    return evaluate_slab(pieces_[pane].pane, cos_theta).transmittance;
}

/// Walks from pane to pane. Panes closer together than two offsets count as one, so that the
/// seam between the two triangles of a pane does not dim the light twice.
double Blockers::pass_panes(const Vector3& from, const Vector3& to) const noexcept {
    const Vector3 way = to - from;
    const double distance = length(way);
    const double far = end_of(to, distance);
    const double step = 2.0 * std::max(float_offset(from), float_offset(to)) / distance;
    double passed = 1.0;
    for (double near = 0.0; near < far && passed > 0.0;) {
        const auto hit = panes_->find_first_hit({from, way, near, far});
        if (!hit)
            break;
        passed *= dim(hit->triangle, way, distance);
        near = hit->t + step;
    }
    return passed;
}

/// The same for a packet: rays go on from pane to pane together until none meets another.
void Blockers::pass_panes16(std::span<const SightSegment> segments,
                            const Point3& centre,
                            RayPacket& rays,
                            std::uint32_t wanted,
                            std::span<float> result) const noexcept {
    std::array<double, packet_size> passed{};
    passed.fill(1.0);
    PacketHits hits;
    for (std::uint32_t going = wanted; going != 0;) {
        going = panes_->find_first_hits(rays, going, hits);
        for (std::uint32_t rest = going; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const Vector3 from = segments[i].a - centre;
            const Vector3 to = segments[i].b - centre;
            const Vector3 way = to - from;
            const double distance = length(way);
            const double step = 2.0 * std::max(float_offset(from), float_offset(to)) / distance;
            passed[i] *= dim(hits.triangle[i], way, distance);
            const double near = static_cast<double>(hits.t[i]) + step;
            rays.near[i] = static_cast<float>(near);
            if (!(near < end_of(to, distance)) || passed[i] <= 0.0)
                going &= ~(1U << i);
        }
    }
    for (std::uint32_t rest = wanted; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        result[i] = static_cast<float>(passed[i]);
    }
}

double Blockers::transmittance(const Vector3& from, const Vector3& to) const noexcept {
    const Vector3 way = to - from;
    const double far = end_of(to, length(way));
    if (!(far > 0.0))
        return 1.0; // too short for anything to stand between
    if (opaque_ && opaque_->is_occluded({from, way, 0.0, far}))
        return 0.0;
    return may_meet_pane(from, to) ? pass_panes(from, to) : 1.0;
}

void Blockers::transmittance16(std::span<const SightSegment> segments,
                               const Point3& centre,
                               RayPacket& rays,
                               std::uint32_t wanted,
                               std::span<float> result,
                               RayOrder order) const noexcept {
    const std::uint32_t occluded = opaque_ ? opaque_->find_occluded(rays, wanted, order) : 0U;
    for (std::uint32_t rest = occluded; rest != 0; rest &= rest - 1)
        result[static_cast<std::size_t>(std::countr_zero(rest))] = 0.0F;
    std::uint32_t near = 0;
    for (std::uint32_t rest = panes_ ? wanted & ~occluded : 0U; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        if (box_.may_meet(segments[i].a - centre, segments[i].b - centre))
            near |= 1U << i;
    }
    if (near != 0)
        pass_panes16(segments, centre, rays, near, result);
}

} // namespace isolux
