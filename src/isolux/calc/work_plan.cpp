#include "isolux/calc/work_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

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

void plan_tracing(WorkPlan& plan, const VarianceModel& model) {
    const double wanted = std::clamp(model.samples, 4.0, most_samples_alone);
    plan.effort.samples = std::bit_ceil(static_cast<std::size_t>(wanted));
    const double units =
        model.samples / static_cast<double>(plan.effort.samples) + model.direct;
    plan.units = std::bit_ceil(static_cast<std::size_t>(
        std::ceil(std::clamp(units, 1.0, static_cast<double>(most_units)))));
}

} // namespace

WorkPlan make_work_plan(const Settings& settings,
                        const Pilot& pilot,
                        const UnitCosts& costs,
                        const ByClass<std::size_t>& points) {
    const SharedTask task{points, pilot.of_class, costs};
    WorkPlan plan;
    if (settings.estimator == Estimator::path_tracing) {
        plan_tracing(plan, pilot.all);
    } else if (settings.fixed_units) {
        plan.effort = balance_effort(task, paths_for(task.all()));
    } else {
        const EffortChoice choice = choose_effort(task);
        plan.effort = choice.effort;
        plan.units = choice.units;
    }
    double samples = 0.0;
    double direct = 0.0;
    for (std::size_t c = 0; c < point_classes; ++c) {
        const VarianceModel& model = pilot.of_class[c];
        const PointEffort& effort = plan.effort.at[c];
        const double shared = model.of(plan.effort.paths, effort)
                              * costs.of(plan.effort.paths, effort, task.all());
        if (pilot.points[c] == 0 || !(shared > 0.0))
            continue;
        plan.advantage[c] = model.samples * costs.sample / shared;
        if (settings.estimator == Estimator::automatic && plan.advantage[c] < worth_it)
            plan.of_class[c] = PointEstimator::path_tracing;
        if (plan.of_class[c] == PointEstimator::path_tracing && model.samples > samples) {
            samples = model.samples;
            direct = model.direct;
        }
    }
    if (samples == 0.0) { // the pilot saw no traced point
        samples = pilot.all.samples;
        direct = pilot.all.direct;
    }
    if (settings.fixed_units)
        plan.effort.samples = 32;
    else if (settings.estimator != Estimator::path_tracing)
        plan.effort.samples =
            choose_samples({.direct = direct, .samples = samples}, plan.units);
    return plan;
}

std::string describe_advantage(const WorkPlan& plan) {
    constexpr std::array<const char*, point_classes> names{
        "open points", "points near surfaces", "points close to surfaces", "points at edges"};
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
