#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/error.h"
#include "isolux/base/estimate.h"
#include "isolux/calc/contributions.h"
#include "isolux/calc/sensitivities.h"
#include "isolux/measure/energy.h"
#include "isolux/measure/glare.h"
#include "isolux/measure/grid_statistics.h"
#include "isolux/measure/requirement.h"
#include "isolux/measure/surface_grid.h"

namespace isolux {

/// One point's illuminance, lx. Flags say why an error bar deserves less trust (METHODS 3.5).
struct PointResult {
    Estimate total;
    Estimate direct;
    Estimate indirect;
    bool suspicious_replicate = false; ///< largest deviation above 3.5 s
    bool heavy_tail = false;           ///< kurtosis of the replicates above 6
    bool near_surface = false;         ///< within 1 mm of a foreign surface
};

struct SurfaceResult {
    CalculationSurface surface;
    std::vector<PointResult> points; ///< as surface.receivers
    ReplicateTable replicates;       ///< total illuminance
    SurfaceSummary summary;
    bool converged = false;
    ReplicateTable direct = {}; ///< direct part of `replicates`; empty where it is not known
};

/// Ez / Eh where a surface of cylindrical illuminance and a horizontal one share their points.
struct ModellingResult {
    std::size_t cylindrical = 0; ///< surface
    std::size_t horizontal = 0;  ///< surface
    std::vector<Estimate> points;
    Estimate mean; ///< of the points' ratios
    Estimate minimum;
    Estimate maximum;
};

/// A light scene, recombined from the contributions of the luminaires.
struct SceneResult {
    std::string name;
    std::vector<double> factors;          ///< by luminaire
    std::vector<SurfaceSummary> surfaces; ///< as Results::surfaces
    std::optional<double> watts;
    std::vector<Verdict> verdicts; ///< those that illuminances decide
};

/// Luminous flux in, flux out, lm.
struct FluxBalance {
    Estimate emitted;
    Estimate absorbed;
    Estimate escaped; ///< left through open openings or past the rooms
};

struct RayCounts {
    std::uint64_t path = 0;
    std::uint64_t shadow = 0;
    std::uint64_t gather = 0;
    std::uint64_t degenerate = 0; ///< values that were no number and count as 0
};

struct Results {
    std::vector<SurfaceResult> surfaces;
    std::vector<ModellingResult> modelling;
    std::vector<Verdict> verdicts; ///< as Project::requirements
    std::vector<ObserverGroupResult> observers;
    std::vector<EnergyResult> energy;
    std::vector<SceneResult> scenes;
    FluxBalance flux_balance;
    RayCounts rays;
    double wall_seconds = 0.0;
    double cpu_seconds = 0.0;
    bool converged = false;   ///< every surface is within the tolerance
    bool interrupted = false; ///< stopped by the user or by the time limit
    std::uint64_t replicates = 0;
    std::uint64_t units = 0; ///< complete units of work; a closed tile took part in fewer
    std::uint64_t looks = 1; ///< how often the intervals were looked at before stopping
    std::uint64_t paths = 0; ///< light paths walked in all
    std::string estimator;   ///< in words, as printed in the report
    double confidence =
        0.95; ///< of each interval by itself; stopping asked for more (METHODS "Stopping")
    std::vector<Message> notices;
    std::optional<Contributions> contributions; ///< where Settings::contributions asks for them
    std::optional<Sensitivities> sensitivities; ///< where Settings::sensitivities does
};

} // namespace isolux
