#pragma once

#include <numbers>
#include <vector>

#include "isolux/base/parallel.h"
#include "isolux/transport/gather.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/mirror_images.h"

#include "support/replicates.h"

/// LE-MIS put together by hand from the transport functions, so that a test can turn one screw
/// of it and leave the rest as it is.
namespace isolux::test {

struct SmallEngine {
    const Scene& scene;
    Emission emission{scene};
    MirrorImages images{scene};
    std::size_t paths = 256;
    std::size_t draws = 16;
    std::size_t directions = 4;
    std::uint32_t batches = 1;      ///< of `paths` light paths each, averaged to one replicate
    double vertices_per_path = 1.0; ///< the constant of METHODS eq. (11)
    Roulette roulette;
    PathImportance importance;

    explicit SmallEngine(const Scene& of) : scene(of) {
        const VertexCache pilot = build_vertex_cache(
            scene, emission, PathRandomness(99, 7777), 0, 4096, EffectiveCounts{});
        vertices_per_path = static_cast<double>(pilot.size()) / 4096.0;
    }

    [[nodiscard]] EffectiveCounts counts() const {
        const double m = static_cast<double>(paths);
        return {m, m * vertices_per_path, 1.0, 1.0, 0.0, scene.total_area};
    }

    [[nodiscard]] VertexCache cache(std::uint64_t seed,
                                    std::uint32_t replicate,
                                    const EffectiveCounts& of_weights) const {
        return build_vertex_cache(scene,
                                  emission,
                                  PathRandomness(seed, replicate),
                                  0,
                                  paths,
                                  of_weights,
                                  importance,
                                  roulette);
    }

    [[nodiscard]] double local(const VertexCache& vertices,
                               const Receiver& receiver,
                               std::size_t index,
                               std::uint64_t seed,
                               std::uint32_t replicate,
                               Weighting weighting = Weighting::balanced) const {
        const RandomStream subset(seed, StreamPurpose::subset, replicate);
        const LocalPoint point{&receiver,
                               clear_point(scene, receiver),
                               subset.uniform(index, 0),
                               draws,
                               static_cast<double>(directions)};
        LocalScratch scratch;
        Rgb light;
        gather_local_estimates(scene, vertices, {&point, 1}, weighting, scratch, {&light, 1});
        return luminance_sum(light);
    }

    [[nodiscard]] double gathered(const VertexCache& vertices,
                                  const EffectiveCounts& of_weights,
                                  const Receiver& receiver,
                                  std::size_t index,
                                  std::uint64_t seed,
                                  std::uint32_t replicate) const {
        std::uint64_t rays = 0;
        return luminance_sum(
            gather_indirect(scene,
                            emission,
                            images,
                            vertices,
                            of_weights,
                            receiver,
                            GatherPart::balanced,
                            directions,
                            0,
                            PointRandomness(seed, StreamPurpose::gather, replicate, index),
                            rays));
    }

    /// Calls `add(number, row)` for every replicate and batch: it adds one batch's values to
    /// `row`, one a receiver. Numbers are the replicates of the random streams.
    template <class Add>
    [[nodiscard]] Sample
    sample(const std::vector<Receiver>& receivers, std::size_t replicates, Add&& add) const {
        Sample result;
        result.points = receivers.size();
        result.rows.assign(replicates, std::vector<double>(receivers.size()));
        for_each_index(replicates, 1, [&](std::size_t r) {
            for (std::uint32_t b = 0; b < batches; ++b)
                add(static_cast<std::uint32_t>(r) * batches + b, result.rows[r]);
            for (double& v : result.rows[r])
                v /= batches;
        });
        return result;
    }

    /// LE-MIS with other counts in the local weights than in those of the gather rays; equal
    /// ones are the real thing.
    [[nodiscard]] Sample run(const std::vector<Receiver>& receivers,
                             std::size_t replicates,
                             std::uint64_t seed,
                             const EffectiveCounts& in_w1,
                             const EffectiveCounts& in_w2) const {
        return sample(receivers, replicates, [&](std::uint32_t r, std::vector<double>& row) {
            const VertexCache vertices = cache(seed, r, in_w1);
            for (std::size_t i = 0; i < receivers.size(); ++i)
                row[i] += local(vertices, receivers[i], i, seed, r)
                          + gathered(vertices, in_w2, receivers[i], i, seed, r);
        });
    }

    [[nodiscard]] Sample run(const std::vector<Receiver>& receivers,
                             std::size_t replicates,
                             std::uint64_t seed) const {
        return run(receivers, replicates, seed, counts(), counts());
    }
};

} // namespace isolux::test
