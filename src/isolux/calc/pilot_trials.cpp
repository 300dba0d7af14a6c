#include <algorithm>

#include "isolux/base/estimate.h"
#include "isolux/base/parallel.h"
#include "isolux/calc/pilot.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/walk_front.h"

namespace isolux {

namespace {

constexpr std::size_t tile = 16;
constexpr std::uint32_t first_trial = 1U << 16U; ///< number of the first sample of a trial

} // namespace

double find_cost_of_cut(const PilotScene& task, const PathImportance& importance) {
    constexpr std::size_t trial_paths = 16384;
    constexpr std::size_t trial_tiles = 32;
    constexpr double row_cost = 40.0; // of a tile's cut, for each of its points, ns
    if (task.emission->total_flux() <= 0.0)
        return 0.0;
    const VertexCache cache = build_vertex_cache(
        *task.scene,
        *task.emission,
        PathRandomness(task.seed, first_pilot_replicate + most_pilot_replicates),
        0,
        trial_paths,
        EffectiveCounts{},
        importance,
        {},
        Weighing::tree);
    if (cache.tree.empty())
        return 0.0;
    const std::size_t tiles = task.receivers.size() / tile;
    TreeScratch scratch;
    std::vector<TreePoint> points;
    double rows = 0.0;
    for (std::size_t k = 0; k < trial_tiles; ++k) {
        const std::size_t first = (2 * k + 1) * tiles / (2 * trial_tiles) * tile;
        points.clear();
        for (std::size_t i = first; i < first + tile; ++i)
            points.push_back(
                {make_kernel_receiver(cache, task.receivers[i], task.clear[i]), task.clear[i]});
        cut_tree(cache, points, task.receivers[first].kind, scratch);
        rows += static_cast<double>(scratch.cut.rows()) / trial_tiles;
    }
    return row_cost * (1.0 + rows);
}

std::vector<TracingTrial> try_tracing(const PilotScene& task,
                                      std::span<const std::size_t> receivers,
                                      std::size_t samples,
                                      std::size_t replicates) {
    std::vector<double> values(receivers.size() * replicates); // [receiver][replicate]
    const std::size_t tiles = (receivers.size() + tile - 1) / tile;
    for_each_index(tiles * replicates, 1, [&](std::size_t k) {
        const std::size_t r = k / tiles;
        const std::size_t begin = k % tiles * tile;
        const std::size_t end = std::min(receivers.size(), begin + tile);
        std::vector<RayPoint> senders;
        for (std::size_t p = begin; p < end; ++p)
            senders.push_back({&task.receivers[receivers[p]],
                               task.clear[receivers[p]],
                               {task.seed,
                                StreamPurpose::pilot,
                                first_pilot_replicate + static_cast<std::uint32_t>(r),
                                receivers[p]},
                               samples,
                               first_trial});
        std::vector<Rgb> sums(senders.size());
        WalkFront front;
        front.start(*task.scene, *task.emission, *task.images, senders);
        front.add_tracing();
        front.run({sums, nullptr, {}, {}});
        for (std::size_t p = begin; p < end; ++p)
            values[p * replicates + r] = luminance_sum(sums[p - begin]);
    });
    std::vector<TracingTrial> trials;
    for (std::size_t p = 0; p < receivers.size(); ++p) {
        const Estimate e =
            estimate_from_replicates(std::span(values).subspan(p * replicates, replicates));
        trials.push_back(
            {e.mean,
             static_cast<double>(samples * replicates) * e.standard_error * e.standard_error});
    }
    return trials;
}

} // namespace isolux
