#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "isolux/scene/scene.h"

namespace isolux::bench {

/// The same triangles in an Embree scene of their own.
struct BareEmbree {
    explicit BareEmbree(const Scene& of)
        : device(rtcNewDevice(nullptr)), scene(rtcNewScene(device)) {
        const auto& triangles = of.triangles;
        RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
            g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles.size()));
        auto* i = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles.size()));
        for (unsigned n = 0; const auto& t : triangles)
            for (const Point3& p : t.corner) {
                *v++ = static_cast<float>(p.x);
                *v++ = static_cast<float>(p.y);
                *v++ = static_cast<float>(p.z);
                *i++ = n++;
            }
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene, g);
        rtcReleaseGeometry(g);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        rtcCommitScene(scene);
    }

    ~BareEmbree() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    RTCDevice device;
    RTCScene scene;
};

inline void occluded(const BareEmbree& embree, RTCRay& ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(embree.scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree.scene, &context, &ray);
#endif
}

inline void occluded(const BareEmbree& embree, const int* valid, RTCRay16& rays) {
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcOccluded16(valid, embree.scene, &rays, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded16(valid, embree.scene, &context, &rays);
#endif
}

} // namespace isolux::bench
