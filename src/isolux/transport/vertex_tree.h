#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/scene/scene.h"
#include "isolux/transport/light_path.h"
#include "isolux/transport/vertex_kernel.h"

namespace isolux {

/// Sixteen clusters of vertices as the vectorised kernel reads them, each with what METHODS eq.
/// (137) needs. Means are weighted by strength; positions are relative to the centre of the
/// cache. An empty place has no strength.
struct alignas(64) ClusterRow {
    static constexpr std::size_t size = 16;
    using Values = std::array<float, size>;

    Values x{}, y{}, z{};    ///< mean position, m
    Values nx{}, ny{}, nz{}; ///< mean normal, shorter than 1 where the normals differ
    Values strength{};       ///< sum, lm/sr
    Values rival{};          ///< a mean of METHODS eq. (60)'s q, m2, not above the true one
    Values sx{}, sy{}, sz{}; ///< standard deviations of the position along the axes, m
    Values lean{};           ///< mean of n·(y - mean position), m
    Values depth{};          ///< its standard deviation, m
    Values wobble{};         ///< sqrt(1 - |mean normal|^2), the spread of the normals
    Values hx{}, hy{}, hz{}; ///< no vertex is farther from the mean along the axes, m
    Values lowest{}; ///< least n·(y - mean) where all share a normal, else -infinity, m
};

/// A row of clusters or of single vertices, for one receiver.
struct RowOfTree {
    const ClusterRow* clusters = nullptr; ///< null: vertices
    const VertexBlock* block = nullptr;
    std::uint32_t row = 0; ///< of the block
    std::uint32_t receiver = 0;
};

/// The vertices of a cache in clusters of 16, 64, 256, ... neighbours (METHODS "Vertex tree").
/// Cluster i of a level holds the clusters 4i .. 4i + 3 of the level below; cluster i of level
/// 0 the vertices 16 i .. 16 i + 15 in the order of the blocks, which is that of the rows.
struct VertexTree {
    std::vector<std::vector<ClusterRow>> levels; ///< rows of 16 clusters; empty: there is none
    /// Of a place: bits that say why a point near to it may leave its vertex out.
    std::vector<std::uint8_t> left;
    static constexpr std::uint8_t close = 1;    ///< METHODS eq. (122)
    static constexpr std::uint8_t mirrored = 2; ///< METHODS eq. (145)

    [[nodiscard]] bool empty() const noexcept { return levels.empty(); }

    static constexpr std::size_t leaf = 16; ///< vertices of a cluster of level 0
    static constexpr std::size_t forks = 4; ///< clusters of the level below
    static constexpr std::size_t roots =
        64; ///< no more clusters than that in the highest level
};

/// Numbers of the vertices in an order in which runs of any length are compact: by the way they
/// face, by layers along it, and on a Hilbert curve in each.
[[nodiscard]] std::vector<std::uint32_t> sort_along_curve(std::span<const PathVertex> vertices,
                                                          const Bounds& bounds);

/// @param blocks  filled row by row in that order  @param count  vertices in them
[[nodiscard]] VertexTree build_vertex_tree(std::span<const VertexBlock> blocks,
                                           std::size_t count);

/// What to weigh for some receivers of one kind: the rows of a cut.
struct CutTask {
    std::span<const ClusterRow> clusters;
    std::span<const VertexBlock> blocks;
    std::span<const std::uint32_t> leaves; ///< clusters of level 0: rows of `blocks`
    IlluminanceKind kind = IlluminanceKind::planar;
    Weighting weighting = Weighting::balanced;
    std::span<const KernelReceiver> receivers;
    std::span<float> u;    ///< [receiver][row][16], lm/m2 as in weigh_vertices; clusters first
    std::span<float> sums; ///< [receiver][row]
};

/// The same, one receiver for each row.
struct RowsTask {
    std::span<const RowOfTree> rows;
    IlluminanceKind kind = IlluminanceKind::planar;
    Weighting weighting = Weighting::balanced;
    std::span<const KernelReceiver> receivers;
    std::span<float> u; ///< [row][16]
};

/// METHODS eq. (137) for clusters, and (60) for single vertices.
void weigh_cut(const CutTask& task) noexcept;
void weigh_rows(const RowsTask& task) noexcept;

} // namespace isolux
