#include <algorithm>
#include <cmath>
#include <utility>

#include "isolux/calc/engine.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/walk_front.h"

/// What units of work are made of: light paths, and what points get by them, by rays of their
/// own and straight from the luminaires.
namespace isolux {

namespace {

constexpr std::size_t study_samples = 8; ///< pairs of subpaths of a bidirectional unit

/// Light paths of a unit that no point takes: they tell where the flux goes.
constexpr std::size_t paths_of_a_balance = 2048;

/// A degenerate sample counts as zero and is told about; it never reaches a sum as it is.
double finite_lux(const Rgb& e, RayCounts& rays) noexcept {
    const double lux = luminance_sum(e);
    if (std::isfinite(lux))
        return lux;
    ++rays.degenerate;
    return 0.0;
}

} // namespace

VertexCache
Engine::build_cache(std::uint32_t replicate, std::uint32_t unit, VertexCache used) const {
    const std::size_t paths =
        needs_paths_ ? effort_.paths : std::min(effort_.paths, paths_of_a_balance);
    return build_vertex_cache(*scene_,
                              emission_,
                              PathRandomness(settings_.seed, replicate),
                              static_cast<std::uint64_t>(unit) * effort_.paths,
                              paths,
                              counts_,
                              pilot_.importance,
                              {},
                              effort_.weighing,
                              std::move(used));
}

void Engine::estimate_local(const TileWork& work, Weighting weighting) const {
    thread_local LocalScratch scratch;
    thread_local std::vector<LocalPoint> locals;
    thread_local std::vector<Rgb> sums;
    const RandomStream subset(settings_.seed, StreamPurpose::subset, work.replicate);
    locals.clear();
    for (const std::size_t i : work.points) {
        const PointEffort& effort = effort_of(i);
        locals.push_back({&receivers_[i],
                          clear_[i],
                          subset.uniform(i, work.unit),
                          effort.draws,
                          gathers(i) ? static_cast<double>(effort.directions) : 0.0,
                          is_within(i, counts_.corner),
                          counts_.caustic > 0.0 && gathers(i)});
        work.rays.shadow += effort.draws;
    }
    sums.assign(work.points.size(), {});
    const auto draws =
        gather_local_estimates(*scene_, work.cache, locals, weighting, scratch, sums);
    for (std::size_t k = 0; k < work.points.size(); ++k)
        work.tile.total[work.points[k] - work.first] += sums[k];
    if (!work.tile.by_source.empty() || work.tile.wants_trails())
        for (const LocalDraw& draw : draws) {
            const std::size_t point = work.points[draw.point] - work.first;
            work.tile.add_to_source(
                point, work.cache.vertices[draw.vertex].luminaire, draw.light);
            if (!work.tile.wants_trails())
                continue;
            const double lux = luminance_sum(draw.light);
            visit_chain(work.cache, draw.vertex, [&](MaterialId m) {
                work.tile.add_reflection(point, m, lux);
            });
        }
}

void Engine::send_rays(const TileWork& work, PointEstimator estimator) const {
    thread_local WalkFront front;
    thread_local std::vector<RayPoint> senders;
    thread_local std::vector<Rgb> sums;
    thread_local std::vector<double> by_source;
    thread_local std::vector<double> by_material;
    const bool traces = estimator == PointEstimator::path_tracing;
    const bool has_mirrors = images_.scene_has_mirrors();
    std::size_t rounds = 1;
    for (const std::size_t i : work.points)
        rounds = traces ? std::max(rounds, rounds_of(i)) : 1;
    for (std::size_t round = 0; round < rounds; ++round) {
        senders.clear();
        for (const std::size_t i : work.points) {
            const bool takes_part = traces ? round < rounds_of(i) : gathers(i) || has_mirrors;
            const std::size_t samples = traces ? samples_[i] : effort_of(i).directions;
            // A point that changes shares no number with what it had before.
            const std::uint32_t begin = traces && began_[i] != unchanged ? began_[i] : 0;
            senders.push_back({&receivers_[i],
                               clear_[i],
                               {settings_.seed,
                                traces ? StreamPurpose::tracing : StreamPurpose::gather,
                                work.replicate,
                                i},
                               !takes_part ? 0
                               : traces    ? std::min<std::size_t>(samples, samples_at_once)
                                           : samples,
                               static_cast<std::uint32_t>((work.unit - begin) * samples
                                                          + round * samples_at_once),
                               is_within(i, counts_.corner),
                               estimator == PointEstimator::mis && gathers(i),
                               counts_.caustic > 0.0 && gathers(i)});
        }
        sums.assign(work.points.size(), {});
        front.start(*scene_, emission_, images_, senders);
        if (traces) {
            front.add_tracing();
        } else {
            front.share_with(work.cache, counts_);
            front.add_gathering();
        }
        // The points may be some of the tile's only.
        const std::size_t n = work.points.size();
        const std::size_t tile_points = work.tile.total.size();
        by_source.assign(work.tile.by_source.size() / tile_points * n, 0.0);
        by_material.assign(work.tile.by_material.size() / tile_points * n, 0.0);
        work.rays.gather += front.run({sums, layout_, by_source, by_material});
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t point = work.points[k] - work.first;
            const double share =
                traces ? 1.0 / static_cast<double>(rounds_of(work.points[k])) : 1.0;
            work.tile.total[point] += share * sums[k];
            for (std::size_t s = 0; s < by_source.size() / n; ++s)
                work.tile.by_source[s * tile_points + point] += share * by_source[s * n + k];
            for (std::size_t m = 0; m < by_material.size() / n; ++m)
                work.tile.by_material[m * tile_points + point] +=
                    share * by_material[m * n + k];
        }
    }
}

