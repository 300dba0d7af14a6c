#pragma once

#include <array>
#include <span>
#include <vector>

#include "isolux/transport/tree_draws.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// The place rays to and from a receiver start at: a plane's point is moved off whatever it
/// lies on.
[[nodiscard]] Point3 clear_point(const Scene& scene, const Receiver& receiver) noexcept;

/// A receiver as the kernel sees it from a cache. @param at  where its rays start
/// @param rays  gather rays of it that share its paths
[[nodiscard]] KernelReceiver make_kernel_receiver(const VertexCache& cache,
                                                  const Receiver& receiver,
                                                  const Point3& at,
                                                  double rays = 1.0) noexcept;

/// A receiver that takes a local estimate.
struct LocalPoint {
    const Receiver* receiver = nullptr;
    Point3 at;             ///< clear_point of it
    double offset = 0.0;   ///< in [0, 1): the one random offset of the systematic draw
    std::size_t draws = 1; ///< K
    double rays = 1.0;     ///< N2: gather rays that share its paths
    /// Whether paths by two near surfaces are left to walks of the point's own (METHODS eq.
    /// (122)).
    bool leaves_corners = false;
    bool leaves_mirrored = false; ///< the same for what mirrors throw on near surfaces (145)
};

/// What came of one draw: the vertex and the light it adds to one point, lx.
struct LocalDraw {
    std::uint32_t point = 0;
    std::uint32_t vertex = 0; ///< number in VertexCache::vertices
    Rgb light;
};

/// Working memory of one thread, reused between calls.
struct LocalScratch {
    std::vector<float> u;
    std::vector<float> column_sums;
    std::vector<double> block_sums;
    std::vector<std::size_t> rounds; ///< where the next draw k of a point goes
    std::vector<KernelReceiver> receivers;
    std::vector<LocalDraw> draws;
    std::vector<SightSegment> segments;
    TreeScratch tree;
    std::vector<TreePoint> tree_points;
    std::vector<TreeDraw> tree_draws;
};

/// Local estimate of illuminance from a shared cache, METHODS eq. (5), (6), (10), for
/// neighbouring points at once: all vertices are weighed, K of them a point, in proportion, are
/// looked at through the scene; in a cache with a tree clusters are weighed for the rest. Adds
/// to `result`, lx per channel; direct light is not included.
///
/// @return  the draws that brought light; they live in `scratch`
/// @pre     K >= 1; the vertices lie on surfaces of `scene`; as many results as points
/// With Weighting::alone the variance grows without bound as a vertex nears the receiver; see
/// METHODS. Source: Budak, Zheltov, Kalakutsky 2012, doi:10.20537/2076-7633-2012-4-1-75-84.
std::span<const LocalDraw> gather_local_estimates(const Scene& scene,
                                                  const VertexCache& cache,
                                                  std::span<const LocalPoint> points,
                                                  Weighting weighting,
                                                  LocalScratch& scratch,
                                                  std::span<Rgb> result);

} // namespace isolux
