#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "isolux/transport/direct_task.h"
#include "isolux/transport/image_light.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/opening_light.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

/// An opening smaller than the distance by this factor counts as a point: the error of that is
/// below 1 / (4 x 40^2) = 0.016 % (METHODS "Point model").
constexpr double point_like_ratio = 40.0;

/// What the light of openings without shadows may be wrong by beside all light from openings,
/// once for each by itself and once for all of them together: METHODS eq. (134).
constexpr double rule_error = 1e-4;

/// Of an opening that brings no more than this share of the light, as one of very many, a rough
/// value will do, if its last rule changed it by no more than so many times what it may be
/// wrong by: where a table has a kink the second rule is left with a third of what it changed.
/// Two rules may agree by chance, but not those of many.
constexpr double share_of_many = 1.0 / 16.0;
constexpr double believed_doubt = 3.0;

/// More than any light: a rough value will do.
constexpr double anything = std::numeric_limits<double>::infinity();

/// beta (1 - beta) where the pilot's rays agree: what they may have missed, METHODS eq. (141).
constexpr double unseen = 0.03;

} // namespace

DirectLight::DirectLight(const Scene& scene,
                         const Emission& emission,
                         const MirrorImages& images)
    : scene_(&scene), emission_(&emission), images_(&images), view_(scene) {
    if (!images.chains().empty())
        for (const Luminaire& l : scene.luminaires)
            samples_images_ = samples_images_ || l.opening.form != OpeningForm::point;
    if (scene.total_area > 0.0)
        ambient_ = 0.25 * emission.total_flux() / scene.total_area; // where it is rather dark
}

bool DirectLight::is_point_like(std::size_t luminaire, const Point3& at) const noexcept {
    const Luminaire& l = emission_->luminaire(luminaire);
    if (l.opening.form == OpeningForm::point)
        return true;
    const double reach = point_like_ratio * l.opening.largest_dimension;
    return length_squared(at - l.placement.world_from_luminaire.origin) > reach * reach;
}

bool DirectLight::is_exact(const DirectPlan& plan) const noexcept {
    return plan.openings.empty() && plan.tail.empty() && !samples_images_;
}

DirectPlan DirectLight::plan(const Receiver& receiver,
                             std::uint64_t receiver_index,
                             std::uint64_t seed,
                             bool keeps_terms,
                             std::uint64_t& rays) const {
    DirectPlan plan;
    plan.is_made = true;
    if (emission_->total_flux() <= 0.0)
        return plan;
    const Task task{receiver,
                    clear_point(*scene_, receiver),
                    seed,
                    receiver_index,
                    0,
                    0,
                    1,
                    0.0,
                    keeps_terms};
    std::vector<std::uint32_t> points;
    std::vector<double> doubts; // of the openings' rough values, lx
    for (const Chosen& c : choose(task, plan)) {
        if (is_point_like(c.luminaire, task.clear))
            points.push_back(c.luminaire);
        else
            plan_opening(task, c, plan, doubts, rays);
    }
    plan_points(task, points, plan, rays);
    plan_images(task, plan, rays);
    plan.seen += luminance_sum(plan.known);
    know_openings(task, doubts, plan);
    // Plans stay for the whole calculation, one for every receiver.
    plan.openings.shrink_to_fit();
    plan.terms.shrink_to_fit();
    return plan;
}

/// One ray each, the same value for every replicate.
void DirectLight::plan_points(const Task& task,
                              std::span<const std::uint32_t> luminaires,
                              DirectPlan& plan,
                              std::uint64_t& rays) const {
    std::array<SightSegment, packet_size> segments;
    std::array<float, packet_size> visible{};
    std::array<double, packet_size> values{};
    std::array<std::uint32_t, packet_size> who{};
    std::size_t n = 0;
    const auto flush = [&] {
        if (n == 0)
            return;
        scene_->caster.transmittance16(
            std::span(segments).first(n), (1U << n) - 1U, std::span(visible).first(n));
        rays += n;
        for (std::size_t i = 0; i < n; ++i)
            if (visible[i] > 0.0F)
                task.keep(plan,
                          who[i],
                          (static_cast<double>(visible[i]) * values[i])
                              * emission_->colour(who[i]));
        n = 0;
    };
    for (const std::uint32_t l : luminaires) {
        const Luminaire& luminaire = emission_->luminaire(l);
        const Point3 at = evaluation_point(luminaire, task.receiver, task.clear);
        const Point3 centre = luminaire.placement.world_from_luminaire.origin;
        const UnitVector3 w(at - centre);
        const double response = evaluate_response(task.receiver, -w);
        if (response <= 0.0)
            continue;
        const Frame& frame = luminaire.placement.world_from_luminaire;
        const double intensity =
            luminaire.placement.scale
            * in_candela(luminous_intensity(scene_->type_of(luminaire),
                                            UnitVector3::from_unit(frame.vector_to_local(w))));
        if (intensity <= 0.0)
            continue;
        values[n] = intensity * response / length_squared(at - centre);
        who[n] = l;
        segments[n] = {task.clear,
                       luminaire.opening.form == OpeningForm::solid
                           ? emission_->view(l, at).sample(0.5, 0.5).position
                           : emission_->departure({l, 0, centre}, w)};
        if (++n == packet_size)
            flush();
    }
    flush();
}

