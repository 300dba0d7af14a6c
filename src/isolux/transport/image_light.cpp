#include "isolux/transport/image_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "isolux/transport/surface_event.h"

namespace isolux {

namespace {

/// Candidates of METHODS eq. (146).
constexpr std::size_t hand_size = 8;

/// Multiples of these, without their whole parts, are spread nearly evenly.
constexpr std::array<double, 3> turns{
    0.6180339887498949, 0.7548776662466927, 0.5698402909980532};

double turned(double u, std::size_t k, double turn) noexcept {
    const double v = u + static_cast<double>(k) * turn;
    return v - std::floor(v);
}

/// Rounding must not take a reflection at a mirror's rim away, m.
constexpr double rim = 1e-3;

struct Arrival {
    UnitVector3 from;
    double strength = 1.0; ///< at most so much of the light is reflected
};

/// Where the light of an emission point arrives from over a chain of mirrors, if it can.
std::optional<Arrival> arrival_by(const MirrorImages& images,
                                  const std::vector<std::uint32_t>& chain,
                                  const Point3& from,
                                  UnitVector3 w,
                                  const Point3& place) noexcept {
    Point3 origin = from;
    double strength = 1.0;
    for (std::size_t i = chain.size(); i-- > 0;) {
        const MirrorImages::Mirror& m = images.mirrors()[chain[i]];
        const double slope = dot(m.normal, w);
        const double away = dot(m.normal, m.point - origin);
        if (!(away * slope > 0.0))
            return std::nullopt;
        origin = origin + (away / slope) * Vector3(w);
        if (!m.box_holds(origin, rim))
            return std::nullopt;
        w = reflect(w, m.normal);
        strength *= m.strength;
    }
    if (dot(w, place - origin) <= 0.0)
        return std::nullopt;
    return Arrival{-w, strength};
}

/// One chain and place on a luminaire, and what they promise.
struct Candidate {
    const std::vector<std::uint32_t>* chain = nullptr;
    TowardsSample sample;
    double odds = 0.0;  ///< q of METHODS eq. (146)
    double light = 0.0; ///< t of METHODS eq. (146), up to a common factor
};

/// A surface that mirrors throw light on.
struct Place {
    const Point3& at;
    const UnitVector3& normal;
};

Candidate draw_candidate(const Emission& emission,
                         const MirrorImages& images,
                         const Place& place,
                         double u_chain,
                         const std::array<double, 3>& u) noexcept {
    const auto [chain, probability] = images.draw_chain(u_chain);
    if (chain == nullptr)
        return {};
    const Point3 image = image_of(images, *chain, place.at);
    const TowardsSample sample = emission.sample_towards(image, u[0], u[1], u[2]);
    const Vector3 whole = image - sample.from.position;
    const double d2 = length_squared(whole);
    if (!(sample.density > 0.0) || !(d2 > 0.0))
        return {};
    const UnitVector3 w(whole);
    const auto arrival = arrival_by(images, *chain, sample.from.position, w, place.at);
    if (!arrival)
        return {};
    const double odds = sample.density * probability;
    const double cosine = std::max(0.0, dot(place.normal, arrival->from));
    return {chain,
            sample,
            odds,
            arrival->strength * emission.evaluate(sample.from, w) * cosine / (d2 * odds)};
}

using Hand = std::array<Candidate, hand_size>;

/// @pre  one of them promises light
const Candidate& choose(const Hand& hand, double rest) noexcept {
    const Candidate* chosen = nullptr;
    for (const Candidate& c : hand) {
        if (!(c.light > 0.0))
            continue;
        chosen = &c;
        if (rest < c.light)
            break;
        rest -= c.light;
    }
    return *chosen;
}

} // namespace

Point3 image_of(const MirrorImages& images,
                const std::vector<std::uint32_t>& chain,
                const Point3& place) noexcept {
    Point3 p = place;
    for (const std::uint32_t m : chain) {
        const MirrorImages::Mirror& mirror = images.mirrors()[m];
        p = p - (2.0 * dot(mirror.normal, p - mirror.point)) * Vector3(mirror.normal);
    }
    return p;
}

ImageLight trace_image(const Scene& scene,
                       const Emission& emission,
                       const MirrorImages& images,
                       const std::vector<std::uint32_t>& chain,
                       const Point3& place,
                       const TowardsSample& sample,
                       std::uint64_t& rays) noexcept {
    ImageLight light;
    light.sample = sample;
    const Vector3 whole = image_of(images, chain, place) - sample.from.position;
    const double d2 = length_squared(whole);
    if (!(d2 > 0.0))
        return light;
    UnitVector3 w(whole);
    double strength = emission.evaluate(sample.from, w) / d2;
    if (!(strength > 0.0))
        return light;
    Point3 origin = emission.departure(sample.from, w);
    // From the luminaire the chain is met from its far end.
    for (std::size_t i = chain.size(); i-- > 0;) {
        for (;;) {
            const auto hit = scene.caster.find_first_hit(origin, w);
            ++rays;
            if (!hit)
                return light;
            const Material& material = scene.material(scene.triangle(hit->triangle).material);
            const SurfaceEvent event =
                evaluate_surface(material, hit->is_front, std::max(0.0, -dot(hit->normal, w)));
            if (images.mirror_of(hit->triangle) == chain[i]) {
                if (event.mirror <= 0.0)
                    return light;
                strength *= event.mirror;
                w = reflect(w, hit->normal);
                origin = scene.caster.offset_point(hit->position, hit->normal);
                break;
            }
            if (event.straight <= 0.0)
                return light;
            strength *= event.straight;
            origin = scene.caster.offset_point(hit->position, w);
        }
    }
    ++rays;
    // The rest must point at the place, else the last mirror was met on the wrong side.
    if (dot(w, place - origin) <= 0.0)
        return light;
    light.arrival = -w;
    light.strength = strength * scene.caster.transmittance(origin, place);
    return light;
}

ImageEvent sample_image_event(const Scene& scene,
                              const Emission& emission,
                              const MirrorImages& images,
                              const Point3& at,
                              const UnitVector3& normal,
                              NumberSequence& numbers,
                              std::uint64_t& rays) noexcept {
    const double u_chain = numbers.next() / images.draws();
    if (u_chain >= 1.0)
        return {};
    const std::array<double, 3> u{numbers.next(), numbers.next(), numbers.next()};
    const double pick = numbers.next();
    Hand hand;
    double sum = 0.0;
    for (std::size_t k = 0; k < hand_size; ++k) {
        const double among =
            (static_cast<double>(k) + u_chain) / static_cast<double>(hand_size);
        hand[k] = draw_candidate(
            emission,
            images,
            {at, normal},
            among * images.draws(),
            {turned(u[0], k, turns[0]), turned(u[1], k, turns[1]), turned(u[2], k, turns[2])});
        sum += hand[k].light;
    }
    if (!(sum > 0.0))
        return {};
    const Candidate& chosen = choose(hand, pick * sum);
    const ImageLight light =
        trace_image(scene, emission, images, *chosen.chain, at, chosen.sample, rays);
    const double cosine = std::max(0.0, dot(normal, light.arrival));
    if (!(light.strength * cosine > 0.0))
        return {};
    const std::size_t luminaire = chosen.sample.from.luminaire;
    const double share = sum / (static_cast<double>(hand_size) * chosen.light * chosen.odds);
    return {(light.strength * cosine * share) * emission.colour(luminaire), luminaire};
}

} // namespace isolux
