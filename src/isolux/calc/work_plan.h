#pragma once

#include <array>
#include <string>

#include "isolux/calc/pilot.h"

namespace isolux {

/// What the pilot's findings come to: effort, number of units, and who serves which points.
struct WorkPlan {
    Effort effort;
    std::size_t units = 1; ///< before the first look
    ByClass<PointEstimator> of_class{
        PointEstimator::mis, PointEstimator::mis, PointEstimator::mis, PointEstimator::mis};
    /// Efficiency of LE-MIS over that of path tracing for the light that is not direct; 0 where
    /// no point of the class was looked at.
    ByClass<double> advantage{};
};

/// @param points  of the task, by class
[[nodiscard]] WorkPlan make_work_plan(const Settings& settings,
                                      const Pilot& pilot,
                                      const UnitCosts& costs,
                                      const ByClass<std::size_t>& points,
                                      const GatherReach& reach);

/// "open points: 30 times as efficient as path tracing", ... or nothing.
[[nodiscard]] std::string describe_advantage(const WorkPlan& plan);

} // namespace isolux
