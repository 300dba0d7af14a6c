#include "isolux/calc/engine.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "isolux/base/parallel.h"
#include "isolux/transport/gather.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/path_tracer.h"

namespace isolux {

namespace {

/// Paths of the pilot that measures the mean chain length.
constexpr std::size_t pilot_paths = 512;
constexpr std::uint32_t pilot_replicate = 0xfffffeU;

/// METHODS "Edges": nearer to the second surface than this times sqrt(A / M) a point is traced.
constexpr double edge_factor = 0.4;

/// ... but no farther than this, m: beyond it LE-MIS is the better estimator whatever A is.
constexpr double widest_edge = 0.5;

/// A receiver this near to a foreign surface is flagged, m.
constexpr double too_near = 1e-3;

/// Light paths a replicate's unit should walk for so many points: the cost of the paths is
/// shared by the points, METHODS "Choosing M, K, N2".
std::size_t paths_for(std::size_t points) {
    const double wanted =
        128.0 * std::sqrt(static_cast<double>(std::max<std::size_t>(points, 1)));
    return std::clamp<std::size_t>(std::bit_ceil(static_cast<std::size_t>(wanted)), 256, 8192);
}

/// Gather rays a point should send: a point among few is worth as much work as the paths cost
/// it.
std::size_t directions_for(std::size_t points, std::size_t paths) {
    return std::clamp<std::size_t>(
        std::bit_floor(paths / std::max<std::size_t>(points, 1)), 4, 16);
}

/// A degenerate sample counts as zero and is told about; it never reaches a sum as it is.
double finite_lux(const Rgb& e, RayCounts& rays) noexcept {
    const double lux = luminance_sum(e);
    if (std::isfinite(lux))
        return lux;
    ++rays.degenerate;
    return 0.0;
}

/// Receivers that lie on a surface are moved off it when the estimators' own offset along a
/// plane's normal would not do: bodies without a normal, and planes at right angles to the
/// surface.
Point3 moved_off(const Receiver& receiver, const SurfaceDistances& d) noexcept {
    constexpr double on_surface = 1e-5;
    constexpr double clear = 4e-5;
    if (d.nearest > on_surface)
        return receiver.point;
    const double along = dot(receiver.axis, d.nearest_normal);
    if (receiver.kind == IlluminanceKind::planar && std::abs(along) > 0.5)
        return receiver.point;
    const bool looks_back = receiver.kind != IlluminanceKind::mean_spherical && along < -1e-6;
    return receiver.point + (looks_back ? -clear : clear) * Vector3(d.nearest_normal);
}

} // namespace

Engine::Engine(const Scene& scene, const Settings& settings)
    : scene_(&scene), settings_(settings), emission_(scene), images_(scene),
      direct_(scene, emission_, images_) {}

void Engine::adapt(std::span<const std::size_t> active) {
    const auto by_paths = static_cast<std::size_t>(
        std::count_if(active.begin(), active.end(), [&](std::size_t i) {
            return estimators_[i] != PointEstimator::path_tracing;
        }));
    needs_paths_ = !settings_.direct_only && by_paths > 0;
    fix_directions(by_paths);
}

void Engine::fix_directions(std::size_t points) {
    effort_.directions = directions_for(points, effort_.paths);
    const double paths = static_cast<double>(effort_.paths);
    const double directions = static_cast<double>(effort_.directions);
    counts_ = {paths, paths * vertices_per_path_, directions, directions};
}

void Engine::prepare(std::vector<Receiver> receivers) {
    receivers_ = std::move(receivers);
    effort_.paths = paths_for(receivers_.size());

    // Mean number of vertices of a path: a constant of the run, never a replicate's own count.
    if (emission_.total_flux() > 0.0) {
        const VertexCache pilot =
            build_vertex_cache(*scene_,
                               emission_,
                               PathRandomness(settings_.seed, pilot_replicate),
                               0,
                               pilot_paths,
                               EffectiveCounts{});
        vertices_per_path_ = std::max(0.01, static_cast<double>(pilot.size()) / pilot_paths);
    }
    fix_directions(receivers_.size());

    // Which points are traced instead: a matter of geometry only, so it biases nothing.
    plans_.assign(receivers_.size(), {});
    estimators_.assign(receivers_.size(), PointEstimator::mis);
    near_surface_.assign(receivers_.size(), 0);
    const double edge = std::min(
        widest_edge,
        edge_factor * std::sqrt(scene_->total_area / static_cast<double>(effort_.paths)));
    for_each_index(receivers_.size(), 64, [&](std::size_t i) {
        Receiver& receiver = receivers_[i];
        const SurfaceDistances d = scene_->caster.find_nearest_surfaces(
            receiver.point, std::max(edge, 2.0 * too_near));
        near_surface_[i] = d.second < too_near ? 1 : 0;
        receiver.point = moved_off(receiver, d);
        switch (settings_.estimator) {
        case Estimator::local_estimation:
            estimators_[i] = PointEstimator::local;
            break;
        case Estimator::path_tracing:
            estimators_[i] = PointEstimator::path_tracing;
            break;
        case Estimator::local_estimation_mis:
            break;
        case Estimator::automatic:
            if (d.second < edge)
                estimators_[i] = PointEstimator::path_tracing;
            break;
        }
    });
    needs_paths_ = !settings_.direct_only
                   && std::any_of(estimators_.begin(), estimators_.end(), [](PointEstimator e) {
                          return e != PointEstimator::path_tracing;
                      });
}

VertexCache Engine::build_cache(std::uint32_t replicate, std::uint32_t unit) const {
    return build_vertex_cache(*scene_,
                              emission_,
                              PathRandomness(settings_.seed, replicate),
                              static_cast<std::uint64_t>(unit) * effort_.paths,
                              effort_.paths,
                              counts_);
}

void Engine::estimate_indirect(const VertexCache& cache,
                               std::size_t first,
                               std::uint32_t replicate,
                               std::uint32_t unit,
                               std::span<double> result,
                               RayCounts& rays) const {
    thread_local std::vector<float> scratch;
    const RandomStream subset(settings_.seed, StreamPurpose::subset, replicate);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const std::size_t index = first + i;
        const Receiver& receiver = receivers_[index];
        const PointRandomness random(settings_.seed, StreamPurpose::gather, replicate, index);
        Rgb e;
        if (estimators_[index] == PointEstimator::path_tracing) {
            e = trace_indirect(*scene_,
                               emission_,
                               images_,
                               receiver,
                               effort_.samples,
                               static_cast<std::uint32_t>(unit * effort_.samples),
                               random,
                               rays.gather);
        } else {
            const bool alone = estimators_[index] == PointEstimator::local;
            e = gather_local_estimate(*scene_,
                                      cache,
                                      receiver,
                                      alone ? Weighting::alone : Weighting::balanced,
                                      effort_.draws,
                                      subset.uniform(index, unit),
                                      scratch);
            rays.shadow += effort_.draws;
            if (!alone || images_.scene_has_mirrors())
                e += gather_indirect(*scene_,
                                     emission_,
                                     images_,
                                     cache,
                                     counts_,
                                     receiver,
                                     alone ? GatherPart::mirrors_only : GatherPart::balanced,
                                     effort_.directions,
                                     static_cast<std::uint32_t>(unit * effort_.directions),
                                     random,
                                     rays.gather);
        }
        result[i] = finite_lux(e, rays);
    }
}

