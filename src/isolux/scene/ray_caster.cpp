#include "isolux/scene/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "isolux/base/check.h"
#include "isolux/base/error.h"
#include "isolux/scene/material.h"

namespace isolux {
namespace {

// ---- the two generations of Embree
// ------------------------------------------------------------ Version 3 wants a context with
// every query, version 4 optional arguments.

#if RTC_VERSION_MAJOR >= 4

void intersect(RTCScene scene, RTCRayHit& ray) noexcept { rtcIntersect1(scene, &ray, nullptr); }

void occluded(RTCScene scene, RTCRay& ray) noexcept { rtcOccluded1(scene, &ray, nullptr); }

void occluded(const int* valid, RTCScene scene, RTCRay8& rays) noexcept {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded8(valid, scene, &rays, &arguments);
}

void occluded(const int* valid, RTCScene scene, RTCRay16& rays) noexcept {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

RTCIntersectContext make_context(RTCIntersectContextFlags flags) noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

void intersect(RTCScene scene, RTCRayHit& ray) noexcept {
    auto context = make_context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcIntersect1(scene, &context, &ray);
}

void occluded(RTCScene scene, RTCRay& ray) noexcept {
    auto context = make_context(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcOccluded1(scene, &context, &ray);
}

void occluded(const int* valid, RTCScene scene, RTCRay8& rays) noexcept {
    auto context = make_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcOccluded8(valid, scene, &context, &rays);
}

void occluded(const int* valid, RTCScene scene, RTCRay16& rays) noexcept {
    auto context = make_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcOccluded16(valid, scene, &context, &rays);
}

#endif

// ---- owners of Embree's handles
// ----------------------------------------------------------------

struct DeviceRelease {
    void operator()(RTCDevice d) const noexcept { rtcReleaseDevice(d); }
};

struct SceneRelease {
    void operator()(RTCScene s) const noexcept { rtcReleaseScene(s); }
};

using DevicePointer = std::unique_ptr<RTCDeviceTy, DeviceRelease>;
using ScenePointer = std::unique_ptr<RTCSceneTy, SceneRelease>;

void throw_on_error(RTCDevice device, const char* doing) {
    const auto error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw DeviceError(std::string("Embree failed while ") + doing + " (error "
                          + std::to_string(static_cast<int>(error)) + ")");
}

DevicePointer make_device() {
    DevicePointer device(rtcNewDevice(nullptr));
    if (!device)
        throw_on_error(nullptr, "starting");
    return device;
}

// ---- geometry
// ----------------------------------------------------------------------------------

/// A triangle in double precision, relative to the caster's centre.
struct Piece {
    Vector3 a;
    Vector3 ab;
    Vector3 ac;
    UnitVector3 normal;
    TriangleId id;
    bool is_shell = false;
    ClearPane pane; ///< panes only

    [[nodiscard]] Vector3 at(double u, double v) const noexcept { return a + u * ab + v * ac; }
};

Piece make_piece(const CasterTriangle& t, TriangleId id, const Point3& centre) {
    const Vector3 ab = t.corner[1] - t.corner[0];
    const Vector3 ac = t.corner[2] - t.corner[0];
    return {t.corner[0] - centre,
            ab,
            ac,
            UnitVector3(cross(ab, ac)),
            id,
            t.is_shell && !t.is_pane,
            {t.refractive_index, t.internal_transmittance}};
}

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

ScenePointer build(RTCDevice device, const std::vector<Piece>& pieces) {
    ScenePointer scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    if (!pieces.empty()) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                                     RTC_BUFFER_TYPE_VERTEX,
                                                                     0,
                                                                     RTC_FORMAT_FLOAT3,
                                                                     3 * sizeof(float),
                                                                     3 * pieces.size()));
        auto* indices =
            static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry,
                                                                RTC_BUFFER_TYPE_INDEX,
                                                                0,
                                                                RTC_FORMAT_UINT3,
                                                                3 * sizeof(std::uint32_t),
                                                                pieces.size()));
        throw_on_error(device, "taking the triangles");
        for (std::uint32_t i = 0; const auto& piece : pieces)
            for (const auto& p : {piece.a, piece.a + piece.ab, piece.a + piece.ac}) {
                *vertices++ = static_cast<float>(p.x);
                *vertices++ = static_cast<float>(p.y);
                *vertices++ = static_cast<float>(p.z);
                *indices++ = i++;
            }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene.get());
    throw_on_error(device, "building the search tree");
    return scene;
}

RTCRay make_ray(const Vector3& from, const Vector3& direction, double near, double far) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x);
    ray.org_y = static_cast<float>(from.y);
    ray.org_z = static_cast<float>(from.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = static_cast<float>(near);
    ray.tfar = static_cast<float>(far);
    ray.mask = ~0U;
    return ray;
}

