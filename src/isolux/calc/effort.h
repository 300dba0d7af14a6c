#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "isolux/scene/scene.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// Points of a kind: what is efficient for one of them is so for the others.
enum class PointClass : std::uint8_t {
    open,  ///< nothing that could send it light within half a metre
    near,  ///< something nearer than that
    close, ///< than a quarter of a metre
    beside ///< than a hand's breadth
};

inline constexpr std::size_t point_classes = 4;

template <class T> using ByClass = std::array<T, point_classes>;

/// Which points gather beside M light paths, METHODS eq. (140): vertices lie so close together
/// that only surfaces nearby need gather rays as well.
class GatherReach {
public:
    /// All gather, whatever lies around them.
    GatherReach() = default;

    /// @param area  f² A of METHODS eq. (140), m2
    explicit GatherReach(double area) noexcept : area_(area) {}

    /// The same before any point was counted.
    [[nodiscard]] GatherReach without_points() const noexcept { return GatherReach(area_); }

    /// Within this distance it matters how far surfaces are, however many paths there are, m.
    [[nodiscard]] double farthest() const noexcept;

    /// @param ahead  distance to the nearest surface that could send a point light, m
    [[nodiscard]] bool includes(double ahead, double paths) const noexcept {
        return ahead * ahead * paths < area_;
    }

    /// Counts a point for share().
    void add(PointClass c, double ahead) noexcept;

    /// Share of the points of a class that gather, where there are any; 1 where none was
    /// counted. @pre `paths` a power of two
    [[nodiscard]] double share(std::size_t c, std::size_t paths) const noexcept;

private:
    static constexpr std::size_t doublings = 32;

    double area_ = std::numeric_limits<double>::infinity();
    ByClass<std::array<std::size_t, doublings + 1>>
        counts_{}; ///< by doublings of M until which
};

/// Rays that a point must send where openings shine by chains of mirrors that only rays find: a
/// pilot that met no such chain knows nothing of them. METHODS eq. (143).
/// @param share  MirrorImages::expected_without_image
[[nodiscard]] std::size_t fewest_rays_by_mirrors(double share) noexcept;

/// What is spent on a point in one unit of one replicate, beside the light paths.
struct PointEffort {
    std::size_t draws = 16;     ///< K shadow rays to vertices
    std::size_t directions = 4; ///< N2 gather rays
    std::size_t looks = 1;      ///< L, multiplies the samples of direct light
};

/// How much one unit of work holds: of one replicate, `paths` light paths that all points share
/// and, at every point, what its class needs, or `samples` traced paths.
struct Effort {
    std::size_t paths = 1024; ///< M, a power of two
    Weighing weighing = Weighing::all;
    ByClass<PointEffort> at;
    std::size_t samples = 32; ///< path tracing
};

/// Which estimator of the indirect part a point takes.
enum class PointEstimator : std::uint8_t { local, mis, path_tracing, study };

inline constexpr std::size_t pilot_paths = 512; ///< per replicate
inline constexpr std::size_t fewest_paths = 256;
inline constexpr std::size_t most_paths = 16384;
inline constexpr std::size_t most_paths_of_a_tree = 131072;

/// Vertices that a tree may hold, of 200 bytes each; fewer paths then, where they branch.
inline constexpr double most_vertices_of_a_tree = 1e6;

inline constexpr std::size_t fewest_draws = 4;
inline constexpr std::size_t most_draws = 512;
inline constexpr std::size_t most_directions = 128;
inline constexpr std::size_t most_units = 256; ///< before the first look

/// Variance of the mean of all replicates after one unit, METHODS eq. (61):
/// paths/M + draws/K + directions/N2 + direct/L^2, or samples/S + direct/L^2 where a point is
/// traced;
/// in shares of what the tolerance allows, so that 1 is good enough.
struct VarianceModel {
    double paths = 0.0;
    double draws = 0.0;
    double directions = 0.0;
    double direct = 0.0;
    double samples = 0.0;
    double light = 0.0; ///< what cached vertices give, squared, in the same shares

    double look_samples = 0.0; ///< of one unit of direct light

    /// `draws` as they are by the tree.
    [[nodiscard]] double draws_by(Weighing weighing) const noexcept;

