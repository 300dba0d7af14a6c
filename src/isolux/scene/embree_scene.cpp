#include "isolux/scene/embree_scene.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "isolux/base/check.h"
#include "isolux/base/error.h"

namespace isolux {
namespace {

// The two generations of Embree: version 3 wants a context with every query, version 4 takes
// optional arguments.

#if RTC_VERSION_MAJOR >= 4

void intersect(RTCScene scene, RTCRayHit& ray) noexcept { rtcIntersect1(scene, &ray, nullptr); }

void occluded(RTCScene scene, RTCRay& ray) noexcept { rtcOccluded1(scene, &ray, nullptr); }

// Sixteen rays at once, or twice eight where the machine has no registers for more.

RTCRayQueryFlags flags_of(RayOrder order) noexcept {
    return order == RayOrder::bundled ? RTC_RAY_QUERY_FLAG_COHERENT
                                      : RTC_RAY_QUERY_FLAG_INCOHERENT;
}

void occluded(const int* valid, RTCScene scene, RTCRay8& rays, RayOrder order) noexcept {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = flags_of(order);
    rtcOccluded8(valid, scene, &rays, &arguments);
}

void occluded(const int* valid, RTCScene scene, RTCRay16& rays, RayOrder order) noexcept {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = flags_of(order);
    rtcOccluded16(valid, scene, &rays, &arguments);
}

void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) noexcept {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &rays, &arguments);
}

void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) noexcept {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &arguments);
}

#else

RTCIntersectContextFlags flags_of(RayOrder order) noexcept {
    return order == RayOrder::bundled ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                      : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
}

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

void occluded(const int* valid, RTCScene scene, RTCRay8& rays, RayOrder order) noexcept {
    auto context = make_context(flags_of(order));
    rtcOccluded8(valid, scene, &context, &rays);
}

void occluded(const int* valid, RTCScene scene, RTCRay16& rays, RayOrder order) noexcept {
    auto context = make_context(flags_of(order));
    rtcOccluded16(valid, scene, &context, &rays);
}

void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) noexcept {
    auto context = make_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect8(valid, scene, &context, &rays);
}

void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) noexcept {
    auto context = make_context(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    rtcIntersect16(valid, scene, &context, &rays);
}

#endif

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

ScenePointer build(RTCDevice device, std::span<const Vector3> corners) {
    ScenePointer scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry,
                                                                 RTC_BUFFER_TYPE_VERTEX,
                                                                 0,
                                                                 RTC_FORMAT_FLOAT3,
                                                                 3 * sizeof(float),
                                                                 corners.size()));
    auto* indices =
        static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(geometry,
                                                            RTC_BUFFER_TYPE_INDEX,
                                                            0,
                                                            RTC_FORMAT_UINT3,
                                                            3 * sizeof(std::uint32_t),
                                                            corners.size() / 3));
    throw_on_error(device, "taking the triangles");
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
        *vertices++ = static_cast<float>(corners[i].x);
        *vertices++ = static_cast<float>(corners[i].y);
        *vertices++ = static_cast<float>(corners[i].z);
        *indices++ = i;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    throw_on_error(device, "building the search tree");
    return scene;
}

RTCRay to_embree(const TracedRay& r) noexcept {
    RTCRay ray{};
    ray.org_x = static_cast<float>(r.from.x);
    ray.org_y = static_cast<float>(r.from.y);
    ray.org_z = static_cast<float>(r.from.z);
    ray.dir_x = static_cast<float>(r.direction.x);
    ray.dir_y = static_cast<float>(r.direction.y);
    ray.dir_z = static_cast<float>(r.direction.z);
    ray.tnear = static_cast<float>(r.near);
    ray.tfar = static_cast<float>(r.far);
    ray.mask = ~0U;
    return ray;
}

/// Lanes [first, first + Width) of a packet as Embree wants them.
template <std::size_t Width, class Rays>
void to_embree(const RayPacket& from, std::size_t first, Rays& rays) noexcept {
    const auto copy = [first](const RayPacket::Lanes& lanes, float* to) {
        std::memcpy(to, lanes.data() + first, Width * sizeof(float)); // std::copy_n is a call
    };
    copy(from.from_x, rays.org_x);
    copy(from.from_y, rays.org_y);
    copy(from.from_z, rays.org_z);
    copy(from.direction_x, rays.dir_x);
    copy(from.direction_y, rays.dir_y);
    copy(from.direction_z, rays.dir_z);
    copy(from.near, rays.tnear);
    copy(from.far, rays.tfar);
    std::fill_n(rays.time, Width, 0.0F);
    std::fill_n(rays.mask, Width, ~0U);
    std::fill_n(rays.flags, Width, 0U);
}

template <std::size_t Width> struct ValidLanes {
    alignas(64) std::array<int, Width> lanes;

    explicit ValidLanes(std::uint32_t wanted) noexcept {
        for (std::size_t i = 0; i < Width; ++i)
            lanes[i] = -static_cast<int>(wanted >> i & 1U);
    }
};