/// A hit as Embree tells it: which piece, where on it, how far in units of the direction.
struct RawHit {
    std::uint32_t piece = 0;
    double u = 0.0;
    double v = 0.0;
    double t = 0.0;
};

std::optional<RawHit> first_hit(RTCScene scene, const RTCRay& ray) noexcept {
    RTCRayHit query{};
    query.ray = ray;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    const double u = std::clamp<double>(query.hit.u, 0.0, 1.0);
    const double v = std::clamp<double>(query.hit.v, 0.0, 1.0 - u);
    return RawHit{query.hit.primID, u, v, query.ray.tfar};
}

// ---- rooms that touch
// --------------------------------------------------------------------------

/// True if `p`, a point of the plane of `piece`, lies on the triangle or within `reach` (m) of
/// it, and the plane within `reach` of `p`.
bool is_on(const Piece& piece, const Vector3& p, double reach) noexcept {
    const Vector3 ap = p - piece.a;
    if (std::abs(dot(piece.normal, ap)) > reach)
        return false;
    const Vector3 corner[] = {piece.a, piece.a + piece.ab, piece.a + piece.ac};
    for (int i = 0; i < 3; ++i) {
        const Vector3 edge = corner[(i + 1) % 3] - corner[i];
        const double outside = -dot(cross(piece.normal, edge), p - corner[i]);
        if (outside > reach * length(edge))
            return false;
    }
    return true;
}

bool boxes_overlap(const Piece& p, const Piece& q, double reach) noexcept {
    const auto apart =
        [reach](double a0, double a1, double a2, double b0, double b1, double b2) {
            return std::max({a0, a1, a2}) + reach < std::min({b0, b1, b2})
                   || std::max({b0, b1, b2}) + reach < std::min({a0, a1, a2});
        };
    const Vector3 p1 = p.a + p.ab, p2 = p.a + p.ac, q1 = q.a + q.ab, q2 = q.a + q.ac;
    return !apart(p.a.x, p1.x, p2.x, q.a.x, q1.x, q2.x)
           && !apart(p.a.y, p1.y, p2.y, q.a.y, q1.y, q2.y)
           && !apart(p.a.z, p1.z, p2.z, q.a.z, q1.z, q2.z);
}

/// For every shell triangle the shell triangles that lie back to back with it.
std::vector<std::vector<std::uint32_t>> find_twins(const std::vector<Piece>& pieces,
                                                   double reach) {
    constexpr double parallel =
        1e-4; // rad; wider is no longer one plane over the size of a room
    std::vector<std::vector<std::uint32_t>> twins(pieces.size());
    std::vector<std::pair<double, std::uint32_t>> by_plane; // distance of the plane, piece
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        if (pieces[i].is_shell)
            by_plane.emplace_back(std::abs(dot(pieces[i].normal, pieces[i].a)), i);
    std::sort(by_plane.begin(), by_plane.end());
    for (std::size_t i = 0; i < by_plane.size(); ++i)
        for (std::size_t j = i + 1;
             j < by_plane.size() && by_plane[j].first - by_plane[i].first <= 2.0 * reach;
             ++j) {
            const std::uint32_t pi = by_plane[i].second, qi = by_plane[j].second;
            const Piece &p = pieces[pi], &q = pieces[qi];
            if (length(Vector3(p.normal) + Vector3(q.normal)) < parallel
                && std::abs(dot(p.normal, q.a - p.a)) <= 2.0 * reach
                && boxes_overlap(p, q, reach)) {
                twins[pi].push_back(qi);
                twins[qi].push_back(pi);
            }
        }
    return twins;
}

/// Distance in metres from `p` to the nearest point of a triangle: over its inside the distance
/// to the plane, elsewhere that to the nearest edge.
double distance_to(const Piece& piece, const Vector3& p) noexcept {
    if (is_on(piece, p - dot(piece.normal, p - piece.a) * Vector3(piece.normal), 0.0))
        return std::abs(dot(piece.normal, p - piece.a));
    const Vector3 corner[] = {piece.a, piece.a + piece.ab, piece.a + piece.ac};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const Vector3 edge = corner[(i + 1) % 3] - corner[i];
        const double along =
            length_squared(edge) > 0.0 ? dot(p - corner[i], edge) / length_squared(edge) : 0.0;
        least = std::min(least, length(p - (corner[i] + std::clamp(along, 0.0, 1.0) * edge)));
    }
    return least;
}

