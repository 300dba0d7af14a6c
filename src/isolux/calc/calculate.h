#pragma once

#include <functional>
#include <span>
#include <stop_token>

#include "isolux/calc/project.h"
#include "isolux/calc/results.h"

namespace isolux {

struct Progress {
    double fraction = 0.0;             ///< of the expected work, 0..1
    double seconds_left = 0.0;         ///< estimate; negative while unknown
    double worst_relative_error = 0.0; ///< half width / value of the worst point so far
    const char* stage = "";            ///< "pilot", "calculating", ...
};

/// What the caller may watch and stop. Nothing here changes the numbers, except stopping early.
struct Control {
    std::stop_token stop;
    std::function<void(const Progress&)> progress; ///< called from the calling thread only
};

/// Illuminance on all surfaces of the project, to the tolerance of its settings.
[[nodiscard]] Results calculate(const Scene& scene,
                                std::span<const CalculationSurface> surfaces,
                                const Settings& settings,
                                const Control& control = {});

} // namespace isolux
