#pragma once

#include <span>
#include <vector>

#include "isolux/base/receiver.h"
#include "isolux/transport/light_path.h"

namespace isolux {

/// How the local estimate shares paths with the gather rays.
enum class Weighting {
    alone,    ///< plain local estimation: every vertex counts in full, METHODS eq. (6)
    balanced, ///< balance heuristic against gather rays, METHODS eq. (10)
};

/// The place rays to and from a receiver start at: a plane's point is moved off whatever it
/// lies on.
[[nodiscard]] Point3 clear_point(const Scene& scene, const Receiver& receiver) noexcept;

/// Unshadowed local estimate of every vertex at the receiver, lm/m2 before division by the
/// number of paths, times its weight: METHODS "Shared cache", step 1. No rays.
/// @param u  at least cache.x.size() values; the padding becomes 0
void evaluate_unshadowed(const VertexCache& cache,
                         const Receiver& receiver,
                         const Point3& at,
                         Weighting weighting,
                         std::span<float> u) noexcept;

/// Local estimate of illuminance from a shared cache, METHODS eq. (5), (6), (10): all vertices
/// are weighed, `draws` of them, in proportion, are looked at through the scene.
///
/// @param draws    shadow rays, at most packet_size
/// @param offset   number in [0, 1): the one random offset of the systematic draw
/// @param scratch  working memory, reused between calls
/// @return         lx per channel; direct light is not included
/// @pre            the vertices lie on surfaces of `scene`
/// With Weighting::alone the variance grows without bound as a vertex nears the receiver; see
/// METHODS. Source: Budak, Zheltov, Kalakutsky 2012, doi:10.20537/2076-7633-2012-4-1-75-84.
[[nodiscard]] Rgb gather_local_estimate(const Scene& scene,
                                        const VertexCache& cache,
                                        const Receiver& receiver,
                                        Weighting weighting,
                                        std::size_t draws,
                                        double offset,
                                        std::vector<float>& scratch);

} // namespace isolux