/// Whether two triangles are parts of one surface as far as light is concerned: hardly turned
/// against each other, and neither in front of the other.
bool continues(const Piece& p, const Piece& q) noexcept {
    constexpr double cos_20_degrees = 0.9397;
    if (std::abs(dot(p.normal, q.normal)) < cos_20_degrees)
        return false;
    const double size = std::max(length(p.ab), length(p.ac)) + length(q.a - p.a);
    return std::abs(dot(p.normal, q.a - p.a)) <= 0.35 * length(q.a - p.a) + 1e-9 * size
           && std::abs(dot(q.normal, p.a - q.a)) <= 0.35 * length(q.a - p.a) + 1e-9 * size;
}

} // namespace

// ---- the caster
// --------------------------------------------------------------------------------

struct RayCaster::Implementation {
    explicit Implementation(std::span<const CasterTriangle> triangles);

    Point3 centre;
    std::vector<Piece> opaque;
    std::vector<Piece> panes;
    std::vector<std::vector<std::uint32_t>> twins; ///< of opaque pieces
    DevicePointer device;
    ScenePointer opaque_scene;
    ScenePointer pane_scene;
    bool has_wide_packets = false;

    /// The float-safe step off a surface, methods 8: 1e-5 m plus a few float steps at `p`.
    [[nodiscard]] static double offset_at(const Vector3& p) noexcept {
        return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) * 0x1p-20 + 1e-5;
    }

    /// The segment's last parameter that counts: all but the last 1e-5 and two offsets.
    [[nodiscard]] static double end_of(const Vector3& to, double length_of_segment) noexcept {
        return 1.0 - 1e-5 - 2.0 * offset_at(to) / length_of_segment;
    }

    [[nodiscard]] std::uint32_t
    front_twin(std::uint32_t hit, const Vector3& at, const Vector3& direction) const noexcept {
        if (!opaque[hit].is_shell || dot(opaque[hit].normal, direction) <= 0.0)
            return hit;
        for (const std::uint32_t twin : twins[hit])
            if (is_on(opaque[twin], at, 4.0 * offset_at(at)))
                return twin;
        return hit;
    }

    [[nodiscard]] double pass_panes(const Vector3& from, const Vector3& to) const noexcept;

    template <class Packet, std::size_t Width>
    void occlude(std::span<const SightSegment> segments,
                 std::uint32_t wanted,
                 std::span<float> result) const noexcept;
};

RayCaster::Implementation::Implementation(std::span<const CasterTriangle> triangles)
    : centre(middle_of(triangles)), device(make_device()) {
    Vector3 reach;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Piece piece = make_piece(triangles[i], TriangleId(i), centre);
        (triangles[i].is_pane ? panes : opaque).push_back(piece);
        for (const auto& p : triangles[i].corner) {
            const Vector3 v = p - centre;
            reach = {std::max(reach.x, v.x), std::max(reach.y, v.y), std::max(reach.z, v.z)};
        }
    }
    twins = find_twins(opaque, 4.0 * offset_at(reach));
    opaque_scene = build(device.get(), opaque);
    pane_scene = build(device.get(), panes);
    has_wide_packets =
        rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
}

/// Walks from pane to pane. Panes closer together than two offsets count as one, so that the
/// seam between the two triangles of a pane does not dim the light twice.
double RayCaster::Implementation::pass_panes(const Vector3& from,
                                             const Vector3& to) const noexcept {
    const Vector3 way = to - from;
    const double distance = length(way);
    const double far = end_of(to, distance);
    const double step = 2.0 * std::max(offset_at(from), offset_at(to)) / distance;
    double passed = 1.0;
    for (double near = 0.0; near < far && passed > 0.0;) {
        const auto hit = first_hit(pane_scene.get(), make_ray(from, way, near, far));
        if (!hit)
            break;
        const Piece& piece = panes[hit->piece];
        const double cos_theta = std::abs(dot(piece.normal, way)) / distance;
        passed *= evaluate_slab(piece.pane, cos_theta).transmittance;
        near = hit->t + step;
    }
    return passed;
}

