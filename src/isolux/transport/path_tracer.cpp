#include "isolux/transport/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "isolux/sampling/warp.h"
#include "isolux/transport/image_light.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/next_event.h"
#include "isolux/transport/walk_front.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Light of the luminaires at a diffuse surface: straight, and over one randomly chosen chain
/// of imaged mirrors. lx.
Rgb direct_at(const Scene& scene,
              const Emission& emission,
              const MirrorImages& images,
              const Meeting& y,
              NumberSequence& numbers,
              std::uint64_t& rays) {
    const double u_luminaire = numbers.next();
    const double u = numbers.next();
    const double v = numbers.next();
    Rgb e = estimate_next_event(scene, emission, y.at, y.normal, u_luminaire, u, v).illuminance;
    ++rays;
    if (images.chains().empty())
        return e;
    const auto [chain, probability] = images.draw_chain(numbers.next());
    if (chain == nullptr)
        return e;
    const double u_l = numbers.next();
    const double u_i = numbers.next();
    const double v_i = numbers.next();
    const TowardsSample sample =
        emission.sample_towards(image_of(images, *chain, y.at), u_l, u_i, v_i);
    if (!(sample.density > 0.0))
        return e;
    const ImageLight light = trace_image(scene, emission, images, *chain, y.at, sample, rays);
    const double cosine = std::max(0.0, dot(y.normal, light.arrival));
    if (light.strength > 0.0)
        e += (light.strength * cosine / (probability * sample.density))
             * emission.colour(sample.from.luminaire);
    return e;
}

/// Light that a path collects at the surfaces one ray meets, and where the path goes on.
struct Step {
    Rgb luminance;
    std::optional<Meeting> next;
    double passed_on = 0.0; ///< sum over the meetings of what each would pass on

    void collect(const Scene& scene,
                 const Emission& emission,
                 const MirrorImages& images,
                 const Meeting& y,
                 NumberSequence& numbers,
                 std::uint64_t& rays) {
        const Rgb e = direct_at(scene, emission, images, y, numbers, rays);
        luminance += (y.throughput / pi) * (e * y.diffuse);
        const double share = y.throughput * luminance_sum(y.diffuse);
        passed_on += share;
        if (numbers.next() * passed_on < share)
            next = y;
    }
};

/// Walks on from a step until roulette ends the path; returns everything collected.
Rgb walk_on(const Scene& scene,
            const Emission& emission,
            const MirrorImages& images,
            Step step,
            NumberSequence& numbers,
            std::uint64_t& rays) {
    Rgb luminance = step.luminance;
    Rgb throughput = Rgb::grey(1.0);
    while (step.next) {
        const Meeting from = *step.next;
        // One of the surfaces met was drawn in proportion to what it passes on.
        const double share = from.throughput * luminance_sum(from.diffuse) / step.passed_on;
        throughput = (from.throughput / share) * (throughput * from.diffuse);

        // Roulette by what the path still carries.
        const double survival = std::clamp(luminance_sum(throughput), 0.05, 0.999);
        if (numbers.next() >= survival)
            break;
        throughput = (1.0 / survival) * throughput;

        const double u = numbers.next();
        const Vector3 local = sample_cosine_hemisphere(u, numbers.next());
        const UnitVector3 w = UnitVector3::from_unit(make_basis(from.normal).to_world(local));
        step = {};
        const Rgb seen = follow(
            scene,
            emission,
            images,
            {from.at, w, 1.0, 0.0, 0},
            numbers,
            rays,
            [&](const Meeting& y) { step.collect(scene, emission, images, y, numbers, rays); });
        luminance += throughput * (seen + step.luminance);
    }
    return luminance;
}

} // namespace

Rgb trace_reflected(const Scene& scene,
                    const Emission& emission,
                    const MirrorImages& images,
                    const Meeting& y,
                    NumberSequence& numbers,
                    std::uint64_t& rays) {
    Step step;
    step.collect(scene, emission, images, y, numbers, rays);
    return walk_on(scene, emission, images, step, numbers, rays);
}

Rgb trace_indirect(const Scene& scene,
                   const Emission& emission,
                   const MirrorImages& images,
                   const Receiver& receiver,
                   std::size_t samples,
                   std::uint32_t first,
                   const PointRandomness& random,
                   std::uint64_t& rays) {
    const RayPoint point{&receiver, clear_point(scene, receiver), random, samples, first};
    Rgb sum;
    WalkFront front;
    front.start(scene, emission, images, {&point, 1});
    front.add_tracing();
    rays += front.run({{&sum, 1}, nullptr, {}, {}});
    return sum;
}

} // namespace isolux
