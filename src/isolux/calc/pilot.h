#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "isolux/calc/effort.h"
#include "isolux/calc/project.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/path_importance.h"

namespace isolux {

/// What the pilot may look at; everything outlives it.
struct PilotScene {
    const Scene* scene = nullptr;
    const Emission* emission = nullptr;
    const MirrorImages* images = nullptr;
    std::span<const Receiver> receivers;
    std::span<const Point3> clear; ///< where their rays start
    std::span<const PointClass> classes;
    std::span<const std::uint8_t> leaves_corners; ///< METHODS eq. (33), with `corner`
    double corner = 0.0;                          ///< EffectiveCounts::corner of these points
    double caustic = 0.0;                         ///< EffectiveCounts::caustic of them
    std::span<const std::uint8_t> gathers;        ///< METHODS eq. (140), beside pilot_paths
    std::uint64_t seed = 1;
    bool reflected = true; ///< false: direct light alone
    /// Direct light of a receiver for the replicates from `first` on, lx.
    /// @return samples it took of each of them
    std::function<double(std::size_t receiver, std::uint32_t first, std::span<double>)> direct;
};

/// What a result has to reach.
struct PilotTarget {
    double tolerance = 0.01;          ///< half width / value
    double factor = 2.0;              ///< half width / standard error at the first look
    double absolute_tolerance = 1e-4; ///< lx
    double darkest_share = 0.02; ///< of the mean of a surface; darker points are held to that
    double replicates = 16.0;
    std::vector<std::size_t> ends; ///< of the surfaces among the receivers; none: all are one
};

/// Of each point: few points are looked at more often.
inline constexpr std::size_t fewest_pilot_replicates = 4;
inline constexpr std::size_t most_pilot_replicates = 16;
inline constexpr std::size_t pilot_points = 64;

/// Replicates from here on the run itself does not use.
inline constexpr std::uint32_t first_pilot_replicate = 0xffff00U;

/// What a few samples of some points say about the variance, METHODS eq. (61). They come
/// from replicates of their own and are thrown away: what follows from them steers the work and
/// biases nothing.
struct Pilot {
    double vertices_per_path = 1.0;  ///< with all branches
    double chain_length = 1.0;       ///< vertices of a path if all carried the same
    ByClass<VarianceModel> of_class; ///< mean over its points; 0 where none was seen
    ByClass<std::size_t> points{};   ///< looked at
    ByClass<double> reflected{};     ///< lx, the least at one of `points`, if any
    VarianceModel all;               ///< mean over all points of the task
    PathImportance importance;       ///< for the light paths
};

[[nodiscard]] Pilot run_pilot(const PilotScene& task, const PilotTarget& target);

/// What cutting a tree and weighing what comes of it costs a point, ns (UnitCosts::cut): the
/// tree of 16384 paths is cut for some of the task's tiles. 0: no tree.
[[nodiscard]] double find_cost_of_cut(const PilotScene& task, const PathImportance& importance);

/// What a trial of path tracing found at a receiver.
struct TracingTrial {
    double mean = 0.0;     ///< lx
    double variance = 0.0; ///< of one path, lx2
};

/// Traces `samples` paths of each of some receivers in each of `replicates` replicates that no
/// result uses.
[[nodiscard]] std::vector<TracingTrial> try_tracing(const PilotScene& task,
                                                    std::span<const std::size_t> receivers,
                                                    std::size_t samples,
                                                    std::size_t replicates);

} // namespace isolux
