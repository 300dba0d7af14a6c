#include "isolux/scene/ray_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "isolux/base/check.h"
#include "isolux/scene/blockers.h"
#include "isolux/scene/caster_piece.h"
#include "isolux/scene/embree_scene.h"
#include "isolux/scene/outer_planes.h"

namespace isolux {
namespace {

Point3 middle_of(std::span<const CasterTriangle> triangles) {
    if (triangles.empty())
        return {};
    constexpr double inf = std::numeric_limits<double>::infinity();
    Point3 lower{inf, inf, inf};
    Point3 upper{-inf, -inf, -inf};
    for (const auto& t : triangles)
        for (const auto& p : t.corner) {
            lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
            upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
        }
    return midpoint(lower, upper);
}

/// The ends of METHODS "Ray tracer", eq. (43), for a packet of segments: like
/// end_of(), but in the ray tracer's own precision and four at a time.
void find_ends(RayPacket& p) noexcept {
    const auto larger = [](float a, float b) { return a < b ? b : a; };
    for (std::size_t i = 0; i < RayPacket::width; ++i) {
        const float x = p.direction_x[i];
        const float y = p.direction_y[i];
        const float z = p.direction_z[i];
        const float reach = larger(larger(std::abs(p.from_x[i] + x), std::abs(p.from_y[i] + y)),
                                   std::abs(p.from_z[i] + z));
        const float offset = reach * 0x1p-20F + 1e-5F;
        p.far[i] = (1.0F - 1e-5F) - 2.0F * offset / std::sqrt(x * x + y * y + z * z);
    }
}

/// Whether to build a second search tree without what lies in the outer planes. @param held  so
/// many triangles do
bool is_worth_a_tree(std::size_t triangles, std::size_t held) noexcept {
    constexpr std::size_t small_scene = 100000; // its trees cost little
    constexpr std::size_t one_in = 100;
    return held > 0 && (triangles <= small_scene || held * one_in >= triangles);
}

/// Which ends leave anything of their segment.
std::uint32_t lanes_with_room(const RayPacket& p) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < RayPacket::width; ++i)
        bits |= static_cast<std::uint32_t>(p.far[i] > 0.0F) << i;
    return bits;
}

} // namespace

struct RayCaster::Implementation {
    explicit Implementation(std::span<const CasterTriangle> triangles);

    Point3 centre;
    std::vector<Piece> opaque;
    std::vector<Piece> panes;
    std::vector<std::vector<std::uint32_t>> twins; ///< of opaque pieces
    std::optional<Blockers> all;
    OuterPlanes outer;
    std::optional<Blockers> inner; ///< without what lies in the outer planes, where worth it

    /// What can stand between two points, or between the ends of all rays that are wanted.
    template <class... Ends>
    [[nodiscard]] const Blockers& between(const Ends&... ends) const noexcept {
        return inner && outer.enclose(ends...) ? *inner : *all;
    }

    [[nodiscard]] std::uint32_t
    front_twin(std::uint32_t hit, const Vector3& at, const Vector3& direction) const noexcept {
        if (!opaque[hit].is_shell || dot(opaque[hit].normal, direction) <= 0.0)
            return hit;
        for (const std::uint32_t twin : twins[hit])
            if (is_on(opaque[twin], at, 4.0 * float_offset(at)))
                return twin;
        return hit;
    }

    [[nodiscard]] SurfaceHit make_hit(const Vector3& from,
                                      const Vector3& direction,
                                      const TracedHit& hit,
                                      bool is_pane) const noexcept {
        const Piece* piece = is_pane ? &panes[hit.triangle] : &opaque[hit.triangle];
        Vector3 at = piece->at(hit.u, hit.v);
        if (!is_pane) {
            piece = &opaque[front_twin(hit.triangle, at, direction)];
            at = at - dot(piece->normal, at - piece->a) * Vector3(piece->normal);
        }
        const bool is_front = dot(piece->normal, direction) <= 0.0;
        return {piece->id,
                dot(at - from, direction),
                centre + at,
                is_front ? piece->normal : -piece->normal,
                is_front};
    }
};

