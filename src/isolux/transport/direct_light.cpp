#include "isolux/transport/direct_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "isolux/base/polygon.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

/// An opening smaller than the distance by this factor counts as a point: the error of that is
/// below 1 / (4 x 40^2) = 0.016 % (METHODS "Point model").
constexpr double point_like_ratio = 40.0;

constexpr std::size_t pilot_rays = 8; ///< per luminaire, to see whether it is wholly visible
constexpr std::uint32_t unshadowed_samples = 8; ///< per replicate, where no closed form exists
constexpr std::size_t shadowed_samples = 4;     ///< per replicate, in a penumbra
constexpr std::uint32_t pilot_replicate = 0xffffU;

/// Nearer than this to the plane of an opening, or to a point source, m, a receiver takes the
/// place where its rays start: in the plane itself the formulas have no side.
constexpr double least_clearance = 1e-3;

/// Where the light of a luminaire is evaluated: at the receiver itself. (Rays start a little
/// off it, see clear_point; 10 um off, a value 2 m from a point source is wrong by 1e-5.)
Point3 evaluation_point(const Luminaire& l, const Receiver& receiver, const Point3& clear) {
    if (distance(receiver.point, l.placement.world_from_luminaire.origin) < least_clearance)
        return clear;
    for (const Facet& facet : l.opening.facets) {
        const double above = dot(facet.normal, receiver.point - facet.vertices.front());
        if (std::abs(above) < least_clearance)
            return clear;
    }
    return receiver.point;
}

/// One point of an opening looked at from a receiver.
struct Look {
    EmissionPoint from;
    UnitVector3 w;         ///< from the opening to the receiver
    double response = 0.0; ///< R(w) / d2; 0 where the receiver looks away
    Point3 departure;
};

/// A receiver and an opening: what the samples of one luminaire share.
class OpeningLight {
public:
    OpeningLight(const Emission& emission,
                 const Receiver& receiver,
                 const Point3& at,
                 std::size_t l)
        : emission_(emission), receiver_(receiver), at_(at), view_(emission.view(l, at)) {}

    [[nodiscard]] Look look(double u, double v) const noexcept {
        Look k{view_.sample(u, v), {}, 0.0, {}};
        const Vector3 d = at_ - k.from.position;
        const double d2 = length_squared(d);
        if (!(d2 > 0.0))
            return k;
        k.w = UnitVector3(d);
        k.response = evaluate_response(receiver_, -k.w) / d2;
        k.departure = emission_.departure(k.from, k.w);
        return k;
    }

    /// Unshadowed illuminance of the look, over its density, lx.
    [[nodiscard]] double value(const Look& k) const noexcept {
        if (k.response <= 0.0)
            return 0.0;
        const double density = view_.pdf(k.from);
        return density > 0.0 ? emission_.evaluate(k.from, k.w) * k.response / density : 0.0;
    }

private:
    const Emission& emission_;
    const Receiver& receiver_;
    Point3 at_;
    OpeningView view_;
};

/// Whether light of a luminaire on its straight way to the image of a receiver can meet the
/// mirror nearest to the luminaire at all; its box is tried, grown by the size of the opening.
bool may_reflect(const MirrorImages& images,
                 std::uint32_t mirror,
                 const Luminaire& luminaire,
                 const Point3& image) noexcept {
    const MirrorImages::Mirror& m = images.mirrors()[mirror];
    const Point3 from = luminaire.placement.world_from_luminaire.origin;
    const double reach = luminaire.opening.largest_dimension + 1e-3;
    const double above = dot(m.normal, from - m.point);
    const double below = dot(m.normal, image - m.point);
    if (std::abs(above) > reach && above * below > 0.0)
        return false;
    if (std::abs(above - below) < 4.0 * reach)
        return true;
    const Point3 p = from + (above / (above - below)) * (image - from);
    const auto inside = [reach](double v, double lower, double upper) {
        return v >= lower - 2.0 * reach && v <= upper + 2.0 * reach;
    };
    return inside(p.x, m.lower.x, m.upper.x) && inside(p.y, m.lower.y, m.upper.y)
           && inside(p.z, m.lower.z, m.upper.z);
}

} // namespace

/// Which numbers a luminaire's samples take: Sobol' pairs of its own for every replicate.
struct DirectLight::Randomness {
    std::uint64_t seed;
    std::uint64_t receiver;
    std::uint32_t unit;
    std::uint32_t first_replicate = 0;
    std::size_t luminaire = 0;
    std::uint32_t chain = 0; ///< 0: straight

    struct Pair {
        std::uint32_t scramble_u;
        std::uint32_t scramble_v;

        [[nodiscard]] std::array<double, 2> operator()(std::uint32_t index) const noexcept {
            return {sobol_owen(index, 0, scramble_u), sobol_owen(index, 1, scramble_v)};
        }
    };

    /// Numbers for points that are looked at (use 0) and for unshadowed ones (use 1).
    [[nodiscard]] Pair pair(std::uint32_t replicate, std::uint32_t use) const noexcept {
        const RandomStream stream(seed, StreamPurpose::direct, replicate);
        const auto words =
            stream.words(receiver, static_cast<std::uint32_t>(luminaire) + (chain << 24U));
        return {words[2 * use], words[2 * use + 1]};
    }
};

