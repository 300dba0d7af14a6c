#include "isolux/calc/work_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "isolux/transport/direct_light.h"

namespace isolux {

namespace {

/// Path tracing is taken where LE-MIS is not at least this efficient beside it; the pilot is
/// not sure of less.
constexpr double worth_it = 0.8;

/// Light paths of a unit where the user fixes the number of units: METHODS "Choosing M, K, N2".
std::size_t paths_for(std::size_t points) {
    const double wanted =
        128.0 * std::sqrt(static_cast<double>(std::max<std::size_t>(points, 1)));
    return std::clamp<std::size_t>(
        std::bit_ceil(static_cast<std::size_t>(wanted)), fewest_paths, 8192);
}

/// Samples of a unit where nothing else is done; more of them would be worth more units.
constexpr double most_samples_alone = 64.0;

/// Where no light paths compete for the time, more looks are worth it wherever one is not
/// enough.
void look_where_it_matters(WorkPlan& plan, const Pilot& pilot) {
    constexpr double enough = 0.5; // of the variance that is allowed
    for (std::size_t c = 0; c < point_classes; ++c) {
        std::size_t& looks = plan.effort.at[c].looks;
        looks = 1;
        while (looks < DirectLight::most_looks
               && pilot.of_class[c].of_direct(plan.effort.at[c]) > enough)
            looks *= 2;
    }
}

void plan_tracing(WorkPlan& plan, const VarianceModel& model, std::size_t fewest) {
    const double wanted = std::clamp(
        model.samples, std::max(4.0, static_cast<double>(fewest)), most_samples_alone);
    plan.effort.samples = std::bit_ceil(static_cast<std::size_t>(wanted));
    const double units =
        model.samples / static_cast<double>(plan.effort.samples) + model.direct;
    plan.units = std::bit_ceil(static_cast<std::size_t>(
        std::ceil(std::clamp(units, 1.0, static_cast<double>(most_units)))));
}

/// Effort for a task, units included where they are free.
EffortChoice choose(const Settings& settings, const SharedTask& task) {
    if (settings.fixed_units)
        return {balance_paths(task, paths_for(task.all())), 1};
    return choose_effort(task);
}

/// Every class is judged as if all points were like its own: a class that will be traced must
/// not decide what the others share. Where the choice is free, traced classes leave the task.
void judge_classes(WorkPlan& plan,
                   SharedTask& task,
                   const Settings& settings,
                   const Pilot& pilot) {
    const std::size_t all = task.all();
    SharedTask left = task;
    for (std::size_t c = 0; c < point_classes; ++c) {
        const VarianceModel& model = pilot.of_class[c];
        SharedTask alone{{}, task.models, task.costs, task.reach};
        alone.points[c] = all;
        const Effort effort = choose(settings, alone).effort;
        const double shared = model.of(effort.paths,
                                       effort.at[c],
                                       effort.weighing,
                                       task.share_of_rays(c, effort.paths))
                              * task.costs.of(effort.paths,
                                              effort.at[c],
                                              all,
                                              effort.weighing,
                                              task.reach.share(c, effort.paths));
        if (pilot.points[c] == 0 || !(shared > 0.0))
            continue;
        plan.advantage[c] = model.samples * task.costs.sample / shared;
        // In the dark a few traced paths say nothing: what they miss is rare.
        if (settings.estimator == Estimator::automatic && pilot.importance.is_even()
            && plan.advantage[c] < worth_it) {
            plan.of_class[c] = PointEstimator::path_tracing;
            left.points[c] = 0;
        }
    }
    if (left.all() > 0)
        task = left;
}

} // namespace

WorkPlan make_work_plan(const Settings& settings,
                        const Pilot& pilot,
                        const UnitCosts& costs,
                        const ByClass<std::size_t>& points,
                        const GatherReach& reach) {
    SharedTask task{points, pilot.of_class, costs, reach};
    WorkPlan plan;
    judge_classes(plan, task, settings, pilot);
    if (settings.estimator == Estimator::path_tracing) {
        plan_tracing(plan, pilot.all, costs.fewest_directions);
    } else {
        const EffortChoice choice = choose(settings, task);
        plan.effort = choice.effort;
        plan.units = choice.units;
    }
    if (settings.direct_only || settings.estimator == Estimator::path_tracing)
        look_where_it_matters(plan, pilot);
    VarianceModel traced; // the noisiest of the classes that are
    for (std::size_t c = 0; c < point_classes; ++c)
        if (plan.of_class[c] == PointEstimator::path_tracing
            && pilot.of_class[c].samples > traced.samples)
            traced = {.direct = pilot.of_class[c].of_direct(plan.effort.at[c]),
                      .samples = pilot.of_class[c].samples};
    if (traced.samples == 0.0) // the pilot saw no traced point
        traced = {.direct = pilot.all.direct, .samples = pilot.all.samples};
    if (settings.fixed_units)
        plan.effort.samples = 32;
    else if (settings.estimator != Estimator::path_tracing)
        plan.effort.samples =
            std::max(choose_samples(traced, plan.units), costs.fewest_directions);
    return plan;
}

std::string describe_advantage(const WorkPlan& plan) {
    constexpr std::array<const char*, point_classes> names{"open points",
                                                           "points near surfaces",
                                                           "points close to surfaces",
                                                           "points beside surfaces"};
    std::string text;
    for (std::size_t c = 0; c < point_classes; ++c)
        if (plan.advantage[c] > 0.0)
            text += fmt::format("{}{}: {:.2g} times as efficient as path tracing",
                                text.empty() ? "" : "; ",
                                names[c],
                                plan.advantage[c]);
    return text;
}

} // namespace isolux
