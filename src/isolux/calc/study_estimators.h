#pragma once

#include <span>
#include <vector>

#include "isolux/calc/project.h"
#include "isolux/calc/results.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/photometer_head.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// The estimators that are there for comparison and study, METHODS 2.4: a photometer head, a
/// bounded kernel, bidirectional path tracing. Holds what they need to know of every receiver.
class StudyEstimators {
public:
    [[nodiscard]] static bool serves(Estimator estimator) noexcept {
        return estimator == Estimator::photometer_head || estimator == Estimator::bounded
               || estimator == Estimator::bidirectional;
    }

    /// @param pilot  vertices of paths that no replicate uses
    void prepare(const Scene& scene,
                 const Settings& settings,
                 std::span<const Receiver> receivers,
                 const VertexCache& pilot);

    /// How much one unit of one replicate does at a receiver.
    struct Work {
        std::size_t draws = 16;
        std::size_t directions = 4;
        std::size_t samples = 8; ///< bidirectional
    };

    /// Illuminance that is not direct, lx per channel.
    /// @param offset  number in [0, 1) for the systematic draw
    [[nodiscard]] Rgb estimate(const Scene& scene,
                               const Emission& emission,
                               const MirrorImages& images,
                               const VertexCache& cache,
                               const Receiver& receiver,
                               std::size_t index,
                               std::uint32_t replicate,
                               std::uint32_t unit,
                               const Work& work,
                               double offset,
                               RayCounts& rays) const;

    /// Receivers whose head is cut by an edge, or that have none because they are no planes.
    [[nodiscard]] std::size_t cut_heads() const noexcept;
    [[nodiscard]] std::size_t without_head() const noexcept;

private:
    Settings settings_;
    std::vector<double> bounds_;        ///< Estimator::bounded
    std::vector<PhotometerHead> heads_; ///< Estimator::photometer_head
};

} // namespace isolux
