#include "isolux/transport/direct_light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "isolux/base/check.h"
#include "isolux/transport/direct_task.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/opening_light.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

constexpr std::uint32_t unshadowed_samples = 4; ///< per replicate, where no value is known
constexpr std::uint32_t shadowed_samples = 4;   ///< the 4 of METHODS eq. (141)
constexpr double fewest_looks = 0.25;           ///< times DirectEffort::looks
constexpr double most_looks_at_once = 64.0;     ///< the same

/// The tail takes its numbers as if it were this luminaire.
constexpr std::size_t tail_luminaire = 0xffffffU;

/// A look that is uncertain by this share of the receiver's light is taken
/// `shadowed_samples` times: METHODS eq. (141).
constexpr double spread_of_few = 0.3;

/// Rays to something in one unit and replicate, METHODS eq. (141): a power of two; below 1, how
/// many of the units take one. @param spread  of one ray, lx  @param illuminance  lx
double rays_for(double spread, double illuminance, std::uint32_t looks) noexcept {
    if (!(spread > 0.0))
        return looks; // nothing is known
    const double share = spread / (spread_of_few * illuminance);
    const double n = std::clamp(
        shadowed_samples * std::cbrt(share * share), fewest_looks, most_looks_at_once);
    return looks * std::exp2(std::round(std::log2(n)));
}

double
looks_at(const DirectPlan::Opening& opening, double illuminance, std::uint32_t looks) noexcept {
    return opening.is_clear ? 0.0
                            : rays_for(static_cast<double>(opening.spread), illuminance, looks);
}

/// Looks at something in the unit of a replicate.
struct Turn {
    std::uint32_t looks = 0;
    std::uint32_t first = 0; ///< number of the first of them in the replicate
};

/// Less than one look a unit: one in every 1/wanted units, in which of them `places` tells, the
/// number of a unit to a place in [0, 1). Looks are numbered without gaps all the same: their
/// sequence would else never get out of a part of the opening.
template <class Places>
Turn turn_of(double wanted, std::uint32_t unit, const Places& places) noexcept {
    if (wanted >= 1.0) {
        const auto looks = static_cast<std::uint32_t>(wanted);
        return {looks, unit * looks};
    }
    if (!(places(unit)[0] < wanted))
        return {};
    return {1, static_cast<std::uint32_t>(wanted * unit)};
}

/// Rays of one receiver wait here for a whole packet.
class RayPacket {
public:
    explicit RayPacket(const RayCaster& caster) : caster_(&caster) {}

    [[nodiscard]] bool is_full() const noexcept { return n_ == packet_size; }

    [[nodiscard]] std::size_t size() const noexcept { return n_; }

    /// @return its place in the packet
    std::size_t add(const SightSegment& sight, bool is_wanted) noexcept {
        sights_[n_] = sight;
        if (is_wanted)
            wanted_ |= 1U << n_;
        return n_++;
    }

    void trace(std::uint64_t& rays) noexcept {
        if (wanted_ != 0) {
            caster_->transmittance16(
                std::span(sights_).first(n_), wanted_, std::span(visible_).first(n_));
            rays += n_;
        }
    }

    [[nodiscard]] bool is_wanted(std::size_t i) const noexcept {
        return (wanted_ >> i & 1U) != 0;
    }

    [[nodiscard]] double visible(std::size_t i) const noexcept {
        return static_cast<double>(visible_[i]);
    }

    void clear() noexcept {
        n_ = 0;
        wanted_ = 0;
    }

private:
    const RayCaster* caster_;
    std::array<SightSegment, packet_size> sights_;
    std::array<float, packet_size> visible_{};
    std::size_t n_ = 0;
    std::uint32_t wanted_ = 0;
};

/// The most that some places of an opening send to a place that faces them, without shadows,
/// lx.
double brightest(const Emission& emission, const OpeningView& view, const Point3& at) noexcept {
    double most = 0.0;
    for (const double u : {0.25, 0.75})
        for (const double v : {0.25, 0.75}) {
            const EmissionPoint from = view.sample(u, v);
            const Vector3 d = at - from.position;
            const double d2 = length_squared(d);
            const double density = view.pdf(from);
            if (d2 > 0.0 && density > 0.0)
                most = std::max(most, emission.evaluate(from, UnitVector3(d)) / (density * d2));
        }
    return most;
}

} // namespace

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
    // The box of the mirror is tried, grown by the size of the opening.
    const Point3 p = from + (above / (above - below)) * (image - from);
    return m.box_holds(p, 2.0 * reach);
}

