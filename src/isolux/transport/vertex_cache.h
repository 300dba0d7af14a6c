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
    /// A of METHODS eq. (144), m2: of all surfaces. 0: vertices count as if gather rays drew
    /// them evenly
    double area = 0.0;
    /// r of METHODS eq. (145), m: light that mirrors throw on a surface so near is left to
    /// walks of the point's own. 0: nothing
    double caustic = 0.0;
    const MirrorImages* images = nullptr; ///< what those walks look into
};

/// Vertices that points nearer than `radius` may leave to their own rays, block by block.
struct LeftVertices {
    struct Vertex {
        Point3 position;
        std::uint32_t place = 0; ///< in the blocks, counted [block][row][column]
    };

    double radius = 0.0; ///< m
    std::vector<Vertex> all;
    std::vector<std::uint32_t> first; ///< of each block in `all`; at the end how many there are

    /// @pre  called in the order of the blocks
    void add(const Point3& position, std::size_t place);
};

/// Vertices that a gather ray looks at before it takes one, side by side: neighbours in path
/// order, which are anywhere in the room. Relative to the centre of the cache. Places that are
/// not filled have no strength.
struct alignas(64) VertexHand {
    static constexpr std::size_t size = 16;
    using Values = std::array<float, size>;

    Values x{}, y{}, z{};    ///< m
    Values nx{}, ny{}, nz{}; ///< normal of the lit side
    Values strength{};       ///< alpha rho / pi, the Y-sum, times VertexCache::share_of, lm/sr
    Values continuation{};
    std::array<std::uint32_t, size> vertex{}; ///< number in VertexCache::vertices
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
    std::vector<VertexHand> hands; ///< of all vertices, or of the picks
    /// Where importance drew more vertices than there is flux: some of them in proportion to
    /// what they carry, for who wants some at random. Empty: any will do.
    std::vector<std::uint32_t> picks;
    double carried = 0.0;    ///< by all vertices, lm
    bool has_hidden = false; ///< PathVertex::is_hidden of any
    LeftVertices close;      ///< their chains came straight from nearby, METHODS eq. (122)
    LeftVertices mirrored;   ///< lit by mirrors, METHODS eq. (145)
    VertexTree tree;         ///< empty where all vertices are to be weighed
    FluxTally flux;

    [[nodiscard]] std::size_t size() const noexcept { return vertices.size(); }

    [[nodiscard]] bool empty() const noexcept { return vertices.empty(); }

    /// As new, but for its memory.
    void clear() noexcept;

    /// How many there are for who wants one at random.
    [[nodiscard]] std::size_t offered() const noexcept {
        return picks.empty() ? vertices.size() : picks.size();
    }

    /// One of those offered, k < offered()
    [[nodiscard]] std::size_t offer(std::size_t k) const noexcept {
        return picks.empty() ? k : picks[k];
    }

    /// 1/(paths x probability that one drawn evenly from those offered is this vertex)
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
