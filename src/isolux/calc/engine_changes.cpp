#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "isolux/calc/engine.h"

/// How an engine's work changes between two looks at the results: METHODS "The last points".
namespace isolux {

namespace {

/// A trial of path tracing may cost this share of what the points' own estimator still needs,
/// and no more than half of the work so far; it takes so many paths of a point and replicate.
constexpr double worth_a_trial = 0.1;
constexpr double fewest_trial_samples = 16.0;
constexpr double most_trial_samples = 1024.0;

/// A point that was traced from the beginning tries LE-MIS where going on costs more than this
/// share of all work so far: nobody knows yet what LE-MIS would need.
constexpr double worth_a_change = 0.1;

/// Traced paths are worth more than a trial of a few says they need.
constexpr double doubt = 1.5;

/// Traced paths of a point, replicate and unit.
constexpr double most_samples = 1U << 14U;

/// Those that begin to trace make a unit at most so many times as long as the first ones were:
/// who stops in between loses no more.
constexpr double longest_unit = 4.0;

/// Draws and gather rays of an open point may each cost this part of its share of the light
/// paths, whatever the pilot thinks they are worth: of a single point it knows little.
constexpr double fair_part = 0.25;

/// So much more is never needed.
constexpr double no_bound = 1e6;

/// A power of two, or a multiple of `round`: blocks of whole nets.
std::uint32_t whole_rounds(double samples, std::uint32_t round) noexcept {
    const auto wanted =
        static_cast<std::uint32_t>(std::ceil(std::clamp(samples, 4.0, most_samples)));
    return wanted <= round ? std::bit_ceil(wanted) : (wanted + round - 1) / round * round;
}

/// The power of two within [1, most] of which the whole costs no more than `worth`.
std::size_t affordable(double worth, double cost, std::size_t most) noexcept {
    const double count = std::clamp(worth / cost, 1.0, static_cast<double>(most));
    return std::bit_floor(static_cast<std::size_t>(count));
}

} // namespace

/// How many times as much as so far a unit should hold at most, for each class.
/// @param changed  receivers whose estimator has just changed, ascending
ByClass<double> Engine::needed_growth(std::span<const OpenPoint> open,
                                      std::span<const std::size_t> changed) const {
    ByClass<std::vector<double>> units;
    for (const OpenPoint& p : open) {
        if (!p.refines_indirect || !takes_paths(estimators_[p.receiver]))
            continue;
        const bool is_new = std::binary_search(changed.begin(), changed.end(), p.receiver);
        const Advance& advance = is_new ? p.parked : p.current;
        units[static_cast<std::size_t>(classes_[p.receiver])].push_back(
            advance.units > 0 ? units_missing(advance) : no_bound);
    }
    ByClass<double> growth{};
    for (std::size_t c = 0; c < point_classes; ++c)
        growth[c] = growth_for(std::move(units[c]));
    return growth;
}

NextLook Engine::adapt(std::span<const OpenPoint> open, std::size_t units) {
    const NextLook next = change_estimators(open, units);
    SharedTask task{{}, pilot_.of_class, costs_, reach_.without_points()};
    for (const OpenPoint& p : open)
        if (p.refines_indirect && takes_paths(estimators_[p.receiver])) {
            ++task.points[static_cast<std::size_t>(classes_[p.receiver])];
            task.reach.add(classes_[p.receiver], ahead_[p.receiver]);
        }
    needs_paths_ = !settings_.direct_only && task.all() > 0;
    if (!needs_paths_)
        return next;
    // More for each of few points, if they need it; never less, so that no number is drawn
    // twice.
    const Effort balanced = balance_effort(task, effort_.paths, effort_.weighing);
    const ByClass<double> needed = needed_growth(open, next.changed);
    const double worth = fair_part * static_cast<double>(effort_.paths)
                         * costs_.path_by(effort_.weighing) / static_cast<double>(task.all());
    const std::size_t draws = affordable(worth, costs_.draw_by(effort_.weighing), most_draws);
    const std::size_t directions = affordable(worth, costs_.direction, most_directions);
    for (std::size_t c = 0; c < point_classes; ++c) {
        PointEffort& e = effort_.at[c];
        const auto grown = [&](std::size_t now, std::size_t most) {
            const double enough =
                std::ceil(std::min(needed[c] * static_cast<double>(now), no_bound));
            return std::max(now,
                            std::min(most, std::bit_ceil(static_cast<std::size_t>(enough))));
        };
        e.draws = grown(e.draws, std::max(draws, balanced.at[c].draws));
        e.directions = grown(e.directions, std::max(directions, balanced.at[c].directions));
        e.looks = std::max(e.looks, balanced.at[c].looks);
    }
    return next;
}

/// Who finishes the open points for less, METHODS eq. (124).
NextLook Engine::change_estimators(std::span<const OpenPoint> open, std::size_t units) {
    NextLook next{units, {}};
    if (settings_.estimator != Estimator::automatic || settings_.direct_only)
        return next;
    constexpr auto runs = static_cast<double>(replicates);
    constexpr double never = 1e300; // ns
    const double paths_cost =
        runs * static_cast<double>(effort_.paths) * costs_.path_by(effort_.weighing);
    const double work = static_cast<double>(units) * first_unit_cost_; // so far
    std::vector<OpenPoint> points;
    std::vector<Finish> finishes;
    std::vector<std::size_t> unknown; // what tracing them costs: numbers into `points`
    double cost = 0.0;
    double most = 0.0;
    for (const OpenPoint& p : open) {
        const std::size_t i = p.receiver;
        const bool traces = estimators_[i] == PointEstimator::path_tracing;
        if (!p.refines_indirect)
            continue;
        const Advance& shared = traces ? p.parked : p.current;
        const Advance& traced = traces ? p.current : p.parked;
        Finish f;
        f.units = shared.units > 0 ? units_missing(shared)
                                   : static_cast<double>(units); // as much as all have had
        f.unit_cost = runs * own_cost(i);
        if (traced.units > 0)
            f.traced = runs * static_cast<double>(traced.units * samples_[i]) * costs_.sample
                       * share_missing(traced);
        else if (trials_[i] < 0.0F)
            unknown.push_back(points.size());
        if (shared.units == 0 && f.traced < worth_a_change * work)
            continue;
        if (traces && traced.excess == 0.0)
            f.traced = never; // it has seen nothing yet
        cost += f.units * f.unit_cost;
        most = std::max(most, f.units);
        points.push_back(p);
        finishes.push_back(f);
    }
    cost += most * paths_cost;
    try_out(points, unknown, std::min(worth_a_trial * cost, 0.5 * work));
    const auto samples_for = [&](const OpenPoint& p) { // of one replicate, from the beginning
        return doubt * static_cast<double>(trials_[p.receiver]) / (runs * p.allowed);
    };
    for (std::size_t k = 0; k < points.size(); ++k)
        if (finishes[k].traced == 0.0)
            finishes[k].traced =
                trials_[points[k].receiver] < 0.0F
                    ? never
                    : runs * std::max(samples_for(points[k]), 4.0) * costs_.sample;
    std::vector<PointEstimator> chosen(points.size(), PointEstimator::mis);
    for (const std::size_t k : choose_traced(finishes, paths_cost))
        chosen[k] = PointEstimator::path_tracing;
    // The light paths are dear: no more of them than the points that need them most ask for.
    double wanted = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (chosen[k] == PointEstimator::mis)
            wanted = std::max({wanted, finishes[k].units, 0.25 * static_cast<double>(units)});
    if (wanted > 0.0)
        next.units = std::min(units, static_cast<std::size_t>(std::ceil(wanted)));
    const auto begins = [&](std::size_t k) {
        return chosen[k] == PointEstimator::path_tracing && points[k].parked.units == 0;
    };
    double beginners = 0.0; // cost of a unit of theirs
    for (std::size_t k = 0; k < points.size(); ++k)
        if (begins(k))
            beginners += finishes[k].traced / static_cast<double>(next.units);
    const double fits =
        beginners > 0.0 ? std::min(1.0, longest_unit * first_unit_cost_ / beginners) : 1.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t i = points[k].receiver;
        if (chosen[k] == estimators_[i])
            continue;
        if (begins(k)) { // a second turn goes on with the numbers of the first
            samples_[i] =
                whole_rounds(fits * samples_for(points[k]) / static_cast<double>(next.units),
                             samples_at_once);
            began_[i] = static_cast<std::uint32_t>(units);
        }
        estimators_[i] = chosen[k];
        next.changed.push_back(i);
    }
    return next;
}

