#include "isolux/scene/bare_tracer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "isolux/base/error.h"

namespace isolux {

namespace {

/// Of the segment's length; the rest keeps off the surface at its end.
constexpr float far_end = 0.99998F;

void trace_packet(RTCScene scene, const int* valid, RTCRay16& rays) {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &rays, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid, scene, &context, &rays);
#endif
}

std::vector<RTCRay16> make_packets(std::span<const SightSegment> segments) {
    std::vector<RTCRay16> packets(segments.size() / packet_size);
    for (std::size_t i = 0; i < packets.size() * packet_size; ++i) {
        RTCRay16& p = packets[i / packet_size];
        const std::size_t k = i % packet_size;
        const Vector3 way = segments[i].b - segments[i].a;
        p.org_x[k] = static_cast<float>(segments[i].a.x);
        p.org_y[k] = static_cast<float>(segments[i].a.y);
        p.org_z[k] = static_cast<float>(segments[i].a.z);
        p.dir_x[k] = static_cast<float>(way.x);
        p.dir_y[k] = static_cast<float>(way.y);
        p.dir_z[k] = static_cast<float>(way.z);
        p.tnear[k] = p.time[k] = 0.0F;
        p.tfar[k] = far_end;
        p.mask[k] = ~0U;
        p.id[k] = p.flags[k] = 0;
    }
    return packets;
}

} // namespace

struct BareTracer::Handles {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~Handles() {
        if (scene != nullptr)
            rtcReleaseScene(scene);
        if (device != nullptr)
            rtcReleaseDevice(device);
    }
};

BareTracer::BareTracer(const Scene& of) : handles_(std::make_unique<Handles>()) {
    handles_->device = rtcNewDevice(nullptr);
    if (handles_->device == nullptr)
        throw DeviceError("Embree gives no device");
    handles_->scene = rtcNewScene(handles_->device);
    RTCGeometry g = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t n = of.triangles.size();
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * n));
    auto* i = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), n));
    if (v == nullptr || i == nullptr)
        throw DeviceError("Embree has no memory for the triangles");
    unsigned corner = 0;
    for (const SceneTriangle& t : of.triangles)
        for (const Point3& p : t.corner) {
            *v++ = static_cast<float>(p.x);
            *v++ = static_cast<float>(p.y);
            *v++ = static_cast<float>(p.z);
            *i++ = corner++;
        }
    rtcCommitGeometry(g);
    rtcAttachGeometry(handles_->scene, g);
    rtcReleaseGeometry(g);
    rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(handles_->scene);
}

BareTracer::~BareTracer() = default;

double BareTracer::time_packets(std::span<const SightSegment> segments, int turns) const {
    const std::vector<RTCRay16> packets = make_packets(segments);
    alignas(64) std::array<int, packet_size> valid{};
    valid.fill(-1);
    double best = 1e30;
    for (int turn = 0; turn < turns; ++turn) {
        std::vector<RTCRay16> fresh = packets; // tracing shortens the rays it stops
        const auto start = std::chrono::steady_clock::now();
        for (RTCRay16& p : fresh)
            trace_packet(handles_->scene, valid.data(), p);
        best = std::min(
            best,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

} // namespace isolux