RayCaster::Implementation::Implementation(std::span<const CasterTriangle> triangles)
    : centre(middle_of(triangles)) {
    Vector3 reach;
    {
        std::vector<Piece> pieces;
        pieces.reserve(triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            pieces.push_back(make_piece(triangles[i], TriangleId(i), centre));
            (triangles[i].is_pane ? panes : opaque).push_back(pieces.back());
            for (const auto& p : triangles[i].corner) {
                const Vector3 v = p - centre;
                reach = {
                    std::max(reach.x, v.x), std::max(reach.y, v.y), std::max(reach.z, v.z)};
            }
        }
        outer = OuterPlanes(pieces);
    }
    // Those inside first: a pane has one number in both trees.
    const auto is_inner = [this](const Piece& p) { return !outer.hold(p); };
    const auto inner_panes =
        std::span(panes.begin(), std::stable_partition(panes.begin(), panes.end(), is_inner));
    twins = find_twins(opaque, 4.0 * float_offset(reach));
    all.emplace(opaque, panes);
    std::vector<Piece> inner_opaque;
    std::copy_if(opaque.begin(), opaque.end(), std::back_inserter(inner_opaque), is_inner);
    const std::size_t kept = inner_opaque.size() + inner_panes.size();
    if (is_worth_a_tree(triangles.size(), triangles.size() - kept))
        inner.emplace(inner_opaque, inner_panes);
}

RayCaster::RayCaster(std::span<const CasterTriangle> triangles)
    : implementation_(std::make_unique<Implementation>(triangles)) {}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

std::optional<SurfaceHit> RayCaster::find_first_hit(const Point3& origin,
                                                    const UnitVector3& direction,
                                                    double max_distance) const noexcept {
    const auto& self = *implementation_;
    const Vector3 from = origin - self.centre;
    TracedRay ray{from, direction, 0.0, max_distance};
    const auto wall =
        self.all->opaque() ? self.all->opaque()->find_first_hit(ray) : std::nullopt;
    if (wall)
        ray.far = wall->t;
    const bool may_see_pane =
        self.all->may_meet_pane(from, from + ray.far * Vector3(direction));
    auto pane = may_see_pane ? self.all->panes()->find_first_hit(ray) : std::nullopt;
    if (pane && wall && pane->t >= wall->t)
        pane.reset();
    if (!pane && !wall)
        return std::nullopt;
    return self.make_hit(from, direction, pane ? *pane : *wall, pane.has_value());
}

void RayCaster::find_first_hits16(std::span<const SightLine> lines,
                                  std::span<std::optional<SurfaceHit>> hits) const noexcept {
    ISOLUX_EXPECT(lines.size() <= packet_size && hits.size() >= lines.size());
    const auto& self = *implementation_;
    RayPacket packet{};
    for (std::size_t i = 0; i < lines.size(); ++i)
        packet.set(i, {lines[i].eye - self.centre, lines[i].direction, 0.0, 1e30});
    const std::uint32_t wanted = (1U << lines.size()) - 1U;
    PacketHits walls;
    PacketHits panes;
    const std::uint32_t at_walls =
        self.all->opaque() ? self.all->opaque()->find_first_hits(packet, wanted, walls) : 0U;
    std::uint32_t at_panes = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if ((at_walls >> i & 1U) != 0)
            packet.far[i] = walls.t[i];
        const Vector3 from = lines[i].eye - self.centre;
        const Vector3 end = from + static_cast<double>(packet.far[i]) * lines[i].direction;
        at_panes |= self.all->may_meet_pane(from, end) ? 1U << i : 0U;
    }
    if (at_panes != 0)
        at_panes = self.all->panes()->find_first_hits(packet, at_panes, panes);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool is_wall = (at_walls >> i & 1U) != 0;
        const bool is_pane =
            (at_panes >> i & 1U) != 0 && !(is_wall && panes.t[i] >= walls.t[i]);
        hits[i].reset();
        if (is_pane || is_wall)
            hits[i] = self.make_hit(lines[i].eye - self.centre,
                                    lines[i].direction,
                                    is_pane ? panes[i] : walls[i],
                                    is_pane);
    }
}

