#include "isolux/transport/bidirectional.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "isolux/sampling/warp.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/recursive_weights.h"
#include "isolux/transport/response.h"
#include "isolux/transport/surface_event.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Roulette by what a surface reflects alone: the same for both directions of a path, as the
/// weights need it.
constexpr double least_survival = 0.05;
constexpr double most_survival = 0.999;

/// An opening's black body lies before it by less than this, m.
constexpr double body_slack = 1e-4;

/// Where a subpath met a diffuse surface.
struct SubpathVertex {
    Point3 at; ///< moved off the surface
    UnitVector3 normal;
    Rgb diffuse;
    Rgb carried;           ///< flux of a light path; response times throughput of a sensor path
    double scatter = 0.0;  ///< probability of going on diffusely
    double cosine = 0.0;   ///< of incidence
    PartialWeights weight; ///< after arrive()
    bool only_mirrors = false; ///< every edge since the receiver went by a mirror

    /// Density of the way back, 1/sr.
    [[nodiscard]] double reverse() const noexcept { return scatter * cosine / pi; }
};

/// A ray of a subpath, before it meets anything.
struct SubpathRay {
    Point3 origin;
    Point3 vertex; ///< the last one, where panes moved the origin on
    UnitVector3 w;
    Rgb carried;
    PartialWeights weight;
    double edge = 0.0;      ///< m since the last vertex, straight through panes
    bool by_mirror = false; ///< the last vertex was a mirror
    /// Mirrors since the receiver, while nothing else was met: MirrorImages::follow.
    std::uint32_t chain = MirrorImages::no_mirror;
    bool met_diffuse = false;
    bool only_mirrors = true;
};

/// Walks a subpath until roulette ends it. `look(ray, hit)` before and `meet(vertex)` at every
/// diffuse surface; `arrive(ray, hit)` adds what only the first edge needs.
template <class Look, class Arrive, class Meet>
void walk(const Scene& scene,
          const MirrorImages& images,
          SubpathRay ray,
          NumberSequence& numbers,
          std::uint64_t& rays,
          Look&& look,
          Arrive&& arrive,
          Meet&& meet) {
    bool is_first = true;
    for (;;) {
        const auto hit = scene.caster.find_first_hit(ray.origin, ray.w);
        ++rays;
        look(ray, hit);
        if (!hit)
            return;
        const double cosine = std::max(0.0, -dot(hit->normal, ray.w));
        const SurfaceEvent event = evaluate_surface(
            scene.material(scene.triangle(hit->triangle).material), hit->is_front, cosine);
        const double diffuse = luminance_sum(event.diffuse);
        const double albedo = diffuse + event.mirror + event.straight;
        if (!(albedo > 0.0) || !(cosine > 0.0))
            return;
        ray.edge += hit->distance;
        const double survival =
            event.is_pane ? albedo : std::clamp(albedo, least_survival, most_survival);
        double pick = numbers.next();
        // A pane that is only passed is no vertex; its transmittance is the chance to pass.
        if (event.is_pane && pick < event.straight) {
            ray.origin = scene.caster.offset_point(hit->position, ray.w);
            continue;
        }
        ray.weight.arrive(ray.edge, cosine);
        if (is_first)
            arrive(ray, *hit);
        is_first = false;
        const Point3 before = scene.caster.offset_point(hit->position, hit->normal);
        const double scatter = survival * diffuse / albedo;
        if (diffuse > 0.0) {
            ray.only_mirrors = ray.only_mirrors && ray.by_mirror;
            meet(SubpathVertex{before,
                               hit->normal,
                               event.diffuse,
                               ray.carried,
                               scatter,
                               cosine,
                               ray.weight,
                               ray.only_mirrors});
        }
        if (pick >= survival)
            return;
        pick *= albedo / survival;
        ray.edge = 0.0;
        ray.origin = ray.vertex = before;
        if (pick < diffuse) {
            const double u = numbers.next();
            const Vector3 local = sample_cosine_hemisphere(u, numbers.next());
            ray.weight.scatter(local.z, scatter * local.z / pi, scatter * cosine / pi);
            ray.carried = (1.0 / scatter) * (ray.carried * event.diffuse);
            ray.w = UnitVector3::from_unit(make_basis(hit->normal).to_world(local));
            ray.by_mirror = false;
            ray.met_diffuse = true;
        } else {
            ray.weight.mirror(cosine);
            if (!event.is_pane)
                ray.carried = (albedo / survival) * ray.carried;
            ray.w = reflect(ray.w, hit->normal);
            ray.by_mirror = true;
            if (!ray.met_diffuse)
                ray.chain = images.follow(ray.chain, hit->triangle);
        }
    }
}