void Engine::plan_direct(std::size_t index, RayCounts& rays) {
    if (!plans_[index].is_made)
        plans_[index] =
            direct_.plan(receivers_[index], index, settings_.seed, false, rays.shadow);
}

void Engine::estimate_direct(std::size_t index,
                             std::uint32_t unit,
                             std::uint32_t first_replicate,
                             std::span<double> result,
                             RayCounts& rays) const {
    thread_local std::vector<Rgb> values;
    values.assign(result.size(), {});
    direct_.estimate(receivers_[index],
                     plans_[index],
                     index,
                     settings_.seed,
                     unit,
                     first_replicate,
                     {values, {}, {}},
                     rays.shadow);
    for (std::size_t r = 0; r < result.size(); ++r)
        result[r] = finite_lux(values[r], rays);
}

std::string Engine::describe() const {
    const auto count = [&](PointEstimator e) {
        return std::to_string(std::count(estimators_.begin(), estimators_.end(), e));
    };
    std::string text = "light paths per replicate and unit: " + std::to_string(effort_.paths);
    switch (settings_.estimator) {
    case Estimator::local_estimation:
        return "local estimation; " + text;
    case Estimator::path_tracing:
        return "path tracing from the points";
    default:
        return "local estimation with one gather bounce (" + count(PointEstimator::mis)
               + " points), path tracing next to edges (" + count(PointEstimator::path_tracing)
               + " points); " + text;
    }
}

} // namespace isolux
