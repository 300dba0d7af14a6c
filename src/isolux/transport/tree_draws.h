#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// A point that draws vertices by the tree.
struct TreePoint {
    KernelReceiver receiver;
    Point3 at;
    double offset = 0.0; ///< in [0, 1)
    std::size_t draws = 1;
    bool leaves_corners = false;  ///< METHODS eq. (122)
    bool leaves_mirrored = false; ///< METHODS eq. (145)

    [[nodiscard]] bool leaves_any() const noexcept { return leaves_corners || leaves_mirrored; }
};

/// One draw: a place in the blocks, and the sum of u of all vertices over the number of draws
/// as this draw has it. A share of 0: it brings nothing.
struct TreeDraw {
    std::uint32_t place = 0;
    double share = 0.0; ///< lm/m2
};

/// Where the tree is cut for some neighbouring points: clusters that look small from all of
/// them, and the vertices of those lowest clusters that do not; in both neighbours stand
/// together.
struct TreeCut {
    struct Place {
        std::uint32_t index = 0; ///< of a cluster in its level
        std::uint8_t level = 0;
    };

    std::vector<ClusterRow> clusters;  ///< more of them than are in use
    std::vector<Place> places;         ///< of the clusters in use, [row][16]
    std::vector<std::uint32_t> leaves; ///< of level 0: each a row of vertices

    /// In use: of clusters, then one for each of the leaves.
    [[nodiscard]] std::size_t cluster_rows() const noexcept {
        return (places.size() + ClusterRow::size - 1) / ClusterRow::size;
    }

    [[nodiscard]] std::size_t rows() const noexcept { return cluster_rows() + leaves.size(); }
};

/// Working memory of one thread, reused between calls.
struct TreeScratch {
    /// A draw on its way down.
    struct Descent {
        std::uint32_t point = 0;
        std::uint32_t draw = 0;
        TreeCut::Place cluster;
        double left = 0.0;  ///< random number that is left, in [0, 1)
        double share = 0.0; ///< of the draw, as if the cluster's u were exact
        float u = 0.0F;     ///< that of the cluster
    };

    TreeCut cut;
    std::vector<TreeCut::Place> waiting;
    std::vector<KernelReceiver> receivers;
    std::vector<float> u;
    std::vector<float> sums;
    std::vector<Descent> descents;
    std::vector<RowOfTree> members; ///< of the clusters that draws have come to
    std::vector<float> member_u;
};

/// Cuts the tree for points of one kind.
void cut_tree(const VertexCache& cache,
              std::span<const TreePoint> points,
              IlluminanceKind kind,
              TreeScratch& scratch);

/// Draws vertices for neighbouring points of one kind with chances nearly in proportion to u:
/// METHODS "Vertex tree", eq. (137), (138).
/// @param draws  point by point, `TreePoint::draws` of each
/// @pre cache.tree is not empty
void draw_by_tree(const VertexCache& cache,
                  std::span<const TreePoint> points,
                  IlluminanceKind kind,
                  Weighting weighting,
                  TreeScratch& scratch,
                  std::span<TreeDraw> draws);

} // namespace isolux
