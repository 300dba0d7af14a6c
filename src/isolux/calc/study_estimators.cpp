#include "isolux/calc/study_estimators.h"

#include <algorithm>
#include <limits>

#include "isolux/base/parallel.h"
#include "isolux/transport/bidirectional.h"
#include "isolux/transport/bounded_estimator.h"
#include "isolux/transport/local_estimator.h"

namespace isolux {

void StudyEstimators::prepare(const Scene& scene,
                              const Settings& settings,
                              std::span<const Receiver> receivers,
                              const VertexCache& pilot) {
    settings_ = settings;
    bounds_.clear();
    heads_.clear();
    if (settings.estimator == Estimator::bounded) {
        bounds_.resize(receivers.size());
        for_each_index(receivers.size(), 16, [&](std::size_t i) {
            bounds_[i] = choose_bound(pilot, receivers[i], clear_point(scene, receivers[i]));
        });
    }
    if (settings.estimator == Estimator::photometer_head) {
        heads_.resize(receivers.size());
        for_each_index(receivers.size(), 16, [&](std::size_t i) {
            if (receivers[i].kind == IlluminanceKind::planar)
                heads_[i] =
                    make_photometer_head(scene, receivers[i], settings.photometer_head_radius);
        });
    }
}

Rgb StudyEstimators::estimate(const Scene& scene,
                              const Emission& emission,
                              const MirrorImages& images,
                              const VertexCache& cache,
                              const Receiver& receiver,
                              std::size_t index,
                              std::uint32_t replicate,
                              std::uint32_t unit,
                              const Work& work,
                              double offset,
                              RayCounts& rays) const {
    const PointRandomness random(settings_.seed, StreamPurpose::gather, replicate, index);
    const auto first_of = [&](std::size_t a_unit) {
        return static_cast<std::uint32_t>(unit * a_unit);
    };
    if (settings_.estimator == Estimator::bidirectional)
        return trace_bidirectional(scene,
                                   emission,
                                   images,
                                   receiver,
                                   work.samples,
                                   first_of(work.samples),
                                   random,
                                   rays.gather);
    rays.shadow += work.draws;
    // Behind mirrors and above a bound rays are sent; a point without a head is a plain point.
    constexpr double none = std::numeric_limits<double>::infinity();
    const double bound = settings_.estimator == Estimator::bounded ? bounds_[index] : none;
    Rgb e;
    if (settings_.estimator == Estimator::bounded || heads_[index].outline.empty()) {
        e = estimate_below_bound(scene, cache, receiver, bound, work.draws, offset);
    } else {
        const PointRandomness places(
            settings_.seed, StreamPurpose::selection, replicate, index);
        e = estimate_at_head(scene,
                             cache,
                             receiver,
                             heads_[index],
                             work.draws,
                             offset,
                             first_of(work.draws),
                             places);
    }
    if (bound < none || images.scene_has_mirrors())
        e += gather_above_bound(scene,
                                emission,
                                images,
                                receiver,
                                bound,
                                work.directions,
                                first_of(work.directions),
                                random,
                                rays.gather);
    return e;
}

std::size_t StudyEstimators::cut_heads() const noexcept {
    return static_cast<std::size_t>(
        std::ranges::count_if(heads_, [](const PhotometerHead& h) { return h.is_cut; }));
}

std::size_t StudyEstimators::without_head() const noexcept {
    return static_cast<std::size_t>(std::ranges::count_if(
        heads_, [](const PhotometerHead& h) { return h.outline.empty(); }));
}

} // namespace isolux