double cosine_at_opening(const Emission& emission,
                         const EmissionPoint& from,
                         const Vector3& w) noexcept {
    const Opening& opening = emission.luminaire(from.luminaire).opening;
    if (opening.form == OpeningForm::point)
        return 0.0;
    return std::abs(dot(opening.facets[from.facet].normal, w));
}

/// Everything one pair of subpaths needs.
struct Pair {
    const Scene& scene;
    const Emission& emission;
    const MirrorImages& images;
    const Receiver& receiver;
    Point3 at;
    NumberSequence& numbers;
    std::uint64_t& rays;

    std::vector<SubpathVertex> walk_light() const {
        const double u = numbers.next();
        const double u1 = numbers.next();
        const double u2 = numbers.next();
        const double u3 = numbers.next();
        const EmissionSample start = emission.sample_emission(u, u1, u2, u3, numbers.next());
        const double emit =
            emission.evaluate(start.from, start.direction) / emission.total_flux();
        std::vector<SubpathVertex> vertices;
        if (!(emit > 0.0))
            return vertices;
        SubpathRay ray;
        ray.origin = emission.departure(start.from, start.direction);
        ray.w = start.direction;
        ray.carried = emission.total_flux() * emission.colour(start.from.luminaire);
        ray.weight = start_light_subpath(
            1.0, emit, cosine_at_opening(emission, start.from, start.direction));
        walk(
            scene,
            images,
            ray,
            numbers,
            rays,
            [](const SubpathRay&, const auto&) {},
            [&](SubpathRay& r, const SurfaceHit& hit) {
                // Next-event estimation draws openings as the lit place sees them.
                r.weight.vcm *= emission.pdf_towards(
                    scene.caster.offset_point(hit.position, hit.normal), start.from);
            },
            [&](const SubpathVertex& v) { vertices.push_back(v); });
        return vertices;
    }

    /// A light vertex straight at the receiver.
    [[nodiscard]] Rgb join_receiver(const SubpathVertex& z) const {
        const Vector3 d = z.at - at;
        const double d2 = length_squared(d);
        if (!(d2 > 0.0))
            return {};
        const UnitVector3 w(d);
        const double cosine = -dot(z.normal, w);
        const double response = evaluate_response(receiver, w);
        if (cosine <= 0.0 || !(response > 0.0))
            return {};
        ++rays;
        const double passed = scene.caster.transmittance(at, z.at);
        if (passed <= 0.0)
            return {};
        const double weight = weight_at_receiver(pdf_response(receiver, w) * cosine / d2,
                                                 static_cast<double>(light_paths_per_sample),
                                                 z.weight,
                                                 z.reverse());
        return (weight * passed * response * cosine / (pi * d2)) * (z.carried * z.diffuse);
    }