Point3 RayCaster::offset_point(const Point3& p, const UnitVector3& free_side) const noexcept {
    const double step = float_offset(p - implementation_->centre);
    return p + step * Vector3(free_side);
}

Point3 RayCaster::offset_point(const Point3& p, const Vector3& free_side) const noexcept {
    return offset_point(p, UnitVector3(free_side));
}

double RayCaster::transmittance(const Point3& a, const Point3& b) const noexcept {
    const auto& self = *implementation_;
    const Vector3 from = a - self.centre;
    const Vector3 to = b - self.centre;
    return self.between(from, to).transmittance(from, to);
}

void RayCaster::transmittance16(std::span<const SightSegment> segments,
                                std::uint32_t wanted,
                                std::span<float> result,
                                RayOrder order) const noexcept {
    ISOLUX_EXPECT(segments.size() <= packet_size && result.size() >= segments.size());
    const auto& self = *implementation_;
    if (segments.empty())
        return;
    wanted &= (1U << segments.size()) - 1U;
    RayPacket packet;
    for (std::size_t i = 0; i < packet_size; ++i) {
        const SightSegment& s = segments[std::min(i, segments.size() - 1)];
        packet.set(i, {s.a - self.centre, s.b - s.a, 0.0, 0.0});
        if ((wanted >> i & 1U) != 0)
            result[i] = 1.0F;
    }
    find_ends(packet);
    wanted &= lanes_with_room(packet); // the others are too short for anything to be between
    if (wanted == 0)
        return;
    self.between(packet, wanted)
        .transmittance16(segments, self.centre, packet, wanted, result, order);
}

bool RayCaster::has_panes() const noexcept { return !implementation_->panes.empty(); }

SurfaceDistances RayCaster::find_nearest_surfaces(const Point3& p,
                                                  double radius) const noexcept {
    // Of the triangles near by, the closest that belong to two different planes are kept.
    const auto& self = *implementation_;
    const Vector3 at = p - self.centre;
    SurfaceDistances distances{radius, radius, {}};
    const Piece* nearest = nullptr;
    const auto visit = [&](std::uint32_t triangle) {
        const Piece& piece = self.opaque[triangle];
        const double d = distance_to(piece, at);
        if (nearest != nullptr && continues(*nearest, piece)) {
            distances.nearest = std::min(distances.nearest, d);
        } else if (d < distances.nearest) {
            if (nearest != nullptr)
                distances.second = distances.nearest;
            distances.nearest = d;
            nearest = &piece;
        } else {
            distances.second = std::min(distances.second, d);
        }
        return radius;
    };
    if (self.all->opaque())
        self.all->opaque()->visit_near(at, radius, visit);
    if (nearest != nullptr)
        distances.nearest_normal = nearest->normal;
    return distances;
}

double RayCaster::find_nearest_ahead(const Point3& p,
                                     const UnitVector3* normal,
                                     double radius) const noexcept {
    constexpr double in_the_plane = 1e-4; // m; lower than this nothing sends light worth naming
    const auto& self = *implementation_;
    const Vector3 at = p - self.centre;
    const auto is_ahead = [&](const Piece& piece) {
        if (normal == nullptr)
            return true;
        const double highest =
            dot(*normal, piece.a - at)
            + std::max({0.0, dot(*normal, piece.ab), dot(*normal, piece.ac)});
        return highest > in_the_plane;
    };
    // The ray tracer's floats may cut the sphere a little short.
    const double spare = 1e-4 + 4.0 * float_offset(at);
    double nearest = radius;
    const auto visit = [&](std::uint32_t triangle) {
        const Piece& piece = self.opaque[triangle];
        if (is_ahead(piece))
            nearest = std::min(nearest, distance_to(piece, at));
        return std::min(radius, nearest + spare);
    };
    if (self.all->opaque())
        self.all->opaque()->visit_near(at, radius, visit);
    return nearest;
}

} // namespace isolux
