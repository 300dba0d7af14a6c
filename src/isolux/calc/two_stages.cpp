#include "isolux/calc/two_stages.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace isolux {

namespace {

/// The pilot's random numbers: a seed that no sensible user counts up to from their own.
constexpr std::uint64_t pilot_seed_step = 0x9E3779B97F4A7C15ULL;

/// 10 % quantile of chi-squared with 15 degrees of freedom: nine pilots in ten do not state a
/// larger variance by chance than 15/8.5468 times theirs allows for.
constexpr double chi_squared_15_10 = 8.546756;

/// Variance falls like units^-1.3, assumed of scrambled nets.
constexpr double rate = 1.3;

/// No pilot sends anybody on a journey without end.
constexpr double most_units = 1U << 20U;

/// A point darker than this share of its surface's mean is held to the tolerance of that share.
constexpr double darkest_share = 0.02;

double floor_of(const SurfaceResult& surface, const Settings& settings) noexcept {
    return std::max(darkest_share * surface.summary.mean.mean,
                    settings.absolute_tolerance / settings.tolerance);
}

double quantile_of(const SurfaceResult& surface, const Settings& settings) {
    const double values = settings.statement == Statement::all_points
                              ? static_cast<double>(surface.points.size())
                              : 1.0;
    return student_quantile(1.0 - (1.0 - settings.confidence) / std::max(1.0, values),
                            static_cast<double>(pilot_stage_replicates - 1));
}

/// Whether the intervals of the second stage are as narrow as was asked for.
void judge(Results& results, const Settings& settings) {
    results.converged = true;
    for (SurfaceResult& s : results.surfaces) {
        const double floor = floor_of(s, settings);
        const double quantile = quantile_of(s, settings);
        s.converged = std::ranges::all_of(s.points, [&](const PointResult& p) {
            return quantile * p.total.standard_error
                   <= settings.tolerance * std::max(p.total.mean, floor);
        });
        results.converged = results.converged && s.converged;
    }
}

} // namespace

double
units_for(const Estimate& pilot, double tolerance, double floor, double quantile) noexcept {
    const double value = std::max(std::abs(pilot.mean), floor);
    if (!(value > 0.0))
        return 1.0;
    const double inflated =
        pilot.standard_error * std::sqrt((pilot_stage_replicates - 1.0) / chi_squared_15_10);
    const double ratio = quantile * inflated / (tolerance * value);
    return std::clamp(std::pow(ratio, 2.0 / rate), 1.0, most_units);
}

Results calculate_in_two_stages(const Scene& scene,
                                std::span<const CalculationSurface> surfaces,
                                const Settings& settings,
                                const Control& control) {
    const auto start = std::chrono::steady_clock::now();
    Settings stage = settings;
    stage.stopping = Stopping::doubling; // each stage is one run of fixed work
    stage.fixed_units = 1;
    stage.seed = settings.seed + pilot_seed_step;
    const Results pilot = calculate(scene, surfaces, stage, control);
    double units = 1.0;
    for (const SurfaceResult& s : pilot.surfaces)
        for (const PointResult& p : s.points)
            units = std::max(units,
                             units_for(p.total,
                                       settings.tolerance,
                                       floor_of(s, settings),
                                       quantile_of(s, settings)));
    stage.seed = settings.seed;
    stage.fixed_units = static_cast<std::size_t>(std::ceil(units));
    if (settings.time_limit) // what is left of it, never nothing
        stage.time_limit = std::max<std::chrono::duration<double>>(
            std::chrono::duration<double>(1e-3),
            *settings.time_limit - (std::chrono::steady_clock::now() - start));
    Results results = calculate(scene, surfaces, stage, control);
    judge(results, settings);
    results.cpu_seconds += pilot.cpu_seconds;
    results.wall_seconds += pilot.wall_seconds;
    results.estimator +=
        "; two stages, the second of " + std::to_string(*stage.fixed_units) + " units";
    return results;
}

} // namespace isolux