    /// A light vertex at a sensor vertex.
    [[nodiscard]] Rgb join(const SubpathVertex& z, const SubpathVertex& y) const {
        const Vector3 d = z.at - y.at;
        const double d2 = length_squared(d);
        if (!(d2 > 0.0))
            return {};
        const UnitVector3 w(d);
        const double cos_z = -dot(z.normal, w);
        const double cos_y = dot(y.normal, w);
        if (cos_z <= 0.0 || cos_y <= 0.0)
            return {};
        ++rays;
        const double passed = scene.caster.transmittance(y.at, z.at);
        if (passed <= 0.0)
            return {};
        const double g = cos_z * cos_y / d2;
        const double weight = weight_of_connection(y.scatter * g / pi,
                                                   z.weight,
                                                   z.reverse(),
                                                   z.scatter * g / pi,
                                                   y.weight,
                                                   y.reverse());
        return (weight * passed * g / (pi * pi))
               * ((z.carried * z.diffuse) * (y.carried * y.diffuse));
    }

    /// One luminaire sample at a sensor vertex.
    [[nodiscard]] Rgb next_event(const SubpathVertex& y) const {
        const double u_luminaire = numbers.next();
        const double u = numbers.next();
        const TowardsSample sample =
            emission.sample_towards(y.at, u_luminaire, u, numbers.next());
        if (!(sample.density > 0.0))
            return {};
        const Vector3 d = y.at - sample.from.position;
        const double d2 = length_squared(d);
        if (!(d2 > 0.0))
            return {};
        const UnitVector3 w(d);
        const double cos_y = -dot(y.normal, w);
        const double strength = emission.evaluate(sample.from, w);
        if (cos_y <= 0.0 || !(strength > 0.0))
            return {};
        ++rays;
        const double passed =
            scene.caster.transmittance(emission.departure(sample.from, w), y.at);
        if (passed <= 0.0)
            return {};
        const double cos_l = cosine_at_opening(emission, sample.from, w);
        const double emit = strength / emission.total_flux();
        const double weight =
            weight_of_next_event(y.scatter * cos_y / pi * cos_l / (d2 * sample.density),
                                 emit * cos_y / (d2 * sample.density),
                                 y.weight,
                                 y.reverse());
        return (weight * passed * strength * cos_y / (pi * d2 * sample.density))
               * (emission.colour(sample.from.luminaire) * (y.carried * y.diffuse));
    }

    /// Openings that a ray of the sensor subpath meets: of the receiver's own rays only those
    /// that no one else answers for, behind mirrors.
    [[nodiscard]] Rgb met_openings(const SubpathRay& ray,
                                   const std::optional<SurfaceHit>& hit) const {
        if (!ray.met_diffuse && ray.chain != MirrorImages::no_image)
            return {};
        const double reach = hit ? hit->distance + body_slack : 1e30;
        Rgb sum;
        for (std::size_t l = 0; l < emission.luminaires(); ++l) {
            const auto& facets = emission.luminaire(l).opening.facets;
            for (std::size_t f = 0; f < facets.size(); ++f)
                sum += met_facet(ray, reach, {l, f, {}}, facets[f]);
        }
        return sum;
    }

    [[nodiscard]] Rgb met_facet(const SubpathRay& ray,
                                double reach,
                                EmissionPoint from,
                                const Facet& facet) const {
        const double slope = dot(facet.normal, ray.w);
        if (slope == 0.0)
            return {};
        const double t = dot(facet.normal, facet.vertices[0] - ray.origin) / slope;
        if (t <= 0.0 || t > reach + body_slack / std::abs(slope))
            return {};
        from.position = ray.origin + t * Vector3(ray.w);
        for (std::size_t i = 0; i < facet.vertices.size(); ++i) {
            const Point3& a = facet.vertices[i];
            const Point3& b = facet.vertices[(i + 1) % facet.vertices.size()];
            if (dot(cross(b - a, from.position - a), facet.normal) < 0.0)
                return {};
        }
        const double strength = emission.evaluate(from, -ray.w);
        if (!(strength > 0.0)
            || scene.caster.transmittance(emission.departure(from, -ray.w), ray.origin) <= 0.0)
            return {};
        const double cosine = std::abs(slope);
        PartialWeights there = ray.weight;
        there.arrive(ray.edge + t, cosine);
        // Behind a mirror nobody else could have drawn this point of the opening.
        const double direct = ray.by_mirror ? 0.0 : emission.pdf_towards(ray.vertex, from);
        const double weight =
            weight_of_met_opening(there, direct, strength / emission.total_flux());
        return (weight * strength / cosine) * (emission.colour(from.luminaire) * ray.carried);
    }

