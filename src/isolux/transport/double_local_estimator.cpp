#include "isolux/transport/double_local_estimator.h"

#include "isolux/transport/gather.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/path_tracer.h"

namespace isolux {

ReflectedBy DoubleLocalEstimator::choose(const SeenSurface& seen, double edge) const noexcept {
    const SurfaceDistances d = scene_->caster.find_nearest_surfaces(seen.at, edge);
    return d.second < edge ? ReflectedBy::path_tracing : ReflectedBy::mis;
}

Rgb DoubleLocalEstimator::reflected(const SeenSurface& seen,
                                    ReflectedBy by,
                                    const VertexCache& cache,
                                    const EffectiveCounts& counts,
                                    const SeenEffort& effort,
                                    const SeenKey& key,
                                    std::uint64_t& rays) const {
    thread_local LocalScratch scratch;
    const Receiver receiver = receiver_at(seen);
    const PointRandomness random(key.seed, StreamPurpose::gather, key.replicate, key.place);
    if (by == ReflectedBy::path_tracing)
        return trace_indirect(*scene_,
                              *emission_,
                              *images_,
                              receiver,
                              effort.samples,
                              key.unit * static_cast<std::uint32_t>(effort.samples),
                              random,
                              rays);
    const RandomStream subset(key.seed, StreamPurpose::subset, key.replicate);
    const bool alone = by == ReflectedBy::local;
    const LocalPoint point{&receiver,
                           clear_point(*scene_, receiver),
                           subset.uniform(key.place, key.unit),
                           effort.draws,
                           static_cast<double>(effort.directions)};
    Rgb e;
    gather_local_estimates(*scene_,
                           cache,
                           {&point, 1},
                           alone ? Weighting::alone : Weighting::balanced,
                           scratch,
                           {&e, 1});
    rays += effort.draws;
    if (!alone || images_->scene_has_mirrors())
        e += gather_indirect(*scene_,
                             *emission_,
                             *images_,
                             cache,
                             counts,
                             receiver,
                             alone ? GatherPart::mirrors_only : GatherPart::balanced,
                             effort.directions,
                             key.unit * static_cast<std::uint32_t>(effort.directions),
                             random,
                             rays);
    return e;
}

} // namespace isolux
