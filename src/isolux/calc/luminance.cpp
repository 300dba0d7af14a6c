#include "isolux/calc/luminance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <numbers>

#include "isolux/base/parallel.h"
#include "isolux/calc/stopping.h"
#include "isolux/transport/double_local_estimator.h"

namespace isolux {

namespace {

constexpr std::size_t replicates = 16;
constexpr std::size_t most_checks = 24; ///< units: 1, 2, 4, ...
constexpr std::size_t pilot_paths = 512;
constexpr std::uint32_t pilot_replicate = 0xfffffdU;
constexpr double edge_factor = 0.4; ///< METHODS 11.2
constexpr double widest_edge = 0.5; ///< m

/// Surfaces of one ray that get numbers of their own; further ones share the last.
constexpr std::uint64_t numbered_surfaces = 16;

/// The parts of one ray's luminance in one replicate, summed over units.
struct Parts {
    double luminaires = 0.0;
    double direct = 0.0;
    double indirect = 0.0;
};

class LuminanceCalculation {
public:
    LuminanceCalculation(const Scene& scene,
                         std::span<const SightLine> lines,
                         const Settings& settings,
                         const Control& control)
        : scene_(scene), lines_(lines), settings_(settings), control_(control),
          emission_(scene), images_(scene), direct_(scene, emission_, images_),
          estimator_(scene, emission_, images_), sums_(lines.size() * replicates),
          units_(lines.size(), 0), active_(lines.size(), 1) {
        paths_ = std::clamp<std::size_t>(std::bit_ceil(lines.size() * 4), 1024, 8192);
        double vertices_per_path = 1.0;
        if (emission_.total_flux() > 0.0) {
            const VertexCache pilot =
                build_vertex_cache(scene_,
                                   emission_,
                                   PathRandomness(settings_.seed, pilot_replicate),
                                   0,
                                   pilot_paths,
                                   EffectiveCounts{});
            vertices_per_path = std::max(0.01, static_cast<double>(pilot.size()) / pilot_paths);
        }
        const double paths = static_cast<double>(paths_);
        counts_ = {paths, paths * vertices_per_path, 1.0, 1.0, 0.0, scene.total_area};
        edge_ = std::min(widest_edge, edge_factor * std::sqrt(scene.total_area / paths));
    }

    LuminanceResults run() {
        std::size_t done = 0;
        for (std::size_t check = 0; check < most_checks; ++check) {
            const std::size_t target = settings_.fixed_units.value_or(std::size_t{1} << check);
            for (; done < target; ++done)
                if (!run_unit(static_cast<std::uint32_t>(done)))
                    return collect(true);
            if (close(check) || settings_.fixed_units)
                break;
        }
        return collect(false);
    }

private:
    bool run_unit(std::uint32_t unit) {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < lines_.size(); ++i)
            if (active_[i] != 0)
                open.push_back(i);
        std::vector<Parts> parts(open.size() * replicates);
        std::vector<RayCounts> rays(open.size());
        for (std::uint32_t r = 0; r < replicates; ++r) {
            if (must_stop())
                return false;
            VertexCache cache;
            if (!settings_.direct_only)
                cache = build_vertex_cache(scene_,
                                           emission_,
                                           PathRandomness(settings_.seed, r),
                                           std::uint64_t{unit} * paths_,
                                           paths_,
                                           counts_);
            for_each_index(open.size(), 1, [&](std::size_t k) {
                parts[k * replicates + r] = look(open[k], r, unit, cache, rays[k]);
            });
        }
        for (std::size_t k = 0; k < open.size(); ++k) {
            for (std::size_t r = 0; r < replicates; ++r) {
                Parts& sum = sums_[open[k] * replicates + r];
                const Parts& add = parts[k * replicates + r];
                sum.luminaires += add.luminaires;
                sum.direct += add.direct;
                sum.indirect += add.indirect;
            }
            ++units_[open[k]];
            ray_counts_.shadow += rays[k].shadow;
            ray_counts_.gather += rays[k].gather;
            ray_counts_.degenerate += rays[k].degenerate;
        }
        return true;
    }

