#include "isolux/transport/eye_path.h"

#include <algorithm>
#include <array>

#include "isolux/transport/follow.h"
#include "isolux/transport/surface_event.h"

namespace isolux {

namespace {

/// A ray that has passed some panes and mirrors. `along` is what seen_openings() needs.
struct EyeBranch {
    Branch along;
    double distance = 0.0; ///< m from the eye to its origin
    std::size_t depth = 0; ///< panes and mirrors so far
};

/// Deeper than certain_splits a chain survives with this probability at most and at least.
constexpr double most_survival = 0.999;
constexpr double least_survival = 0.05;

} // namespace

void follow_eye(const Scene& scene,
                const Emission& emission,
                const SightLine& line,
                NumberSequence& numbers,
                EyePath& path,
                std::uint64_t& rays,
                const std::optional<SurfaceHit>* first) {
    path.luminaires = {};
    path.surfaces.clear();
    path.is_certain = true;
    std::array<EyeBranch, (1U << certain_splits)> waiting;
    std::size_t count = 0;
    waiting[count++] = {{line.eye, line.direction, 1.0, 0.0, 0}, 0.0, 0};
    while (count > 0) {
        EyeBranch ray = waiting[--count];
        for (;;) {
            // Fly: openings on the way shine, the surface at the end may reflect.
            const auto hit = first != nullptr
                                 ? *first
                                 : scene.caster.find_first_hit(ray.along.origin, ray.along.w);
            first = nullptr;
            ++rays;
            const double reach = hit ? hit->distance + 1e-4 : 1e30;
            visit_seen_openings(
                emission, ray.along, reach, [&](std::size_t, const Rgb& luminance) {
                    path.luminaires += ray.along.throughput * luminance;
                });
            if (!hit)
                break;
            const double cosine = std::max(0.0, -dot(hit->normal, ray.along.w));
            const SceneTriangle& triangle = scene.triangle(hit->triangle);
            const SurfaceEvent event =
                evaluate_surface(scene.material(triangle.material), hit->is_front, cosine);
            const Point3 before = scene.caster.offset_point(hit->position, hit->normal);
            ray.distance += hit->distance;
            if (max_channel(event.diffuse) > 0.0)
                path.surfaces.push_back({before,
                                         hit->normal,
                                         event.diffuse,
                                         ray.along.throughput,
                                         ray.distance,
                                         static_cast<std::uint32_t>(ray.along.reflections),
                                         hit->triangle});

            // Go on: both ways, or one of them.
            const double share = event.mirror + event.straight;
            if (share <= 0.0)
                break;
            EyeBranch mirrored = ray;
            mirrored.along.origin = before;
            mirrored.along.w = reflect(ray.along.w, hit->normal);
            mirrored.along.throughput *= event.mirror;
            ++mirrored.along.reflections;
            ++mirrored.depth;
            EyeBranch passed = ray;
            passed.along.origin = scene.caster.offset_point(hit->position, ray.along.w);
            passed.along.throughput *= event.straight;
            ++passed.depth;
            if (ray.depth < certain_splits) {
                const bool is_split = event.mirror > 0.0 && event.straight > 0.0;
                if (is_split)
                    waiting[count++] = mirrored;
                ray = event.straight > 0.0 ? passed : mirrored;
                continue;
            }
            path.is_certain = false;
            const double survival = std::clamp(
                share * std::min(1.0, ray.along.throughput), least_survival, most_survival);
            const double pick = numbers.next();
            if (pick >= survival)
                break;
            const bool goes_through = pick < survival * (event.straight / share);
            ray = goes_through ? passed : mirrored;
            ray.along.throughput *=
                share / (survival * (goes_through ? event.straight : event.mirror));
        }
    }
}

} // namespace isolux