DirectLight::DirectLight(const Scene& scene,
                         const Emission& emission,
                         const MirrorImages& images)
    : scene_(&scene), emission_(&emission), images_(&images) {}

bool DirectLight::is_point_like(std::size_t luminaire, const Point3& at) const noexcept {
    const Luminaire& l = emission_->luminaire(luminaire);
    if (l.opening.form == OpeningForm::point)
        return true;
    const double reach = point_like_ratio * l.opening.largest_dimension;
    return length_squared(at - l.placement.world_from_luminaire.origin) > reach * reach;
}

void DirectLight::add_opening(const Receiver& receiver,
                              const Point3& clear,
                              std::size_t luminaire,
                              const Randomness& randomness,
                              std::span<Rgb> result,
                              std::uint64_t& rays) const {
    const Luminaire& l = emission_->luminaire(luminaire);
    const LuminaireType& type = scene_->type_of(l);
    const Rgb colour = emission_->colour(luminaire);
    const Point3 at = evaluation_point(l, receiver, clear);
    const OpeningLight light(*emission_, receiver, at, luminaire);
    std::array<SightSegment, packet_size> segments;
    std::array<Look, packet_size> looks_at;
    std::array<float, packet_size> visible{};

    // Pilot: which share of the opening is visible. It only steers.
    const auto pilot = randomness.pair(pilot_replicate, 0);
    std::uint32_t wanted = 0;
    for (std::uint32_t i = 0; i < pilot_rays; ++i) {
        const auto [u, v] = pilot(i);
        const Look k = light.look(u, v);
        segments[i] = {clear, k.departure};
        if (k.response > 0.0)
            wanted |= 1U << i;
    }
    if (wanted != 0) {
        scene_->caster.transmittance16(std::span(segments).first(pilot_rays),
                                       wanted,
                                       std::span(visible).first(pilot_rays));
        rays += pilot_rays;
    }
    double seen = 0.0;
    for (std::uint32_t i = 0; i < pilot_rays; ++i)
        if ((wanted >> i & 1U) != 0)
            seen += static_cast<double>(visible[i]);
    const double beta = wanted != 0 ? seen / static_cast<double>(std::popcount(wanted)) : 0.0;
    const bool is_mixed = beta > 0.0 && beta < 1.0;
    const std::size_t looks = is_mixed ? shadowed_samples : 1;

    // The unshadowed light, exact where Lambert's formula gives it.
    const bool is_analytic = std::holds_alternative<LambertianSource>(type.source)
                             && l.opening.form == OpeningForm::flat && is_planar(receiver);
    double exact = 0.0;
    if (is_analytic) {
        const Facet& facet = l.opening.facets.front();
        if (dot(facet.normal, at - facet.vertices.front()) > 0.0) {
            const double luminance = in_lumen(l.flux) / (std::numbers::pi * facet.area);
            exact = luminance * projected_solid_angle(facet.vertices, at, receiver.axis);
        }
        if (exact <= 0.0)
            return;
    }

    // Replicates: beta x unshadowed + (1/looks) sum of c (V - beta); rays of several replicates
    // share a packet.
    const std::size_t per_packet = packet_size / looks;
    for (std::size_t r0 = 0; r0 < result.size(); r0 += per_packet) {
        const std::size_t r1 = std::min(result.size(), r0 + per_packet);
        std::array<double, packet_size> base{};
        std::size_t n = 0;
        wanted = 0;
        for (std::size_t r = r0; r < r1; ++r) {
            const auto replicate = randomness.first_replicate + static_cast<std::uint32_t>(r);
            // Looks and unshadowed samples each run through a sequence of their own without
            // gaps, so that their error falls from unit to unit.
            const auto numbers = randomness.pair(replicate, 0);
            for (std::uint32_t i = 0; i < looks; ++i) {
                const auto [u, v] =
                    numbers(randomness.unit * static_cast<std::uint32_t>(looks) + i);
                looks_at[n] = light.look(u, v);
                segments[n] = {clear, looks_at[n].departure};
                if (looks_at[n].response > 0.0)
                    wanted |= 1U << n;
                ++n;
            }
            if (beta == 0.0)
                continue;
            double unshadowed = exact;
            if (!is_analytic) {
                const auto more = randomness.pair(replicate, 1);
                for (std::uint32_t i = 0; i < unshadowed_samples; ++i) {
                    const auto [u, v] = more(randomness.unit * unshadowed_samples + i);
                    unshadowed += light.value(light.look(u, v));
                }
                unshadowed /= static_cast<double>(unshadowed_samples);
            }
            base[r - r0] = beta * unshadowed;
        }
        if (wanted != 0) {
            scene_->caster.transmittance16(
                std::span(segments).first(n), wanted, std::span(visible).first(n));
            rays += n;
        }
        for (std::size_t r = r0; r < r1; ++r) {
            double sum = 0.0;
            for (std::size_t k = (r - r0) * looks; k < (r - r0 + 1) * looks; ++k) {
                const double difference = static_cast<double>(visible[k]) - beta;
                if ((wanted >> k & 1U) != 0 && difference != 0.0)
                    sum += light.value(looks_at[k]) * difference;
            }
            result[r] += (base[r - r0] + sum / static_cast<double>(looks)) * colour;
        }
    }
}

