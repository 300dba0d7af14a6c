#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "isolux/transport/mirror_images.h"
#include "isolux/transport/point_randomness.h"
#include "isolux/transport/surface_event.h"

/// Rays from a receiver through panes and mirrors to the diffuse surfaces behind them.
namespace isolux {

/// Mirror reflections that are followed with certainty, at panes one; longer chains play
/// roulette.
inline constexpr std::size_t certain_reflections = 2;

/// A ray on its way from the receiver, so far only through panes and mirrors.
struct Branch {
    Point3 origin;
    UnitVector3 w;
    double throughput = 1.0;
    double travelled = 0.0; ///< m since the receiver (straight) or the last mirror
    std::size_t reflections = 0;
    std::uint32_t chain = MirrorImages::no_mirror; ///< of mirrors, MirrorImages::follow
};

/// Where a branch met a diffuse surface.
struct Meeting {
    Point3 at; ///< moved off the surface
    UnitVector3 normal;
    Rgb diffuse;
    MaterialId material;
    double cosine = 0.0; ///< between the ray and the normal
    double throughput = 1.0;
    double travelled = 0.0;
    std::size_t reflections = 0;
};

/// Luminance of openings that a mirrored ray passes within `reach` metres, opening by opening:
/// calls `see(luminaire, luminance)`.
void visit_seen_openings(const Emission& emission,
                         const Branch& ray,
                         double reach,
                         const std::function<void(std::size_t, const Rgb&)>& see);

/// Where a branch met a surface, if that can light it by diffuse reflection.
[[nodiscard]] std::optional<Meeting> meet_surface(const Scene& scene,
                                                  const Branch& ray,
                                                  const SurfaceHit& hit,
                                                  const SurfaceEvent& event) noexcept;

/// Where a branch goes on from a surface: nowhere, straight on, by the mirror, or both.
struct Onward {
    std::array<Branch, 2> branches;
    std::size_t count = 0;
};

/// The first mirror reflection is certain, at a pane beside the light that passes, unless many
/// panes came before; the second is played for at panes. From then on at most one of the two
/// goes on.
[[nodiscard]] Onward go_on(const Scene& scene,
                           const MirrorImages& images,
                           const Branch& ray,
                           const SurfaceHit& hit,
                           const SurfaceEvent& event,
                           NumberSequence& numbers) noexcept;

[[nodiscard]] inline SurfaceEvent
surface_event(const Scene& scene, const Branch& ray, const SurfaceHit& hit) noexcept {
    const double cosine = std::max(0.0, -dot(hit.normal, ray.w));
    return evaluate_surface(
        scene.material(scene.triangle(hit.triangle).material), hit.is_front, cosine);
}

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
    std::vector<Branch> waiting{start};
    while (!waiting.empty()) {
        const Branch ray = waiting.back();
        waiting.pop_back();
        const auto hit = scene.caster.find_first_hit(ray.origin, ray.w);
        ++rays;
        if (ray.reflections > 0 && !images.covers(ray.chain))
            visit_seen_openings(emission,
                                ray,
                                hit ? hit->distance + 1e-4 : 1e30,
                                [&](std::size_t, const Rgb& l) { seen += ray.throughput * l; });
        if (!hit)
            continue;
        const SurfaceEvent event = surface_event(scene, ray, *hit);
        if (const auto meeting = meet_surface(scene, ray, *hit, event))
            meet(*meeting);
        const Onward onward = go_on(scene, images, ray, *hit, event, numbers);
        waiting.insert(waiting.end(),
                       onward.branches.begin(),
                       onward.branches.begin() + static_cast<std::ptrdiff_t>(onward.count));
    }
    return seen;
}

} // namespace isolux
