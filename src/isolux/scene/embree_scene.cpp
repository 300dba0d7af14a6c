#include "isolux/scene/embree_scene.h"

#include <algorithm>
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

/// Traces up to `Width` rays at once. Embree marks an occluded ray by a negative end.
template <class Packet, std::size_t Width>
std::uint32_t
occluded_bits(RTCScene scene, std::span<const TracedRay> rays, std::uint32_t wanted) noexcept {
    alignas(64) int valid[Width] = {};
    Packet packet{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if ((wanted >> i & 1U) == 0)
            continue;
        valid[i] = -1;
        packet.org_x[i] = static_cast<float>(rays[i].from.x);
        packet.org_y[i] = static_cast<float>(rays[i].from.y);
        packet.org_z[i] = static_cast<float>(rays[i].from.z);
        packet.dir_x[i] = static_cast<float>(rays[i].direction.x);
        packet.dir_y[i] = static_cast<float>(rays[i].direction.y);
        packet.dir_z[i] = static_cast<float>(rays[i].direction.z);
        packet.tnear[i] = static_cast<float>(rays[i].near);
        packet.tfar[i] = static_cast<float>(rays[i].far);
        packet.mask[i] = ~0U;
    }
    occluded(valid, scene, packet);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (valid[i] != 0 && packet.tfar[i] < 0.0F)
            bits |= 1U << i;
    return bits;
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

std::uint32_t EmbreeScene::find_occluded(std::span<const TracedRay> rays,
                                         std::uint32_t wanted) const noexcept {
    ISOLUX_EXPECT(rays.size() <= packet_width);
    const RTCScene scene = handles_->scene.get();
    if (handles_->has_wide_packets)
        return occluded_bits<RTCRay16, 16>(scene, rays, wanted);
    const std::size_t half = std::min<std::size_t>(8, rays.size());
    const std::uint32_t low = occluded_bits<RTCRay8, 8>(scene, rays.first(half), wanted);
    return half == rays.size()
               ? low
               : low | occluded_bits<RTCRay8, 8>(scene, rays.subspan(half), wanted >> 8) << 8;
}

void EmbreeScene::visit_near(
    const Vector3& p,
    double radius,
    const std::function<void(std::uint32_t triangle)>& visit) const noexcept {
    RTCPointQuery query{};
    query.x = static_cast<float>(p.x);
    query.y = static_cast<float>(p.y);
    query.z = static_cast<float>(p.z);
    query.radius = static_cast<float>(radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    const RTCPointQueryFunction call = [](RTCPointQueryFunctionArguments* arguments) {
        const auto& f =
            *static_cast<const std::function<void(std::uint32_t)>*>(arguments->userPtr);
        f(arguments->primID);
        return false; // the sphere stays as large as it is
    };
    auto function = visit;
    rtcPointQuery(handles_->scene.get(), &query, &context, call, &function);
}

} // namespace isolux