/// Of one unit of LE-MIS at one receiver in one replicate, without the light paths, ns.
double Engine::own_cost(std::size_t receiver) const noexcept {
    return costs_.own(
        effort_.paths, effort_of(receiver), effort_.weighing, gathers(receiver) ? 1.0 : 0.0);
}

/// Traces a few paths from points to learn what they vary by. Nothing where `worth`, ns, does
/// not pay for them. @param which  of the points
void Engine::try_out(std::span<const OpenPoint> points,
                     std::span<const std::size_t> which,
                     double worth) {
    if (which.empty())
        return;
    const double affordable =
        worth / (replicates * costs_.sample * static_cast<double>(which.size()));
    if (affordable < fewest_trial_samples)
        return;
    const auto samples =
        std::bit_floor(static_cast<std::size_t>(std::min(affordable, most_trial_samples)));
    std::vector<std::size_t> receivers;
    for (const std::size_t k : which)
        receivers.push_back(points[k].receiver);
    const auto trials = try_tracing(pilot_scene(), receivers, samples, replicates);
    const auto all = static_cast<double>(samples * replicates);
    for (std::size_t k = 0; k < which.size(); ++k) {
        // Light that the trial has missed comes by rare paths: as if the next one brought it.
        const OpenPoint& p = points[which[k]];
        const double missing = p.indirect - trials[k].mean;
        double variance = trials[k].variance;
        if (missing > 3.0 * std::sqrt(variance / all + p.current.excess * p.allowed)
            || variance == 0.0)
            variance = std::max(variance, all * missing * missing);
        trials_[p.receiver] = static_cast<float>(variance);
    }
}

/// What a receiver that changed last had before: its present estimator has nothing yet.
void Engine::change_back(std::size_t receiver) noexcept {
    estimators_[receiver] = estimators_[receiver] == PointEstimator::mis
                                ? PointEstimator::path_tracing
                                : PointEstimator::mis;
}

} // namespace isolux