    Parts look(std::size_t line,
               std::uint32_t replicate,
               std::uint32_t unit,
               const VertexCache& cache,
               RayCounts& rays) const {
        thread_local EyePath path;
        const PointRandomness random(settings_.seed, StreamPurpose::selection, replicate, line);
        NumberSequence numbers(random, unit);
        follow_eye(scene_, emission_, lines_[line], numbers, path, rays.gather);
        Parts parts;
        parts.luminaires = finite(path.luminaires, rays);
        for (std::size_t s = 0; s < path.surfaces.size(); ++s) {
            const SeenSurface& seen = path.surfaces[s];
            const SeenKey key{settings_.seed,
                              replicate,
                              unit,
                              line * numbered_surfaces
                                  + std::min<std::uint64_t>(s, numbered_surfaces - 1)};
            Rgb direct;
            direct_.estimate(receiver_at(seen),
                             key.place,
                             settings_.seed,
                             unit,
                             replicate,
                             {&direct, 1},
                             rays.shadow);
            parts.direct += finite(luminance_of(seen, direct), rays);
            if (settings_.direct_only)
                continue;
            const Rgb e = estimator_.reflected(
                seen, method(seen), cache, counts_, effort_, key, rays.gather);
            parts.indirect += finite(luminance_of(seen, e), rays);
        }
        return parts;
    }

    [[nodiscard]] ReflectedBy method(const SeenSurface& seen) const noexcept {
        switch (settings_.estimator) {
        case Estimator::local_estimation:
            return ReflectedBy::local;
        case Estimator::local_estimation_mis:
            return ReflectedBy::mis;
        case Estimator::path_tracing:
            return ReflectedBy::path_tracing;
        case Estimator::automatic: // the estimators for study are for points
        case Estimator::photometer_head:
        case Estimator::bounded:
        case Estimator::bidirectional:
            break;
        }
        return estimator_.choose(seen, edge_);
    }

    /// A degenerate sample counts as zero and is told about.
    static double finite(const Rgb& luminance, RayCounts& rays) noexcept {
        const double y = luminance_sum(luminance);
        if (std::isfinite(y))
            return y;
        ++rays.degenerate;
        return 0.0;
    }

    template <class Part>
    [[nodiscard]] Estimate estimate_of(std::size_t line, const Part& part) const {
        std::array<double, replicates> values{};
        const double n = static_cast<double>(std::max<std::size_t>(1, units_[line]));
        for (std::size_t r = 0; r < replicates; ++r)
            values[r] = part(sums_[line * replicates + r]) / n;
        return estimate_from_replicates(values);
    }

    [[nodiscard]] Estimate total_of(std::size_t line) const {
        return estimate_of(line,
                           [](const Parts& p) { return p.luminaires + p.direct + p.indirect; });
    }

    /// Lets rest what is good enough. True if nothing is left.
    bool close(std::size_t check) {
        const bool all = settings_.statement == Statement::all_points;
        const StoppingRule rule(
            settings_.tolerance, settings_.confidence, all ? lines_.size() : 1);
        const double floor =
            settings_.absolute_tolerance / (settings_.tolerance * std::numbers::pi);
        bool is_done = true;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (active_[i] != 0 && rule.is_met(total_of(i), check, floor))
                active_[i] = 0;
            is_done = is_done && active_[i] == 0;
        }
        return is_done;
    }

    [[nodiscard]] bool must_stop() const {
        using Seconds = std::chrono::duration<double>;
        return control_.stop.stop_requested()
               || (settings_.time_limit
                   && Seconds(std::chrono::steady_clock::now() - start_)
                          > *settings_.time_limit);
    }

    LuminanceResults collect(bool interrupted) const {
        LuminanceResults results;
        results.confidence = settings_.confidence;
        results.interrupted = interrupted;
        results.converged = true;
        results.counts = ray_counts_;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            results.rays.push_back({total_of(i),
                                    estimate_of(i, [](const Parts& p) { return p.luminaires; }),
                                    estimate_of(i, [](const Parts& p) { return p.direct; }),
                                    estimate_of(i, [](const Parts& p) { return p.indirect; }),
                                    active_[i] == 0});
            results.converged = results.converged && active_[i] == 0;
        }
        return results;
    }

    const Scene& scene_;
    std::span<const SightLine> lines_;
    const Settings& settings_;
    const Control& control_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    Emission emission_;
    MirrorImages images_;
    DirectLight direct_;
    DoubleLocalEstimator estimator_;
    SeenEffort effort_;
    EffectiveCounts counts_;
    std::size_t paths_ = 1024;
    double edge_ = 0.0;
    std::vector<Parts> sums_; ///< [line][replicate]
    std::vector<std::size_t> units_;
    std::vector<std::uint8_t> active_;
    RayCounts ray_counts_;
};

} // namespace

LuminanceResults estimate_luminances(const Scene& scene,
                                     std::span<const SightLine> lines,
                                     const Settings& settings,
                                     const Control& control) {
    return LuminanceCalculation(scene, lines, settings, control).run();
}

} // namespace isolux
