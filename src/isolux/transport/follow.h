#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "isolux/transport/mirror_images.h"
#include "isolux/transport/point_randomness.h"
#include "isolux/transport/surface_event.h"

/// Rays from a receiver through panes and mirrors to the diffuse surfaces behind them.
namespace isolux {

/// Mirror reflections that are followed with certainty; longer chains play roulette.
inline constexpr std::size_t certain_reflections = 2;

/// Branches a gather ray may have waiting at panes and half-mirrors.
inline constexpr std::size_t most_branches = 8;

/// A ray on its way from the receiver, so far only through panes and mirrors.
struct Branch {
    Point3 origin;
    UnitVector3 w;
    double throughput = 1.0;
    double travelled = 0.0; ///< m since the receiver (straight) or the last mirror
    std::size_t reflections = 0;
};

/// Where a branch met a diffuse surface.
struct Meeting {
    Point3 at; ///< moved off the surface
    UnitVector3 normal;
    Rgb diffuse;
    double cosine = 0.0; ///< between the ray and the normal
    double throughput = 1.0;
    double travelled = 0.0;
    std::size_t reflections = 0;
};

/// Luminance of openings that a mirrored ray passes within `reach` metres.
[[nodiscard]] Rgb
seen_openings(const Emission& emission, const Branch& ray, double reach) noexcept;

/// Follows a ray through panes and mirrors and calls `meet` at every diffuse surface it can
/// light the receiver from. Returns the luminance of openings seen in mirrors, weighted like a
/// meeting.
template <class Meet>
Rgb follow(const Scene& scene,
           const Emission& emission,
           const MirrorImages& images,
           const Branch& start,
           NumberSequence& numbers,
           std::uint64_t& rays,
           Meet&& meet) {
    Rgb seen;
    std::array<Branch, most_branches> waiting;
    std::size_t branches = 0;
    waiting[branches++] = start;
    while (branches > 0) {
        Branch ray = waiting[--branches];
        for (;;) {
            const auto hit = scene.caster.find_first_hit(ray.origin, ray.w);
            ++rays;
            if (ray.reflections > 0 && !images.covers(ray.reflections))
                seen += ray.throughput
                        * seen_openings(emission, ray, hit ? hit->distance + 1e-4 : 1e30);
            if (!hit)
                break;
            ray.travelled += hit->distance;
            const double cosine = std::max(0.0, -dot(hit->normal, ray.w));
            const SceneTriangle& triangle = scene.triangle(hit->triangle);
            const SurfaceEvent event =
                evaluate_surface(scene.material(triangle.material), hit->is_front, cosine);
            const Point3 before = scene.caster.offset_point(hit->position, hit->normal);
            if (max_channel(event.diffuse) > 0.0)
                meet(Meeting{before,
                             hit->normal,
                             event.diffuse,
                             cosine,
                             ray.throughput,
                             ray.travelled,
                             ray.reflections});

            // The mirror reflection: certain at first, by roulette later; at panes by roulette.
            Branch mirrored{before,
                            reflect(ray.w, hit->normal),
                            ray.throughput * event.mirror,
                            0.0,
                            ray.reflections + 1};
            bool goes_on = event.mirror > 0.0;
            if (goes_on && (event.is_pane || ray.reflections >= certain_reflections)) {
                const double survival = std::min(0.999, event.mirror);
                goes_on = numbers.next() < survival;
                mirrored.throughput /= survival;
            }
            if (event.straight > 0.0) {
                if (goes_on && branches < most_branches)
                    waiting[branches++] = mirrored;
                ray.origin = scene.caster.offset_point(hit->position, ray.w);
                ray.throughput *= event.straight;
            } else if (goes_on) {
                ray = mirrored;
            } else {
                break;
            }
        }
    }
    return seen;
}

} // namespace isolux
