#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/calc/calculate.h"

/// What an answer costs: CPU seconds to a given error, measured against an independent long
/// run. What `isolux bench` prints.
namespace isolux {

/// RMS errors over the points that times are given for.
inline constexpr std::array target_errors{0.02, 0.01, 0.005, 0.002};

struct BenchSettings {
    std::vector<Estimator> estimators{Estimator::automatic,
                                      Estimator::local_estimation_mis,
                                      Estimator::path_tracing,
                                      Estimator::local_estimation};
    double seconds = 1.0;           ///< CPU time an estimator may take in its longest run
    double reference_seconds = 8.0; ///< CPU time of the long run, about
    std::size_t seeds = 3;          ///< repeats of the longest run, for the spread
    std::uint64_t seed = 1;
};

/// One run with a fixed number of units.
struct BenchRun {
    std::size_t units = 0;
    double cpu_seconds = 0.0;
    double rms_error = 0.0; ///< rms_error_against() the long run
    double rays = 0.0;
};

/// Relative RMS error of some points' values, measured against those of an independent run
/// whose own stated errors are taken out of it: the mean square difference has both. Half of
/// what is measured is left at least. Points darker than 2 % of the mean of all count as that.
/// @pre as many values as the reference has
[[nodiscard]] double rms_error_against(std::span<const Estimate> reference,
                                       std::span<const Estimate> values);

/// How a time to an error was found.
enum class TimeSource {
    interpolated, ///< between two runs
    at_most,      ///< the shortest run is better already
    extrapolated  ///< the longest run is not as good; error ~ 1/sqrt(time) from there
};

struct TimeToError {
    double cpu_seconds = 0.0;
    TimeSource source = TimeSource::interpolated;
};

struct EstimatorBench {
    Estimator estimator = Estimator::automatic;
    std::string description;    ///< as the run says it
    std::vector<BenchRun> runs; ///< units 1, 2, 4, ...
    std::array<TimeToError, target_errors.size()> times;
    double efficiency = 0.0; ///< 1/(mean square error x CPU seconds), of the longest runs
    double lowest_efficiency = 0.0; ///< over the seeds
    double highest_efficiency = 0.0;
    double rays_per_second = 0.0; ///< of CPU time, all kinds
};

struct RoomBench {
    std::string name;
    std::size_t points = 0;
    std::size_t luminaires = 0;
    std::size_t triangles = 0;
    double reference_error = 0.0; ///< RMS of the long run's own standard errors
    double reference_seconds = 0.0;
    std::vector<EstimatorBench> estimators;
    double shadow_rays_per_second = 0.0; ///< packets from points to luminaires
    double bare_rays_per_second = 0.0;   ///< the ray tracer alone on the same rays
};

/// Told what is being measured, and asked whether to go on.
using BenchProgress = std::function<void(const std::string& what)>;

/// Measures every estimator on a scene. @pre at least one point and one luminaire that shines
[[nodiscard]] RoomBench measure_room(const std::string& name,
                                     const Scene& scene,
                                     std::span<const CalculationSurface> surfaces,
                                     const BenchSettings& settings,
                                     const BenchProgress& progress = {});

/// Cost against the size of the task, at a stated error.
struct ScalingRow {
    std::size_t points = 0;
    std::size_t luminaires = 0;
    double cpu_seconds = 0.0;
    double stated_error = 0.0; ///< RMS of the standard errors
    double seconds_to_1_percent = 0.0;
};

/// One run of the default estimator at a tolerance of 2 %, error and time as they came out, and
/// the time scaled to an RMS error of 1 %.
[[nodiscard]] ScalingRow measure_scaling(const Scene& scene,
                                         std::span<const CalculationSurface> surfaces,
                                         std::uint64_t seed);

} // namespace isolux
