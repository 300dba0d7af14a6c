#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "isolux/transport/light_path.h"
#include "isolux/transport/vertex_kernel.h"
#include "isolux/transport/vertex_tree.h"

namespace isolux {

/// Effective counts of METHODS eq. (11), the same constants in both weights.
struct EffectiveCounts {
    double paths = 1.0; ///< n1 for paths with one reflection (k = 2)
    double vertices =
        1.0; ///< n1 for longer paths (k >= 3): M times the pilot's mean chain length
    double gather_first = 1.0; ///< n2 for k = 2, of one of a point's gather rays
    double gather_later = 1.0; ///< n2 for k >= 3, the same
    /// r of METHODS eq. (122), m: what a point next to an edge leaves to walks of its own. 0:
    /// nothing
    double corner = 0.0;
};

/// A vertex whose chain came straight from less than EffectiveCounts::corner away.
struct CloseVertex {
    Point3 position;
    std::uint32_t place = 0; ///< in the blocks, counted [block][row][column]
};

/// A vertex as who wants some at random looks at it, relative to the centre of the cache.
struct alignas(32) VertexRecord {
    float x = 0.0F, y = 0.0F, z = 0.0F;    ///< m
    float nx = 0.0F, ny = 0.0F, nz = 0.0F; ///< normal of the lit side
    float strength = 0.0F; ///< alpha rho / pi, the Y-sum, times VertexCache::share_of, lm/sr
    float continuation = 0.0F;
};

/// The vertices of `paths` consecutive light paths of one replicate: in path order and double
/// precision for connections, and packed as floats for the vectorised kernel, there sorted by
/// where they lie and face, so that neighbours in the running sum are neighbours in the room.
/// Holds about 200 bytes a vertex (METHODS "Memory").
struct VertexCache {
    std::size_t paths = 0;
    std::vector<PathVertex> vertices;
    Point3 centre;
    std::vector<VertexBlock> blocks;
    /// Which vertex stands at a place of the blocks, counted [block][row][column].
    std::vector<std::uint32_t> vertex_at;
    std::vector<VertexRecord> records; ///< in path order
    /// Where importance drew more vertices than there is flux: some of them in proportion to
    /// what they carry, for who wants some at random. Empty: any will do.
    std::vector<std::uint32_t> picks;
    double carried = 0.0; ///< by all vertices, lm
    double corner = 0.0;  ///< of the counts
    std::vector<CloseVertex> close;
    VertexTree tree; ///< empty where all vertices are to be weighed
    FluxTally flux;

    [[nodiscard]] std::size_t size() const noexcept { return vertices.size(); }

    [[nodiscard]] bool empty() const noexcept { return vertices.empty(); }

    /// As new, but for its memory.
    void clear() noexcept;

    /// One at random, in proportion to what they carry. @param u  in [0, 1)  @pre !empty()
    [[nodiscard]] std::size_t draw(double u) const noexcept {
        const std::size_t n = picks.empty() ? vertices.size() : picks.size();
        const auto k = std::min(n - 1, static_cast<std::size_t>(u * static_cast<double>(n)));
        return picks.empty() ? k : picks[k];
    }

    /// 1/(paths x probability that draw() gives a vertex)
    [[nodiscard]] double share_of(std::size_t vertex) const noexcept {
        const double all = picks.empty() ? static_cast<double>(vertices.size())
                                         : carried / vertices[vertex].carried;
        return all / static_cast<double>(paths);
    }
};

/// Calls `f(material)` for all diffuse reflections of a light path up to and including a
/// vertex, the last one first.
template <class F> void visit_chain(const VertexCache& cache, std::size_t vertex, F&& f) {
    for (;;) {
        const PathVertex& v = cache.vertices[vertex];
        f(v.material);
        if (v.back == 0)
            return;
        vertex -= v.back;
    }
}

/// How the vertices of a cache are weighed for a point: METHODS "Shared cache", "Vertex tree".
enum class Weighing : std::uint8_t {
    all,  ///< every one of them
    tree, ///< clusters of them, and single ones nearby: for caches of very many
};

/// Walks paths [first, first + count) in parallel, each into its own slot.
/// @param used  whose memory is taken over; the system hands out fresh memory slowly
[[nodiscard]] VertexCache build_vertex_cache(const Scene& scene,
                                             const Emission& emission,
                                             const PathRandomness& random,
                                             std::uint64_t first,
                                             std::size_t count,
                                             const EffectiveCounts& counts,
                                             const PathImportance& importance = {},
                                             const Roulette& roulette = {},
                                             Weighing weighing = Weighing::all,
                                             VertexCache used = {});

} // namespace isolux