/// Embree marks an occluded ray by a negative end.
template <std::size_t Width, class Rays>
std::uint32_t occluded_bits(RTCScene scene,
                            const RayPacket& packet,
                            std::size_t first,
                            std::uint32_t wanted,
                            RayOrder order) noexcept {
    const ValidLanes<Width> valid(wanted);
    Rays rays;
    to_embree<Width>(packet, first, rays);
    occluded(valid.lanes.data(), scene, rays, order);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < Width; ++i)
        bits |= static_cast<std::uint32_t>(rays.tfar[i] < 0.0F) << i;
    return bits & wanted;
}

template <std::size_t Width, class Rays>
std::uint32_t hit_bits(RTCScene scene,
                       const RayPacket& packet,
                       std::size_t first,
                       std::uint32_t wanted,
                       PacketHits& hits) noexcept {
    const ValidLanes<Width> valid(wanted);
    Rays query;
    to_embree<Width>(packet, first, query.ray);
    std::fill_n(query.hit.geomID, Width, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], Width, RTC_INVALID_GEOMETRY_ID);
    intersect(valid.lanes.data(), scene, query);
    std::copy_n(query.hit.primID, Width, hits.triangle.data() + first);
    std::copy_n(query.hit.u, Width, hits.u.data() + first);
    std::copy_n(query.hit.v, Width, hits.v.data() + first);
    std::copy_n(query.ray.tfar, Width, hits.t.data() + first);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < Width; ++i)
        bits |= static_cast<std::uint32_t>(query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) << i;
    return bits & wanted;
}

} // namespace

struct EmbreeScene::Handles {
    DevicePointer device;
    ScenePointer scene;
    bool has_wide_packets = false;
};

EmbreeScene::EmbreeScene(std::span<const Vector3> corners)
    : handles_(std::make_unique<Handles>()) {
    ISOLUX_EXPECT(!corners.empty() && corners.size() % 3 == 0);
    handles_->device = make_device();
    handles_->scene = build(handles_->device.get(), corners);
    handles_->has_wide_packets =
        rtcGetDeviceProperty(handles_->device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)
        != 0;
}

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

std::optional<TracedHit> EmbreeScene::find_first_hit(const TracedRay& ray) const noexcept {
    RTCRayHit query{};
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(handles_->scene.get(), query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return std::nullopt;
    const double u = std::clamp<double>(query.hit.u, 0.0, 1.0);
    const double v = std::clamp<double>(query.hit.v, 0.0, 1.0 - u);
    return TracedHit{query.hit.primID, u, v, query.ray.tfar};
}

bool EmbreeScene::is_occluded(const TracedRay& ray) const noexcept {
    RTCRay query = to_embree(ray);
    occluded(handles_->scene.get(), query);
    return query.tfar < 0.0F;
}

std::uint32_t EmbreeScene::find_occluded(const RayPacket& rays,
                                         std::uint32_t wanted,
                                         RayOrder order) const noexcept {
    const RTCScene scene = handles_->scene.get();
    if (handles_->has_wide_packets)
        return occluded_bits<16, RTCRay16>(scene, rays, 0, wanted, order);
    std::uint32_t bits = 0;
    for (const std::size_t first : {0U, 8U})
        if (const std::uint32_t half = wanted >> first & 0xffU)
            bits |= occluded_bits<8, RTCRay8>(scene, rays, first, half, order) << first;
    return bits;
}

std::uint32_t EmbreeScene::find_first_hits(const RayPacket& rays,
                                           std::uint32_t wanted,
                                           PacketHits& hits) const noexcept {
    const RTCScene scene = handles_->scene.get();
    if (handles_->has_wide_packets)
        return hit_bits<16, RTCRayHit16>(scene, rays, 0, wanted, hits);
    std::uint32_t bits = 0;
    for (const std::size_t first : {0U, 8U})
        if (const std::uint32_t half = wanted >> first & 0xffU)
            bits |= hit_bits<8, RTCRayHit8>(scene, rays, first, half, hits) << first;
    return bits;
}

void EmbreeScene::visit_near(
    const Vector3& p,
    double radius,
    const std::function<double(std::uint32_t triangle)>& visit) const noexcept {
    RTCPointQuery query{};
    query.x = static_cast<float>(p.x);
    query.y = static_cast<float>(p.y);
    query.z = static_cast<float>(p.z);
    query.radius = static_cast<float>(radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const RTCPointQueryFunction call = [](RTCPointQueryFunctionArguments* arguments) {
        const auto& f =
            *static_cast<const std::function<double(std::uint32_t)>*>(arguments->userPtr);
        const auto left = static_cast<float>(f(arguments->primID));
        const bool shrinks = left < arguments->query->radius;
        if (shrinks)
            arguments->query->radius = left;
        return shrinks;
    };
    auto function = visit;
    rtcPointQuery(handles_->scene.get(), &query, &context, call, &function);
}

} // namespace isolux
