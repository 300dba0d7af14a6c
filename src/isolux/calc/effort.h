#pragma once

#include <cstddef>
#include <cstdint>

#include "isolux/scene/scene.h"

namespace isolux {

/// How much one unit of work holds. A unit of one replicate is `paths` light paths and, at
/// every point, `draws` shadow rays, `directions` gather rays or `samples` traced paths.
struct Effort {
    std::size_t paths = 1024;   ///< M, a power of two
    std::size_t draws = 16;     ///< K
    std::size_t directions = 4; ///< N2
    std::size_t samples = 32;   ///< path tracing
};

/// Which estimator of the indirect part a point takes.
enum class PointEstimator : std::uint8_t { local, mis, path_tracing, study };

inline constexpr std::size_t fewest_paths = 256;
inline constexpr std::size_t most_paths = 65536;
inline constexpr std::size_t fewest_draws = 4;
inline constexpr std::size_t most_draws = 64;
inline constexpr std::size_t most_directions = 64;
inline constexpr std::size_t most_units = 256; ///< before the first look

/// Variance of the mean of all replicates after one unit, METHODS eq. (61):
/// paths/M + draws/K + directions/N2 + direct, or samples/S + direct where a point is traced;
/// in shares of what the tolerance allows, so that 1 is good enough.
struct VarianceModel {
    double paths = 0.0;
    double draws = 0.0;
    double directions = 0.0;
    double direct = 0.0;
    double samples = 0.0;

    /// Of LE-MIS at this effort, without the direct part.
    [[nodiscard]] double of(const Effort& e) const noexcept;
};

/// What things cost, in units of about a nanosecond of one core. They are constants of scene
/// and task, never measured: a choice that follows from them is the same on every machine and
/// for every number of threads.
struct UnitCosts {
    double path = 0.0;      ///< of one light path, for all points together
    double pair = 0.0;      ///< of one path's vertices at one point
    double draw = 0.0;      ///< of one shadow ray
    double direction = 0.0; ///< of one gather ray and its two connections
    double sample = 0.0;    ///< of one traced path
    double point = 0.0;     ///< of a point's unit whatever it holds, direct light included

    /// Of LE-MIS, one unit and one point among `points` that share the light paths.
    [[nodiscard]] double of(const Effort& e, std::size_t points) const noexcept;
};

/// @param vertices_per_path  of the pilot
[[nodiscard]] UnitCosts make_unit_costs(const Scene& scene, double vertices_per_path);

struct EffortChoice {
    Effort effort;
    std::size_t units = 1; ///< before the first look
};

/// The cheapest effort and number of units, all powers of two, that should bring `points`
/// points within the tolerance: METHODS "Choosing M, K, N2".
[[nodiscard]] EffortChoice
choose_effort(const VarianceModel& model, const UnitCosts& costs, std::size_t points);

/// The most efficient numbers of draws and directions beside so many paths.
[[nodiscard]] Effort balance_effort(const VarianceModel& model,
                                    const UnitCosts& costs,
                                    std::size_t points,
                                    std::size_t paths);

/// Paths to trace from a point in each of `units` units.
[[nodiscard]] std::size_t choose_samples(const VarianceModel& model, std::size_t units);

} // namespace isolux