    /// Point sources in mirrors, at a vertex that the receiver sees in mirrors only: light that
    /// no two ends of subpaths can join.
    [[nodiscard]] Rgb imaged_points(const SubpathVertex& y) const {
        if (images.chains().empty() || !y.only_mirrors)
            return {};
        const auto [chain, probability] = images.draw_chain(numbers.next());
        if (chain == nullptr)
            return {};
        const double u_luminaire = numbers.next();
        const double u = numbers.next();
        const TowardsSample sample = emission.sample_towards(
            image_of(images, *chain, y.at), u_luminaire, u, numbers.next());
        if (!(sample.density > 0.0)
            || emission.luminaire(sample.from.luminaire).opening.form != OpeningForm::point)
            return {};
        const ImageLight light =
            trace_image(scene, emission, images, *chain, y.at, sample, rays);
        const double cosine = std::max(0.0, dot(y.normal, light.arrival));
        if (!(light.strength > 0.0))
            return {};
        return (light.strength * cosine / (pi * probability * sample.density))
               * (emission.colour(sample.from.luminaire) * (y.carried * y.diffuse));
    }
};

Rgb trace_pair(const Pair& pair) {
    Rgb sum;
    std::vector<SubpathVertex> light;
    for (std::size_t i = 0; i < light_paths_per_sample; ++i) {
        std::vector<SubpathVertex> own = pair.walk_light();
        Rgb seen;
        for (const SubpathVertex& z : own)
            seen += pair.join_receiver(z);
        sum += (1.0 / static_cast<double>(light_paths_per_sample)) * seen;
        if (i == 0)
            light = std::move(own);
    }
    const double u = pair.numbers.next();
    const UnitVector3 w = sample_response(pair.receiver, u, pair.numbers.next());
    const double pdf = pdf_response(pair.receiver, w);
    const double response = evaluate_response(pair.receiver, w);
    if (!(pdf > 0.0) || !(response > 0.0))
        return sum;
    SubpathRay ray;
    ray.origin = pair.at;
    ray.w = w;
    ray.carried = Rgb::grey(response / pdf);
    ray.weight = start_sensor_subpath(static_cast<double>(light_paths_per_sample), pdf);
    walk(
        pair.scene,
        pair.images,
        ray,
        pair.numbers,
        pair.rays,
        [&](const SubpathRay& r, const std::optional<SurfaceHit>& hit) {
            sum += pair.met_openings(r, hit);
        },
        [](const SubpathRay&, const SurfaceHit&) {},
        [&](const SubpathVertex& y) {
            sum += pair.next_event(y) + pair.imaged_points(y);
            for (const SubpathVertex& z : light)
                sum += pair.join(z, y);
        });
    return sum;
}

} // namespace

Rgb trace_bidirectional(const Scene& scene,
                        const Emission& emission,
                        const MirrorImages& images,
                        const Receiver& receiver,
                        std::size_t samples,
                        std::uint32_t first,
                        const PointRandomness& random,
                        std::uint64_t& rays) {
    if (emission.total_flux() <= 0.0)
        return {};
    const Point3 at = clear_point(scene, receiver);
    Rgb sum;
    for (std::uint32_t s = first; s < first + samples; ++s) {
        NumberSequence numbers(random, s);
        sum += trace_pair({scene, emission, images, receiver, at, numbers, rays});
    }
    return (1.0 / static_cast<double>(samples)) * sum;
}

} // namespace isolux