double image_light(const Scene& scene,
                   const Emission& emission,
                   const MirrorImages& images,
                   const std::vector<std::uint32_t>& chain,
                   const Receiver& receiver,
                   const Point3& clear,
                   const OpeningView& view,
                   const std::array<double, 2>& uv,
                   std::uint64_t& rays) noexcept {
    const EmissionPoint from = view.sample(uv[0], uv[1]);
    const TowardsSample s{from, view.pdf(from)};
    if (!(s.density > 0.0))
        return 0.0;
    const ImageLight light = trace_image(scene, emission, images, chain, clear, s, rays);
    if (light.strength <= 0.0)
        return 0.0;
    return light.strength * evaluate_response(receiver, light.arrival) / s.density;
}

double DirectLight::samples_of(const DirectPlan& plan, double ambient) const noexcept {
    double sum = plan.tail_draws;
    for (const DirectPlan::Opening& o : plan.openings)
        sum += looks_at(o, plan.seen + ambient, 1)
               + (o.unshadowed < 0.0 && o.visible_share > 0.0F ? unshadowed_samples : 0U);
    return sum;
}

/// beta x unshadowed + (1/looks) sum of c (V - beta), METHODS eq. (13); rays of several
/// replicates share a packet.
void DirectLight::add_opening(const Task& task,
                              const DirectPlan::Opening& opening,
                              const LightLedger& ledger,
                              std::uint64_t& rays) const {
    const OpeningLight light(*scene_, *emission_, task.receiver, task.clear, opening.luminaire);
    const Rgb colour = emission_->colour(opening.luminaire);
    const auto beta = static_cast<double>(opening.visible_share);
    const double wanted = looks_at(opening, task.illuminance, task.looks);
    const std::size_t replicates = ledger.total.size();
    thread_local std::vector<double> sums;
    sums.assign(replicates, 0.0);

    RayPacket packet(scene_->caster);
    std::array<Look, packet_size> seen;
    std::array<std::size_t, packet_size> of{}; // which replicate
    const auto settle = [&] {
        packet.trace(rays);
        for (std::size_t k = 0; k < packet.size(); ++k)
            if (packet.is_wanted(k) && packet.visible(k) != beta)
                sums[of[k]] += light.value(seen[k]) * (packet.visible(k) - beta);
        packet.clear();
    };
    // Looks and unshadowed samples each run through a sequence of their own without gaps, so
    // that their error falls from unit to unit.
    for (std::size_t r = 0; r < replicates; ++r) {
        const auto replicate = task.first_replicate + static_cast<std::uint32_t>(r);
        const Turn turn = turn_of(wanted, task.unit, task.turns(opening.luminaire, replicate));
        const auto numbers = task.pair(opening.luminaire, replicate, 0);
        for (std::uint32_t i = 0; i < turn.looks; ++i) {
            if (packet.is_full())
                settle();
            const auto [u, v] = numbers(turn.first + i);
            const std::size_t k = packet.size();
            of[k] = r;
            seen[k] = light.look(u, v);
            packet.add({task.clear, seen[k].departure}, seen[k].response > 0.0);
        }
    }
    settle();
    for (std::size_t r = 0; r < replicates; ++r) {
        double e = wanted > 0.0 ? sums[r] / wanted : 0.0;
        if (beta > 0.0)
            e += beta * unshadowed(task, opening, light, r);
        if (e != 0.0)
            ledger.add(r, opening.luminaire, e * colour);
    }
}

/// What the opening would add if nothing stood in the way: known, or the mean of some samples.
double DirectLight::unshadowed(const Task& task,
                               const DirectPlan::Opening& opening,
                               const OpeningLight& light,
                               std::size_t replicate) {
    if (opening.unshadowed >= 0.0)
        return opening.unshadowed;
    const auto numbers = task.pair(
        opening.luminaire, task.first_replicate + static_cast<std::uint32_t>(replicate), 1);
    const std::uint32_t samples = task.looks * unshadowed_samples;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const auto [u, v] = numbers(task.unit * samples + i);
        sum += light.value(light.look(u, v));
    }
    return sum / samples;
}

