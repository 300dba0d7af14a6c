#pragma once

#include <algorithm>
#include <span>
#include <stop_token>
#include <vector>

#include "isolux/calc/books.h"
#include "isolux/calc/last_points.h"
#include "isolux/calc/project.h"
#include "isolux/calc/results.h"
#include "isolux/calc/study_estimators.h"
#include "isolux/calc/work_plan.h"
#include "isolux/transport/direct_light.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// What one replicate of one unit adds to the flux balance, lm.
struct ReplicateFlux {
    double absorbed = 0.0;
    double escaped = 0.0;
};

/// Runs units of work on a scene: between two calls of adapt() the same numbers for the same
/// (seed, unit, replicate, point, and with a tree company), whoever calls and in whatever
/// order. When it is enough is for the caller to say.
class Engine {
public:
    /// Independent randomised replicates behind every error bar (METHODS eq. (15)).
    static constexpr std::size_t replicates = 16;

    Engine(const Scene& scene, const Settings& settings);

    [[nodiscard]] const Emission& emission() const noexcept { return emission_; }

    /// What estimate_direct and estimate_indirect tell apart where they are given room for it.
    /// @param layout  outlives the engine's work
    void keep_books(const LedgerLayout& layout) noexcept { layout_ = &layout; }

    /// Takes the receivers, and fixes effort, estimators and the constants of METHODS eq. (11)
    /// from a pilot of a few paths. A receiver that lies on a surface and does not look away
    /// from it is moved off it. @return units of work before the first look
    std::size_t prepare(std::vector<Receiver> receivers, const PilotTarget& target);

    /// Fits the work to the points that still need any: the light paths cost the same for few
    /// as for many, and points that are traced need none. Numbers drawn before stay drawn.
    /// @param open   in ascending order
    /// @param units  done so far
    NextLook adapt(std::span<const OpenPoint> open, std::size_t units);

    /// Gives a receiver that the last adapt() changed, and no unit since, back to the estimator
    /// of before.
    void change_back(std::size_t receiver) noexcept;

    /// Per receiver, as given to prepare().
    [[nodiscard]] bool is_near_surface(std::size_t receiver) const noexcept {
        return near_surface_[receiver] != 0;
    }

    /// Light paths of one replicate and unit, ready for the points.
    /// @param used  whose memory is taken over
    [[nodiscard]] VertexCache
    build_cache(std::uint32_t replicate, std::uint32_t unit, VertexCache used = {}) const;

    /// Indirect illuminance of receivers [first, first + result.size()), lx. Adds to the books.
    /// @param open  which of them are wanted; empty: all
    void estimate_indirect(const VertexCache& cache,
                           std::size_t first,
                           std::span<const std::uint8_t> open,
                           std::uint32_t replicate,
                           std::uint32_t unit,
                           std::span<double> result,
                           RayCounts& rays,
                           const BookEntries& books = {}) const;

    /// Finds out once what of a receiver's direct light is known without noise. Different
    /// receivers may be planned by different threads.
    void plan_direct(std::size_t index, RayCounts& rays);

    /// Direct illuminance of one receiver for replicates from `first_replicate` on, lx.
    /// @param by_source  [source][replicate], added to; empty where no books are kept
    /// @pre plan_direct(index)
    void estimate_direct(std::size_t index,
                         std::uint32_t unit,
                         std::uint32_t first_replicate,
                         std::span<double> result,
                         RayCounts& rays,
                         std::span<double> by_source = {}) const;

    /// Of all replicates, about.
    [[nodiscard]] double vertices_of_a_unit() const noexcept {
        return replicates * static_cast<double>(effort_.paths) * pilot_.vertices_per_path;
    }

    /// Whether any active receiver needs light paths.
    [[nodiscard]] bool needs_paths() const noexcept { return needs_paths_; }

    [[nodiscard]] std::string describe() const;

