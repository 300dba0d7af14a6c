#include "isolux/transport/light_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/sampling/warp.h"
#include "isolux/transport/surface_event.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Density of the first vertex, METHODS eq. (11) for k = 2: that of emitting towards it, over
/// that of finding the same emission point from it; times the cosine over d2 it is an area
/// density.
double first_density(const Emission& emission,
                     const EmissionSample& start,
                     const Point3& vertex,
                     double cos_vertex,
                     double distance) noexcept {
    const double towards = emission.pdf_towards(vertex, start.from);
    if (!(towards > 0.0))
        return 0.0;
    const double emitted =
        emission.evaluate(start.from, start.direction) / emission.total_flux();
    return emitted / towards * cos_vertex / (distance * distance);
}

} // namespace

FluxTally walk_light_path(const Scene& scene,
                          const Emission& emission,
                          const PathRandomness& random,
                          std::uint64_t path,
                          std::vector<PathVertex>& vertices,
                          const Roulette& roulette) {
    using D = PathDimension;
    FluxTally tally;

    // Start: luminaire, place and direction. The flux is that of all luminaires.
    const EmissionSample start = emission.sample_emission(random(path, D::luminaire),
                                                          random(path, D::place),
                                                          random(path, D::place + 1),
                                                          random(path, D::direction),
                                                          random(path, D::direction + 1));
    Rgb alpha = emission.total_flux() * emission.colour(start.from.luminaire);
    const double alpha_1 = luminance_sum(alpha);
    UnitVector3 w = start.direction;
    Point3 origin = emission.departure(start.from, w);

    double continuation = 1.0;  // probability of having gone on diffusely at the last vertex
    double cos_departure = 1.0; // p_w of that vertex times pi, 1 at emission
    double edge = 0.0;          // length since the last vertex, straight through panes
    double passed = 1.0;        // transmittance of the panes in between
    bool is_first = true;       // no vertex yet
    bool behind_mirror = false; // a Dirac reflection since the last vertex
    std::uint32_t order = 1;
    std::uint32_t reflections = 0; // diffuse ones
    std::size_t last = 0;          // vertex of the last of them

    for (std::uint32_t bounce = 0;; ++bounce) {
        // Fly to the next surface.
        const auto hit = scene.caster.find_first_hit(origin, w);
        ++tally.rays;
        if (!hit) {
            tally.escaped += luminance_sum(alpha);
            return tally;
        }
        edge += hit->distance;
        const SceneTriangle& triangle = scene.triangle(hit->triangle);
        const double cos_in = std::max(0.0, -dot(hit->normal, w));
        const SurfaceEvent event =
            evaluate_surface(scene.material(triangle.material), hit->is_front, cos_in);
        const double carried = luminance_sum(alpha);
        const double diffuse = luminance_sum(alpha * event.diffuse) / carried;
        const double albedo = diffuse + event.mirror + event.straight;
        tally.absorbed += carried * (1.0 - albedo);
        if (!(albedo > 0.0))
            return tally;

        // Roulette: panes decide by their own shares, surfaces by what the path would still
        // carry.
        const double survival =
            event.is_pane
                ? albedo
                : std::clamp(albedo * carried / alpha_1, roulette.least, roulette.most);

        // Keep the vertex; only its diffuse part connects.
        if (diffuse > 0.0) {
            PathVertex v;
            v.position = scene.caster.offset_point(hit->position, hit->normal);
            v.normal = hit->normal;
            v.radiant = (1.0 / pi) * (alpha * event.diffuse);
            v.continuation = survival * diffuse / albedo;
            v.order = order;
            v.luminaire = static_cast<std::uint32_t>(start.from.luminaire);
            v.material = triangle.material;
            v.back = reflections == 0 ? 0 : static_cast<std::uint32_t>(vertices.size() - last);
            v.is_first = is_first && !behind_mirror;
            if (behind_mirror)
                v.density = after_mirror;
            else if (is_first)
                v.density =
                    passed * first_density(emission, start, hit->position, cos_in, edge);
            else
                v.density =
                    passed * continuation * (cos_departure / pi) * cos_in / (edge * edge);
            vertices.push_back(v);
        }

        // Go on: which event, if any. What is killed by roulette is absorbed in the mean.
        const std::uint32_t d = D::first_bounce + 3 * bounce;
        double pick = random(path, d + D::event);
        if (pick >= survival)
            return tally;
        pick *= albedo / survival;
        const double boost = albedo / survival;
        if (pick < diffuse) {
            const Vector3 local = sample_cosine_hemisphere(random(path, d + D::scatter),
                                                           random(path, d + D::scatter + 1));
            w = UnitVector3::from_unit(make_basis(hit->normal).to_world(local));
            origin = scene.caster.offset_point(hit->position, hit->normal);
            alpha = (boost / diffuse) * (alpha * event.diffuse);
            continuation = survival * diffuse / albedo;
            cos_departure = local.z;
            edge = 0.0;
            passed = 1.0;
            is_first = false;
            behind_mirror = false;
            ++order;
            ++reflections;
            last = vertices.size() - 1;
        } else if (pick < diffuse + event.mirror) {
            w = reflect(w, hit->normal);
            origin = scene.caster.offset_point(hit->position, hit->normal);
            alpha = boost * alpha;
            behind_mirror = true;
            ++order;
        } else {
            // Across the pane, not along the ray: that could cross a wall the pane ends at.
            origin = scene.caster.offset_point(hit->position, -hit->normal);
            alpha = boost * alpha;
            passed *= event.straight;
        }
    }
}

} // namespace isolux