template <class Packet, std::size_t Width>
void RayCaster::Implementation::occlude(std::span<const SightSegment> segments,
                                        std::uint32_t wanted,
                                        std::span<float> result) const noexcept {
    alignas(64) int valid[Width] = {};
    Packet rays{};
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if ((wanted >> i & 1U) == 0)
            continue;
        const Vector3 from = segments[i].a - centre;
        const Vector3 to = segments[i].b - centre;
        const Vector3 way = to - from;
        const double far = end_of(to, length(way));
        result[i] = 1.0F;
        if (!(far > 0.0))
            continue; // too short for anything to stand between
        valid[i] = -1;
        rays.org_x[i] = static_cast<float>(from.x);
        rays.org_y[i] = static_cast<float>(from.y);
        rays.org_z[i] = static_cast<float>(from.z);
        rays.dir_x[i] = static_cast<float>(way.x);
        rays.dir_y[i] = static_cast<float>(way.y);
        rays.dir_z[i] = static_cast<float>(way.z);
        rays.tfar[i] = static_cast<float>(far);
        rays.mask[i] = ~0U;
    }
    occluded(valid, opaque_scene.get(), rays);
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (valid[i] != 0) {
            if (rays.tfar[i] < 0.0F)
                result[i] = 0.0F;
            else if (!panes.empty())
                result[i] = static_cast<float>(
                    pass_panes(segments[i].a - centre, segments[i].b - centre));
        }
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
    RTCRay ray = make_ray(from, direction, 0.0, max_distance);
    const auto wall = first_hit(self.opaque_scene.get(), ray);
    if (wall)
        ray.tfar = static_cast<float>(wall->t);
    auto pane = self.panes.empty() ? std::nullopt : first_hit(self.pane_scene.get(), ray);
    if (pane && wall && pane->t >= wall->t)
        pane.reset();
    if (!pane && !wall)
        return std::nullopt;

    const RawHit& hit = pane ? *pane : *wall;
    const Piece* piece = pane ? &self.panes[hit.piece] : &self.opaque[hit.piece];
    Vector3 at = piece->at(hit.u, hit.v);
    if (!pane) {
        piece = &self.opaque[self.front_twin(hit.piece, at, direction)];
        at = at - dot(piece->normal, at - piece->a) * Vector3(piece->normal);
    }
    const bool is_front = dot(piece->normal, direction) <= 0.0;
    return SurfaceHit{piece->id,
                      dot(at - from, direction),
                      self.centre + at,
                      is_front ? piece->normal : -piece->normal,
                      is_front};
}

Point3 RayCaster::offset_point(const Point3& p, const Vector3& free_side) const noexcept {
    const double step = Implementation::offset_at(p - implementation_->centre);
    return p + step * Vector3(UnitVector3(free_side));
}

double RayCaster::transmittance(const Point3& a, const Point3& b) const noexcept {
    const auto& self = *implementation_;
    const Vector3 from = a - self.centre;
    const Vector3 to = b - self.centre;
    const Vector3 way = to - from;
    const double far = Implementation::end_of(to, length(way));
    if (!(far > 0.0))
        return 1.0; // too short for anything to stand between
    RTCRay ray = make_ray(from, way, 0.0, far);
    occluded(self.opaque_scene.get(), ray);
    if (ray.tfar < 0.0F)
        return 0.0;
    return self.panes.empty() ? 1.0 : self.pass_panes(from, to);
}

void RayCaster::transmittance16(std::span<const SightSegment> segments,
                                std::uint32_t wanted,
                                std::span<float> result) const noexcept {
    ISOLUX_EXPECT(segments.size() <= packet_size && result.size() >= segments.size());
    const auto& self = *implementation_;
    if (self.has_wide_packets) {
        self.occlude<RTCRay16, 16>(segments, wanted, result);
        return;
    }
    for (std::size_t first = 0; first < segments.size(); first += 8)
        self.occlude<RTCRay8, 8>(
            segments.subspan(first, std::min<std::size_t>(8, segments.size() - first)),
            wanted >> first,
            result.subspan(first));
}

bool RayCaster::has_panes() const noexcept { return !implementation_->panes.empty(); }

SurfaceDistances RayCaster::find_nearest_surfaces(const Point3& p,
                                                  double radius) const noexcept {
    // Embree hands over the triangles whose boxes meet the sphere; the closest of them that
    // belong to two different planes are kept.
    struct Search {
        const std::vector<Piece>* pieces;
        Vector3 p;
        double radius;
        double nearest;
        double second;
        const Piece* nearest_piece;
    };

    const auto& self = *implementation_;
    Search search{&self.opaque, p - self.centre, radius, radius, radius, nullptr};
    RTCPointQuery query{};
    query.x = static_cast<float>(search.p.x);
    query.y = static_cast<float>(search.p.y);
    query.z = static_cast<float>(search.p.z);
    query.radius = static_cast<float>(radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const RTCPointQueryFunction visit = [](RTCPointQueryFunctionArguments* arguments) {
        auto& s = *static_cast<Search*>(arguments->userPtr);
        const Piece& piece = (*s.pieces)[arguments->primID];
        const double d = distance_to(piece, s.p);
        if (s.nearest_piece != nullptr && continues(*s.nearest_piece, piece)) {
            if (d < s.nearest)
                s.nearest = d;
        } else if (d < s.nearest) {
            if (s.nearest_piece != nullptr)
                s.second = s.nearest;
            s.nearest = d;
            s.nearest_piece = &piece;
        } else if (d < s.second) {
            s.second = d;
        }
        return false;
    };
    rtcPointQuery(self.opaque_scene.get(), &query, &context, visit, &search);
    return {search.nearest, search.second};
}

} // namespace isolux
