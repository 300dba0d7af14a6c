#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/calc/calculate.h"
#include "isolux/validate/sobolev.h"

/// Sobolev's problem by every method the program has, each with its error and its cost, beside
/// the closed answer.
namespace isolux {

struct SobolevTask {
    SobolevProblem problem;
    std::vector<double> radii{0.0, 0.25, 0.5, 1.0, 2.0, 3.0, 5.0}; ///< m
    double ring_width = 0.1;                                       ///< m, of flux counting
    double work = 1.0; ///< multiplies the work of every method; 1 takes about 20 CPU seconds
    std::uint64_t seed = 1;
};

/// One place: plane and distance from the foot of the source.
struct SobolevPlace {
    SobolevPlane plane = SobolevPlane::one;
    double radius = 0.0;    ///< m
    double exact = 0.0;     ///< lx, at the place itself
    double ring_mean = 0.0; ///< lx, exact mean over the ring that flux counting looks at
};

/// What a method's values are compared with.
enum class SobolevTarget { point, ring };

struct SobolevMethod {
    std::string name;
    SobolevTarget target = SobolevTarget::point;
    std::vector<Estimate> values; ///< lx, one a place
    double cpu_seconds = 0.0;
    double relative_error = 0.0; ///< RMS over the places of standard error / exact value
    double bias = 0.0;           ///< RMS over the places of target / exact - 1; 0 for points
    double worst_z = 0.0;        ///< largest |value - target| / standard error

    /// CPU seconds to a standard error of `share`, from what this run took: the error falls
    /// like 1/sqrt(time).
    [[nodiscard]] double seconds_to(double share) const noexcept;
};

struct SobolevComparison {
    SobolevTask task;
    std::vector<SobolevPlace> places; ///< plane one at every radius, then plane two
    std::vector<SobolevMethod> methods;
};

/// Names in the comparison's order; the first is what the others are compared with.
namespace sobolev_method {
inline constexpr const char* counting = "flux counting on rings";
inline constexpr const char* counting_reflected = "flux counting, direct light exact";
inline constexpr const char* walk = "local estimation";
inline constexpr const char* counting_traced = "flux counting, traced in a scene";
inline constexpr const char* local = "local estimation, traced";
inline constexpr const char* mis = "LE-MIS, traced";
inline constexpr const char* path_tracing = "path tracing, traced";
} // namespace sobolev_method

/// Runs every method with a fixed amount of work each: the values depend on task and seed
/// alone, the seconds on the machine. @pre both reflectances above 0
/// @param progress  called before every method with its name and the share of work done
[[nodiscard]] SobolevComparison
compare_sobolev(const SobolevTask& task,
                const std::function<void(const std::string&, double)>& progress = {});

} // namespace isolux