/// What is seen of an opening. Its light without shadows is a rough value; know_openings()
/// needs it to tell what is worth knowing better.
void DirectLight::plan_opening(const Task& task,
                               const Chosen& chosen,
                               DirectPlan& plan,
                               std::vector<double>& doubts,
                               std::uint64_t& rays) const {
    const std::uint32_t luminaire = chosen.luminaire;
    const OpeningLight light(*scene_, *emission_, task.receiver, task.clear, luminaire);
    const std::optional<RuleValue> rough = light.unshadowed(anything);
    if (rough && rough->value <= 0.0)
        return;
    doubts.push_back(rough ? rough->doubt : anything);
    DirectPlan::Opening opening{luminaire, 1.0F, 0.0F, false, rough ? rough->value : 0.0};
    opening.is_clear = chosen.is_clear || is_wholly_visible(luminaire, task.clear);
    if (!opening.is_clear || !rough) {
        // Pilot: a rough value where the rules have none, and which share of the opening is
        // visible. It only steers.
        std::array<SightSegment, packet_size> segments;
        std::array<float, packet_size> visible{};
        const auto numbers = task.pair(luminaire, pilot_replicate, 0);
        std::uint32_t wanted = 0;
        double mean = 0.0;
        for (std::uint32_t i = 0; i < pilot_rays; ++i) {
            const auto [u, v] = numbers(i);
            const Look k = light.look(u, v);
            mean += light.value(k) / pilot_rays;
            segments[i] = {task.clear, k.departure};
            if (k.response > 0.0)
                wanted |= 1U << i;
        }
        if (!rough)
            opening.unshadowed = mean;
        if (opening.is_clear) {
            plan.openings.push_back(opening);
            return;
        }
        if (wanted != 0) {
            scene_->caster.transmittance16(std::span(segments).first(pilot_rays),
                                           wanted,
                                           std::span(visible).first(pilot_rays));
            rays += pilot_rays;
        }
        float seen = 0.0F;
        for (std::uint32_t i = 0; i < pilot_rays; ++i)
            if ((wanted >> i & 1U) != 0)
                seen += visible[i];
        opening.visible_share =
            wanted != 0 ? seen / static_cast<float>(std::popcount(wanted)) : 0.0F;
    }
    plan.openings.push_back(opening);
}

/// Takes the openings' light without shadows as well as it matters beside all of it, METHODS
/// eq. (134); what is then known without a ray leaves the openings.
void DirectLight::know_openings(const Task& task,
                                std::span<const double> doubts,
                                DirectPlan& plan) const {
    double total = 0.0;
    double count = 0.0;
    for (const DirectPlan::Opening& o : plan.openings)
        if (o.visible_share > 0.0F) {
            total += static_cast<double>(o.visible_share) * o.unshadowed;
            count += 1.0;
        }
    std::size_t next = 0;
    std::erase_if(plan.openings, [&](DirectPlan::Opening& o) {
        const double doubt = doubts[next++];
        const double rough = std::exchange(o.unshadowed, -1.0);
        const auto beta = static_cast<double>(o.visible_share);
        o.spread = static_cast<float>(rough * std::sqrt(std::max(beta * (1.0 - beta), unseen)));
        plan.seen += beta * rough;
        if (beta <= 0.0)
            return false; // nothing is taken of it
        const double negligible = rule_error * (rough + total / count);
        o.unshadowed = rough <= share_of_many * total && doubt <= believed_doubt * negligible
                           ? rough
                           : know_opening(task, o.luminaire, negligible);
        if (!o.is_clear || o.unshadowed < 0.0)
            return false;
        task.keep(plan, o.luminaire, o.unshadowed * emission_->colour(o.luminaire));
        return true;
    });
}

/// The opening's light without shadows, lx; below 0 where it is not known.
double
DirectLight::know_opening(const Task& task, std::uint32_t luminaire, double negligible) const {
    const OpeningLight light(*scene_, *emission_, task.receiver, task.clear, luminaire);
    const std::optional<RuleValue> known = light.unshadowed(negligible);
    return known ? known->value : -1.0;
}

void DirectLight::plan_images(const Task& task, DirectPlan& plan, std::uint64_t& rays) const {
    for (const auto& chain : images_->chains()) {
        const Point3 image = image_of(*images_, chain, task.clear);
        for (std::size_t l = 0; l < emission_->luminaires(); ++l) {
            if (emission_->luminaire(l).opening.form != OpeningForm::point
                || !may_reflect(*images_, chain.back(), emission_->luminaire(l), image))
                continue;
            const double e = image_light(*scene_,
                                         *emission_,
                                         *images_,
                                         chain,
                                         task.receiver,
                                         task.clear,
                                         emission_->view(l, image),
                                         {0.5, 0.5},
                                         rays);
            if (e > 0.0)
                task.keep(plan, l, e * emission_->colour(l));
        }
    }
}

} // namespace isolux
