#include "isolux/transport/follow.h"

#include <cmath>

namespace isolux {

namespace {

/// An opening's black body lies before it by less than this, m; the opening shines all the
/// same.
constexpr double grazing_slack = 4e-5;

/// What panes mirror is followed with certainty as long as the panes before left so much of the
/// ray: four of clear glass.
constexpr double clear_enough = 0.7;

} // namespace

void visit_seen_openings(const Emission& emission,
                         const Branch& ray,
                         double reach,
                         const std::function<void(std::size_t, const Rgb&)>& see) {
    for (std::size_t l = 0; l < emission.luminaires(); ++l) {
        if (!emission.is_near_line(l, ray.origin, ray.w))
            continue;
        const Opening& opening = emission.luminaire(l).opening;
        for (std::size_t f = 0; f < opening.facets.size(); ++f) {
            const Facet& facet = opening.facets[f];
            const double slope = dot(facet.normal, ray.w);
            if (slope == 0.0)
                continue;
            const double t = dot(facet.normal, facet.vertices[0] - ray.origin) / slope;
            if (t <= 0.0 || t > reach + grazing_slack / std::abs(slope))
                continue;
            const Point3 p = ray.origin + t * Vector3(ray.w);
            bool inside = true;
            for (std::size_t i = 0; inside && i < facet.vertices.size(); ++i) {
                const Point3& a = facet.vertices[i];
                const Point3& b = facet.vertices[(i + 1) % facet.vertices.size()];
                inside = dot(cross(b - a, p - a), facet.normal) >= 0.0;
            }
            if (!inside)
                continue;
            const double density = emission.evaluate({l, f, p}, -ray.w);
            see(l, (density / std::abs(slope)) * emission.colour(l));
        }
    }
}

std::optional<Meeting> meet_surface(const Scene& scene,
                                    const Branch& ray,
                                    const SurfaceHit& hit,
                                    const SurfaceEvent& event) noexcept {
    if (max_channel(event.diffuse) <= 0.0)
        return std::nullopt;
    return Meeting{scene.caster.offset_point(hit.position, hit.normal),
                   hit.normal,
                   event.diffuse,
                   scene.triangle(hit.triangle).material,
                   std::max(0.0, -dot(hit.normal, ray.w)),
                   ray.throughput,
                   ray.travelled + hit.distance,
                   ray.reflections};
}

Onward go_on(const Scene& scene,
             const MirrorImages& images,
             const Branch& ray,
             const SurfaceHit& hit,
             const SurfaceEvent& event,
             NumberSequence& numbers) noexcept {
    Onward onward;
    if (event.mirror <= 0.0 && event.straight <= 0.0)
        return onward;
    Branch passing{scene.caster.offset_point(hit.position, -hit.normal),
                   ray.w,
                   ray.throughput * event.straight,
                   ray.travelled + hit.distance,
                   ray.reflections,
                   ray.chain};
    Branch mirrored{scene.caster.offset_point(hit.position, hit.normal),
                    reflect(ray.w, hit.normal),
                    ray.throughput * event.mirror,
                    0.0,
                    ray.reflections + 1,
                    images.follow(ray.chain, hit.triangle)};
    bool passes = event.straight > 0.0;
    bool returns = event.mirror > 0.0;
    if (ray.reflections >= certain_reflections) {
        // Long chains play for everything: at most one branch lives on.
        const double lives = std::min(0.999, event.mirror + event.straight);
        const double u = numbers.next();
        const double share = event.mirror / (event.mirror + event.straight);
        returns = u < lives * share;
        passes = !returns && u < lives;
        mirrored.throughput = passing.throughput =
            ray.throughput * (event.mirror + event.straight) / lives;
    } else if (returns && event.is_pane
               && (ray.reflections > 0 || ray.throughput < clear_enough)) {
        const double survival = std::min(0.999, event.mirror);
        returns = numbers.next() < survival;
        mirrored.throughput /= survival;
    }
    // The brighter one first: the first numbers of a sequence are the best.
    if (passes)
        onward.branches[onward.count++] = passing;
    if (returns)
        onward.branches[onward.count++] = mirrored;
    return onward;
}

} // namespace isolux