/// Draws from the tail in proportion to bounds, METHODS "Many luminaires": systematically over
/// its parts, then down the tree.
void DirectLight::add_tail(const Task& task,
                           const DirectPlan& plan,
                           const LightLedger& ledger,
                           std::uint64_t& rays) const {
    struct Drawn {
        std::size_t replicate = 0;
        std::size_t luminaire = 0;
        double light = 0.0;
    };

    RayPacket packet(scene_->caster);
    std::array<Drawn, packet_size> drawn;
    const auto settle = [&] {
        packet.trace(rays);
        for (std::size_t i = 0; i < packet.size(); ++i)
            if (packet.visible(i) > 0.0)
                ledger.add(drawn[i].replicate,
                           drawn[i].luminaire,
                           (packet.visible(i) * drawn[i].light)
                               * emission_->colour(drawn[i].luminaire));
        packet.clear();
    };
    const std::uint32_t draws = task.looks * plan.tail_draws;
    const double step = plan.tail_bound / draws;
    for (std::size_t r = 0; r < ledger.total.size(); ++r) {
        const auto replicate = task.first_replicate + static_cast<std::uint32_t>(r);
        const auto places = task.pair(tail_luminaire, replicate, 0);
        const double offset = task.pair(tail_luminaire, replicate, 1)(task.unit)[0];
        std::size_t part = 0;
        double before = 0.0;
        for (std::uint32_t k = 0; k < draws; ++k) {
            const double target = (k + offset) * step;
            while (part + 1 < plan.tail.size() && before + plan.tail[part].bound <= target)
                before += plan.tail[part++].bound;
            const double inside =
                std::clamp((target - before) / plan.tail[part].bound, 0.0, 1.0 - 1e-16);
            const LightTree::Pick pick =
                emission_->tree()->pick(plan.tail[part].node, task.receiver, inside);
            if (!(pick.probability > 0.0))
                continue;
            const double density = pick.probability * plan.tail[part].bound / step;
            const OpeningLight light(
                *scene_, *emission_, task.receiver, task.clear, pick.luminaire);
            const auto [u, v] = places(task.unit * draws + k);
            const Look look = light.look(u, v);
            const double value = light.value(look);
            if (!(value > 0.0))
                continue;
            if (packet.is_full())
                settle();
            drawn[packet.add({task.clear, look.departure}, true)] = {
                r, pick.luminaire, value / density};
        }
    }
    settle();
}

void DirectLight::add_images(const Task& task,
                             const LightLedger& ledger,
                             std::uint64_t& rays) const {
    const auto& chains = images_->chains();
    for (std::uint32_t c = 0; c < chains.size(); ++c) {
        const Point3 image = image_of(*images_, chains[c], task.clear);
        for (std::size_t l = 0; l < emission_->luminaires(); ++l) {
            if (emission_->luminaire(l).opening.form == OpeningForm::point
                || !may_reflect(*images_, chains[c].back(), emission_->luminaire(l), image))
                continue;
            const OpeningView view = emission_->view(l, image);
            const double spread = images_->strength(c) * brightest(*emission_, view, image);
            const double wanted = rays_for(spread, task.illuminance, task.looks);
            for (std::size_t r = 0; r < ledger.total.size(); ++r) {
                const auto replicate = task.first_replicate + static_cast<std::uint32_t>(r);
                const Turn turn = turn_of(wanted, task.unit, task.turns(l, replicate, c + 1));
                const auto numbers = task.pair(l, replicate, 0, c + 1);
                double sum = 0.0;
                for (std::uint32_t i = 0; i < turn.looks; ++i)
                    sum += image_light(*scene_,
                                       *emission_,
                                       *images_,
                                       chains[c],
                                       task.receiver,
                                       task.clear,
                                       view,
                                       numbers(turn.first + i),
                                       rays);
                if (sum > 0.0)
                    ledger.add(r, l, (sum / wanted) * emission_->colour(l));
            }
        }
    }
}

void DirectLight::estimate(const Receiver& receiver,
                           const DirectPlan& plan,
                           std::uint64_t receiver_index,
                           std::uint64_t seed,
                           std::uint32_t unit,
                           const DirectEffort& effort,
                           std::uint32_t first_replicate,
                           const LightLedger& ledger,
                           std::uint64_t& rays) const {
    ISOLUX_EXPECT(std::has_single_bit(effort.looks) && effort.looks <= most_looks);
    const std::size_t replicates = ledger.total.size();
    for (Rgb& total : ledger.total)
        total += plan.known;
    if (!ledger.by_source.empty())
        for (const DirectPlan::Term& term : plan.terms)
            for (std::size_t r = 0; r < replicates; ++r)
                ledger.by_source[ledger.layout->source_of[term.luminaire] * replicates + r] +=
                    term.lux;
    if (emission_->total_flux() <= 0.0 || is_exact(plan))
        return;
    const Task task{receiver,
                    clear_point(*scene_, receiver),
                    seed,
                    receiver_index,
                    unit,
                    first_replicate,
                    effort.looks,
                    plan.seen + effort.ambient};
    for (const DirectPlan::Opening& opening : plan.openings)
        add_opening(task, opening, ledger, rays);
    if (!plan.tail.empty())
        add_tail(task, plan, ledger, rays);
    if (samples_images_)
        add_images(task, ledger, rays);
}

void DirectLight::estimate(const Receiver& receiver,
                           std::uint64_t receiver_index,
                           std::uint64_t seed,
                           std::uint32_t unit,
                           std::uint32_t first_replicate,
                           std::span<Rgb> result,
                           std::uint64_t& rays) const {
    std::ranges::fill(result, Rgb{});
    const DirectPlan made = plan(receiver, receiver_index, seed, false, rays);
    estimate(receiver,
             made,
             receiver_index,
             seed,
             unit,
             {1, ambient_},
             first_replicate,
             {result, nullptr, {}, {}},
             rays);
}

} // namespace isolux