void DirectLight::add_images(const Receiver& receiver,
                             const Point3& at,
                             const Randomness& randomness,
                             std::span<Rgb> result,
                             std::uint64_t& rays) const {
    const auto contribution = [&](const std::vector<std::uint32_t>& chain,
                                  const OpeningView& view,
                                  double u,
                                  double v) {
        const EmissionPoint from = view.sample(u, v);
        const TowardsSample s{from, view.pdf(from)};
        if (!(s.density > 0.0))
            return 0.0;
        const ImageLight light = trace_image(*scene_, *emission_, *images_, chain, at, s, rays);
        if (light.strength <= 0.0)
            return 0.0;
        return light.strength * evaluate_response(receiver, light.arrival) / s.density;
    };
    const auto& chains = images_->chains();
    for (std::uint32_t c = 0; c < chains.size(); ++c) {
        const Point3 image = image_of(*images_, chains[c], at);
        for (std::size_t l = 0; l < emission_->luminaires(); ++l) {
            if (!may_reflect(*images_, chains[c].back(), emission_->luminaire(l), image))
                continue;
            const Rgb colour = emission_->colour(l);
            if (emission_->luminaire(l).opening.form == OpeningForm::point) {
                const double e = contribution(chains[c], emission_->view(l, image), 0.5, 0.5);
                for (Rgb& r : result)
                    r += e * colour;
                continue;
            }
            const OpeningView view = emission_->view(l, image);
            Randomness own = randomness;
            own.luminaire = l;
            own.chain = c + 1;
            for (std::size_t r = 0; r < result.size(); ++r) {
                const auto numbers =
                    own.pair(own.first_replicate + static_cast<std::uint32_t>(r), 0);
                double sum = 0.0;
                for (std::uint32_t i = 0; i < shadowed_samples; ++i) {
                    const auto [u, v] = numbers(
                        static_cast<std::uint32_t>(randomness.unit * shadowed_samples) + i);
                    sum += contribution(chains[c], view, u, v);
                }
                result[r] += (sum / static_cast<double>(shadowed_samples)) * colour;
            }
        }
    }
}

void DirectLight::estimate(const Receiver& receiver,
                           std::uint64_t receiver_index,
                           std::uint64_t seed,
                           std::uint32_t unit,
                           std::uint32_t first_replicate,
                           std::span<Rgb> result,
                           std::uint64_t& rays) const {
    std::fill(result.begin(), result.end(), Rgb{});
    if (emission_->total_flux() <= 0.0)
        return;
    const Point3 clear = clear_point(*scene_, receiver);
    Randomness randomness{seed, receiver_index, unit, first_replicate};

    // Point-like luminaires: one ray each, the same value for every replicate.
    std::array<SightSegment, packet_size> segments;
    std::array<float, packet_size> visible{};
    std::array<Rgb, packet_size> values;
    std::size_t n = 0;
    Rgb exact;
    const auto flush = [&] {
        if (n == 0)
            return;
        scene_->caster.transmittance16(
            std::span(segments).first(n), (1U << n) - 1U, std::span(visible).first(n));
        rays += n;
        for (std::size_t i = 0; i < n; ++i)
            exact += static_cast<double>(visible[i]) * values[i];
        n = 0;
    };
    for (std::size_t l = 0; l < emission_->luminaires(); ++l) {
        if (!is_point_like(l, clear)) {
            randomness.luminaire = l;
            add_opening(receiver, clear, l, randomness, result, rays);
            continue;
        }
        const Luminaire& luminaire = emission_->luminaire(l);
        const Point3 at = evaluation_point(luminaire, receiver, clear);
        const Point3 centre = luminaire.placement.world_from_luminaire.origin;
        const UnitVector3 w(at - centre);
        const double response = evaluate_response(receiver, -w);
        if (response <= 0.0)
            continue;
        const Frame& frame = luminaire.placement.world_from_luminaire;
        const double intensity =
            luminaire.placement.scale
            * in_candela(luminous_intensity(scene_->type_of(luminaire),
                                            UnitVector3::from_unit(frame.vector_to_local(w))));
        if (intensity <= 0.0)
            continue;
        values[n] = (intensity * response / length_squared(at - centre)) * emission_->colour(l);
        const EmissionPoint from{l, 0, centre};
        segments[n] = {clear,
                       luminaire.opening.form == OpeningForm::solid
                           ? emission_->view(l, at).sample(0.5, 0.5).position
                           : emission_->departure(from, w)};
        if (++n == packet_size)
            flush();
    }
    flush();
    for (Rgb& r : result)
        r += exact;

    if (!images_->chains().empty())
        add_images(receiver, clear, randomness, result, rays);
}

} // namespace isolux