    /// Of LE-MIS with M paths, without the direct part. @param gathering  share of the points
    /// whose light depends on gather rays
    [[nodiscard]] double of(std::size_t m,
                            const PointEffort& e,
                            Weighing weighing = Weighing::all,
                            double gathering = 1.0) const noexcept;
    [[nodiscard]] double of_direct(const PointEffort& e) const noexcept;
};

/// What things cost, in units of about a nanosecond of one core. They are constants of scene
/// and task, never measured: a choice that follows from them is the same on every machine and
/// for every number of threads.
struct UnitCosts {
    double path = 0.0;      ///< of one light path, for all points together
    double pair = 0.0;      ///< of one path's vertices at one point
    double draw = 0.0;      ///< of one shadow ray
    double direction = 0.0; ///< of one gather ray and its two connections
    double glance = 0.0;    ///< of one that looks for mirrors only; 0: there are none
    double sample = 0.0;    ///< of one traced path
    double look = 0.0;      ///< of one sample of direct light
    double point = 0.0;     ///< of a point's unit whatever it holds
    double vertices = 1.0;  ///< no cost: of one light path
    /// No cost: rays that a point sends, to gather or traced, whatever the pilot thinks they
    /// are worth.
    std::size_t fewest_directions = 1;
    double tree_path = 0.0; ///< of one light path that goes into a tree
    double cut = 0.0;       ///< of the tree's cut at one point; 0: nobody asks for a tree
    double descent = 0.0;   ///< of one draw down the tree, beside its shadow ray

    [[nodiscard]] double path_by(Weighing weighing) const noexcept {
        return weighing == Weighing::tree ? tree_path : path;
    }

    [[nodiscard]] double draw_by(Weighing weighing) const noexcept {
        return weighing == Weighing::tree ? draw + descent : draw;
    }

    /// Of a gather ray, mean over points of which a share gathers.
    [[nodiscard]] double direction_of(double gathering) const noexcept {
        return gathering * direction + (1.0 - gathering) * glance;
    }

    /// Of LE-MIS, one unit and one point, beside the M light paths and direct light.
    /// @param gathering  share of the points that do
    [[nodiscard]] double own(std::size_t m,
                             const PointEffort& e,
                             Weighing weighing = Weighing::all,
                             double gathering = 1.0) const noexcept;

    /// The same with its share of the M light paths, one point among `points` that share them.
    [[nodiscard]] double of(std::size_t m,
                            const PointEffort& e,
                            std::size_t points,
                            Weighing weighing = Weighing::all,
                            double gathering = 1.0) const noexcept;
};

/// @param vertices_per_path  of the pilot, with all branches
/// @param chain_length       of a path without them
/// @param images   how often traced paths look for a luminaire in mirrors, 0..1 a vertex
/// @param mirrors  whether there are any, panes included
[[nodiscard]] UnitCosts make_unit_costs(const Scene& scene,
                                        double vertices_per_path,
                                        double chain_length,
                                        double images,
                                        bool mirrors);

/// The points that share light paths: how many of each class, and what their samples are worth.
struct SharedTask {
    ByClass<std::size_t> points{};
    ByClass<VarianceModel> models;
    UnitCosts costs;
    GatherReach reach;

    [[nodiscard]] std::size_t all() const noexcept;

    /// Share of a class's points whose light depends on gather rays beside M paths.
    [[nodiscard]] double share_of_rays(std::size_t c, std::size_t m) const noexcept {
        return costs.glance > 0.0 ? 1.0 : reach.share(c, m);
    }
};

struct EffortChoice {
    Effort effort;
    std::size_t units = 1; ///< before the first look
};

/// The cheapest effort and number of units, all powers of two, that should bring the mean
/// variance of every class well within what is allowed: METHODS "Choosing M, K, N2".
[[nodiscard]] EffortChoice choose_effort(const SharedTask& task);

/// The most efficient numbers of draws, directions and looks beside so many paths.
[[nodiscard]] Effort
balance_effort(const SharedTask& task, std::size_t paths, Weighing weighing = Weighing::all);

/// Whether so many points may share a tree: for fewer nothing is gained.
[[nodiscard]] bool may_take_tree(std::size_t points) noexcept;

/// The most efficient effort, with a tree and any M where that is better by far, else with the
/// M given.
[[nodiscard]] Effort balance_paths(const SharedTask& task, std::size_t paths);

/// Paths to trace from a point in each of `units` units.
[[nodiscard]] std::size_t choose_samples(const VarianceModel& model, std::size_t units);

} // namespace isolux
