#pragma once

#include <span>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/base/receiver.h"
#include "isolux/calc/calculate.h"

namespace isolux {

/// Luminance that arrives at an eye along one ray, cd/m2.
struct LuminanceResult {
    Estimate total;
    Estimate luminaires; ///< openings seen straight, through panes and in mirrors
    Estimate direct;     ///< light straight from luminaires, reflected once towards the eye
    Estimate indirect;   ///< light that was reflected before
    bool converged = false;
};

struct LuminanceResults {
    std::vector<LuminanceResult> rays; ///< as the sight lines
    double confidence = 0.95;
    bool converged = false;
    bool interrupted = false;
    RayCounts counts;
};

/// Luminances along the lines to the tolerance of `settings`; its absolute tolerance E, lx,
/// counts as E/pi, cd/m2: that of a white surface. The same bits for any number of threads.
[[nodiscard]] LuminanceResults estimate_luminances(const Scene& scene,
                                                   std::span<const SightLine> lines,
                                                   const Settings& settings,
                                                   const Control& control = {});

} // namespace isolux