/// Traced paths of a point go in rounds, so that few are on their way at once.
std::size_t Engine::rounds_of(std::size_t receiver) const noexcept {
    return std::max<std::size_t>(1, samples_[receiver] / samples_at_once);
}

void Engine::estimate_indirect(const VertexCache& cache,
                               std::size_t first,
                               std::span<const std::uint8_t> open,
                               std::uint32_t replicate,
                               std::uint32_t unit,
                               std::span<double> result,
                               RayCounts& rays,
                               const BookEntries& books) const {
    thread_local std::vector<Rgb> light;
    thread_local std::vector<std::size_t> points;
    light.assign(result.size(), {});
    const LightLedger tile{light, layout_, books.by_source, books.by_material};
    const RandomStream subset(settings_.seed, StreamPurpose::subset, replicate);
    for (const PointEstimator estimator :
         {PointEstimator::local, PointEstimator::mis, PointEstimator::path_tracing}) {
        points.clear();
        for (std::size_t i = first; i < first + result.size(); ++i)
            if (estimators_[i] == estimator && (open.empty() || open[i - first] != 0))
                points.push_back(i);
        if (points.empty())
            continue;
        const TileWork work{cache, points, first, replicate, unit, tile, rays};
        const bool alone = estimator == PointEstimator::local;
        if (estimator != PointEstimator::path_tracing)
            estimate_local(work, alone ? Weighting::alone : Weighting::balanced);
        if (!alone || images_.scene_has_mirrors())
            send_rays(work, estimator);
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (estimators_[first + i] == PointEstimator::study && (open.empty() || open[i] != 0))
            light[i] = study_.estimate(
                *scene_,
                emission_,
                images_,
                cache,
                receivers_[first + i],
                first + i,
                replicate,
                unit,
                {effort_of(first + i).draws, effort_of(first + i).directions, study_samples},
                subset.uniform(first + i, unit),
                rays);
        const std::uint64_t before = rays.degenerate;
        result[i] = finite_lux(light[i], rays);
        if (rays.degenerate == before)
            continue;
        for (std::size_t k = i; k < books.by_source.size(); k += result.size())
            books.by_source[k] = 0.0;
        for (std::size_t k = i; k < books.by_material.size(); k += result.size())
            books.by_material[k] = 0.0;
    }
}

void Engine::plan_direct(std::size_t index, RayCounts& rays) {
    if (!plans_[index].is_made)
        plans_[index] = direct_.plan(receivers_[index],
                                     index,
                                     settings_.seed,
                                     layout_ != nullptr && !layout_->source_of.empty(),
                                     rays.shadow);
}

void Engine::estimate_direct(std::size_t index,
                             std::uint32_t unit,
                             std::uint32_t first_replicate,
                             std::span<double> result,
                             RayCounts& rays,
                             std::span<double> by_source) const {
    thread_local std::vector<Rgb> values;
    values.assign(result.size(), {});
    direct_.estimate(receivers_[index],
                     plans_[index],
                     index,
                     settings_.seed,
                     unit,
                     {static_cast<std::uint32_t>(effort_of(index).looks), ambient_of(index)},
                     first_replicate,
                     {values, layout_, by_source, {}},
                     rays.shadow);
    for (std::size_t r = 0; r < result.size(); ++r) {
        const std::uint64_t before = rays.degenerate;
        result[r] = finite_lux(values[r], rays);
        for (std::size_t k = r; rays.degenerate != before && k < by_source.size();
             k += result.size())
            by_source[k] = 0.0;
    }
}

} // namespace isolux