    /// What a reader of the results must know about the estimator.
    [[nodiscard]] std::vector<Message> notices() const;

private:
    [[nodiscard]] Message head_notice() const;

    /// In place of the unit in which a point changed to tracing.
    static constexpr std::uint32_t unchanged = ~0U;

    /// Traced paths of a point and replicate that are on their way at once.
    static constexpr std::uint32_t samples_at_once = 256;

    void find_surroundings();
    [[nodiscard]] double corner_of(double paths) const noexcept;
    [[nodiscard]] double caustic_of(double paths) const noexcept;

    /// Whether a second surface is nearer than that, m, and one that could send light.
    [[nodiscard]] bool is_within(std::size_t receiver, double distance) const noexcept {
        return static_cast<double>(std::max(second_[receiver], ahead_[receiver])) < distance;
    }

    [[nodiscard]] const PointEffort& effort_of(std::size_t receiver) const noexcept {
        return effort_.at[static_cast<std::size_t>(classes_[receiver])];
    }

    /// METHODS eq. (140); never false where corners are walked.
    [[nodiscard]] bool gathers(std::size_t receiver) const noexcept {
        return reach_.includes(ahead_[receiver], counts_.paths);
    }

    /// What reflections bring a receiver, roughly, lx: as the pilot saw it, before it a guess.
    [[nodiscard]] double ambient_of(std::size_t receiver) const noexcept;

    void foresee_looks();
    [[nodiscard]] PilotScene pilot_scene() const;
    [[nodiscard]] NextLook change_estimators(std::span<const OpenPoint> open,
                                             std::size_t units);
    void try_out(std::span<const OpenPoint> points,
                 std::span<const std::size_t> which,
                 double worth);
    [[nodiscard]] ByClass<double> needed_growth(std::span<const OpenPoint> open,
                                                std::span<const std::size_t> changed) const;
    [[nodiscard]] double own_cost(std::size_t receiver) const noexcept;
    [[nodiscard]] std::size_t rounds_of(std::size_t receiver) const noexcept;
    void choose_estimators();
    void fix_counts();
    [[nodiscard]] bool takes_paths(PointEstimator e) const noexcept;

    /// Some points of a tile in one replicate and unit, and where their light goes.
    struct TileWork {
        const VertexCache& cache;
        std::span<const std::size_t> points;
        std::size_t first = 0; ///< of the tile's receivers
        std::uint32_t replicate = 0;
        std::uint32_t unit = 0;
        const LightLedger& tile;
        RayCounts& rays;
    };

    void estimate_local(const TileWork& work, Weighting weighting) const;
    void send_rays(const TileWork& work, PointEstimator estimator) const;

    const Scene* scene_;
    Settings settings_;
    Emission emission_;
    MirrorImages images_;
    DirectLight direct_;
    const LedgerLayout* layout_ = nullptr;
    WorkPlan plan_;
    Effort effort_;
    EffectiveCounts counts_;
    UnitCosts costs_;
    Pilot pilot_;
    GatherReach reach_;
    std::vector<Receiver> receivers_;
    std::vector<DirectPlan> plans_;
    std::vector<Point3> clear_; ///< where their rays start
    std::vector<PointEstimator> estimators_;
    std::vector<std::uint32_t> began_; ///< unit in which a point changed to tracing
    std::vector<float> trials_;        ///< variance of one traced path, lx2; below 0: not known
    double first_unit_cost_ = 0.0;     ///< all points and replicates, ns
    std::vector<std::uint32_t> samples_; ///< of a traced point, per replicate and unit
    std::vector<PointClass> classes_;
    std::vector<float>
        ahead_; ///< to the nearest that could send it light, m; 1e9: none is near
    std::vector<float> second_; ///< distance to the second nearest surface, m; up to 0.5
    std::vector<std::uint8_t> near_surface_;
    StudyEstimators study_;
    bool needs_paths_ = true;
};

} // namespace isolux
