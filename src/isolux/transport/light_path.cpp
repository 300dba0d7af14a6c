#include "isolux/transport/light_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/parallel.h"
#include "isolux/sampling/warp.h"
#include "isolux/transport/surface_event.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Roulette never lets a path survive with less than this (METHODS "Roulette").
constexpr double least_survival = 0.05;

/// ... nor more: a path between perfect mirrors ends as well.
constexpr double most_survival = 0.999;

/// Paths one task walks.
constexpr std::size_t paths_per_task = 64;

std::size_t padded(std::size_t n) noexcept {
    return (n + packet_size - 1) / packet_size * packet_size;
}

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
                          std::vector<PathVertex>& vertices) {
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
                : std::clamp(albedo * carried / alpha_1, least_survival, most_survival);

        // Keep the vertex; only its diffuse part connects.
        if (diffuse > 0.0) {
            PathVertex v;
            v.position = scene.caster.offset_point(hit->position, hit->normal);
            v.normal = hit->normal;
            v.radiant = (1.0 / pi) * (alpha * event.diffuse);
            v.continuation = survival * diffuse / albedo;
            v.order = order;
            v.luminaire = static_cast<std::uint32_t>(start.from.luminaire);
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
        } else if (pick < diffuse + event.mirror) {
            w = reflect(w, hit->normal);
            origin = scene.caster.offset_point(hit->position, hit->normal);
            alpha = boost * alpha;
            behind_mirror = true;
            ++order;
        } else {
            origin = scene.caster.offset_point(hit->position, w);
            alpha = boost * alpha;
            passed *= event.straight;
        }
    }
}

VertexCache build_vertex_cache(const Scene& scene,
                               const Emission& emission,
                               const PathRandomness& random,
                               std::uint64_t first,
                               std::size_t count,
                               const EffectiveCounts& counts) {
    VertexCache cache;
    cache.paths = count;
    cache.centre = midpoint(scene.bounds.lower, scene.bounds.upper);
    if (emission.total_flux() <= 0.0 || count == 0)
        return cache;

    // Generate: every task into its own slot, then joined in path order.
    const std::size_t tasks = (count + paths_per_task - 1) / paths_per_task;
    std::vector<std::vector<PathVertex>> slots(tasks);
    std::vector<FluxTally> tallies(tasks);
    for_each_index(tasks, 1, [&](std::size_t t) {
        slots[t].reserve(4 * paths_per_task);
        const std::size_t end = std::min(count, (t + 1) * paths_per_task);
        for (std::size_t i = t * paths_per_task; i < end; ++i) {
            const FluxTally f = walk_light_path(scene, emission, random, first + i, slots[t]);
            tallies[t].absorbed += f.absorbed;
            tallies[t].escaped += f.escaped;
            tallies[t].rays += f.rays;
        }
    });
    for (std::size_t t = 0; t < tasks; ++t) {
        cache.vertices.insert(cache.vertices.end(), slots[t].begin(), slots[t].end());
        cache.flux.absorbed += tallies[t].absorbed;
        cache.flux.escaped += tallies[t].escaped;
        cache.flux.rays += tallies[t].rays;
    }

    const std::size_t n = cache.vertices.size();
    for (std::vector<float>* a : {&cache.x,
                                  &cache.y,
                                  &cache.z,
                                  &cache.nx,
                                  &cache.ny,
                                  &cache.nz,
                                  &cache.strength,
                                  &cache.density})
        a->assign(padded(n), 0.0F);
    for (std::size_t i = 0; i < n; ++i) {
        const PathVertex& v = cache.vertices[i];
        const Vector3 p = v.position - cache.centre;
        const double scale = v.is_first ? counts.paths / counts.gather_first
                                        : counts.vertices / counts.gather_later;
        cache.x[i] = static_cast<float>(p.x);
        cache.y[i] = static_cast<float>(p.y);
        cache.z[i] = static_cast<float>(p.z);
        cache.nx[i] = static_cast<float>(v.normal.x());
        cache.ny[i] = static_cast<float>(v.normal.y());
        cache.nz[i] = static_cast<float>(v.normal.z());
        cache.strength[i] = static_cast<float>(luminance_sum(v.radiant));
        cache.density[i] = static_cast<float>(std::min(1e30, v.density * scale));
    }
    return cache;
}

} // namespace isolux
