#include <algorithm>
#include <cmath>
#include <limits>

#include "isolux/base/grow.h"
#include "isolux/transport/tree_draws.h"

/// Where the tree of vertices is cut for a tile: METHODS "Vertex tree".
namespace isolux {

namespace {

constexpr std::size_t lanes = ClusterRow::size;

/// A cluster is small from a point where the standard deviation of its vertices' places is
/// below this share of the distance, its box reaches no farther than half of it, and its
/// normals differ little: sqrt(1 - |mean|^2).
constexpr float widest_spread = 0.2F;
constexpr float widest_reach = 0.5F;
constexpr float widest_wobble = 0.5F;

/// The points of a tile together.
struct Group {
    std::array<float, 3> lower{};
    std::array<float, 3> upper{};
    std::array<float, 3> axis{}; ///< 0 where there is none in common or all sides count
    std::array<float, 3> size_of_axis{};
    float highest = 0.0F; ///< no light comes from below this along the axis
};

Group gather_group(std::span<const TreePoint> points, bool is_planar) noexcept {
    Group g;
    g.lower = g.upper = points.front().receiver.at;
    g.axis = is_planar ? points.front().receiver.axis : std::array<float, 3>{};
    g.highest = std::numeric_limits<float>::infinity();
    for (const TreePoint& p : points) {
        float height = 0.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            g.lower[k] = std::min(g.lower[k], p.receiver.at[k]);
            g.upper[k] = std::max(g.upper[k], p.receiver.at[k]);
            height += p.receiver.axis[k] * p.receiver.at[k];
        }
        g.highest = std::min(g.highest, height);
        if (p.receiver.axis != g.axis)
            g.axis = {};
    }
    if (g.axis == std::array<float, 3>{})
        g.highest = -std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k)
        g.size_of_axis[k] = std::abs(g.axis[k]);
    return g;
}

/// What becomes of four siblings for all points of the group; bits. Those of neither kind can
/// give none of them light.
struct Fates {
    std::uint32_t small = 0;
    std::uint32_t open = 0;
};

/// @param first  of the siblings in their row
Fates judge(const ClusterRow& r, std::size_t first, const Group& g) noexcept {
    constexpr std::size_t n = VertexTree::forks;
    std::array<float, n> ahead{};  // farthest place along the points' axis
    std::array<float, n> above{};  // highest place of a point over the mean, along the normal
    std::array<float, n> square{}; // of the distance
    std::array<float, n> spread{};
    std::array<float, n> reach{};
    const auto add = [&](std::size_t k,
                         const ClusterRow::Values& mean,
                         const ClusterRow::Values& normal,
                         const ClusterRow::Values& deviation,
                         const ClusterRow::Values& half) {
        for (std::size_t j = 0; j < n; ++j) {
            const float m = mean[first + j];
            const float h = half[first + j];
            const float s = deviation[first + j];
            const float up = normal[first + j] * (g.upper[k] - m);
            const float down = normal[first + j] * (g.lower[k] - m);
            const float left = std::max(0.0F, g.lower[k] - m);
            const float away = std::max(left, m - g.upper[k]);
            ahead[j] += g.axis[k] * m + g.size_of_axis[k] * h;
            above[j] += std::max(up, down);
            square[j] += away * away;
            spread[j] += s * s;
            reach[j] += h * h;
        }
    };
    add(0, r.x, r.nx, r.sx, r.hx);
    add(1, r.y, r.ny, r.sy, r.hy);
    add(2, r.z, r.nz, r.sz, r.hz);
    Fates fates;
    for (std::size_t j = 0; j < n; ++j) {
        const bool is_dark = !(r.strength[first + j] > 0.0F) || ahead[j] <= g.highest
                             || above[j] <= r.lowest[first + j];
        const bool is_small = spread[j] <= widest_spread * widest_spread * square[j]
                              && reach[j] <= widest_reach * widest_reach * square[j]
                              && r.wobble[first + j] <= widest_wobble;
        fates.small |= (!is_dark && is_small ? 1U : 0U) << j;
        fates.open |= (!is_dark && !is_small ? 1U : 0U) << j;
    }
    return fates;
}

/// All that the kernel reads (not `lowest`: the cut itself has asked for it).
void put(ClusterRow& to, std::size_t i, const ClusterRow& from, std::size_t k) noexcept {
    to.x[i] = from.x[k], to.y[i] = from.y[k], to.z[i] = from.z[k];
    to.nx[i] = from.nx[k], to.ny[i] = from.ny[k], to.nz[i] = from.nz[k];
    to.strength[i] = from.strength[k], to.rival[i] = from.rival[k];
    to.sx[i] = from.sx[k], to.sy[i] = from.sy[k], to.sz[i] = from.sz[k];
    to.lean[i] = from.lean[k], to.depth[i] = from.depth[k];
    to.wobble[i] = from.wobble[k];
    to.hx[i] = from.hx[k], to.hy[i] = from.hy[k], to.hz[i] = from.hz[k];
}

} // namespace

void cut_tree(const VertexCache& cache,
              std::span<const TreePoint> points,
              IlluminanceKind kind,
              TreeScratch& s) {
    const auto& levels = cache.tree.levels;
    const Group group = gather_group(points, kind == IlluminanceKind::planar);
    TreeCut& cut = s.cut;
    cut.places.clear();
    cut.leaves.clear();
    s.waiting.clear();
    // siblings wait together, the first ones on top
    const auto top = static_cast<std::uint8_t>(levels.size() - 1);
    for (std::size_t i = levels.back().size() * lanes; i > 0; i -= VertexTree::forks)
        s.waiting.push_back({static_cast<std::uint32_t>(i - VertexTree::forks), top});
    while (!s.waiting.empty()) {
        const TreeCut::Place siblings = s.waiting.back();
        s.waiting.pop_back();
        const ClusterRow& row = levels[siblings.level][siblings.index / lanes];
        const Fates fates = judge(row, siblings.index % lanes, group);
        for (std::uint32_t j = 0; j < VertexTree::forks; ++j) {
            const std::size_t place = cut.places.size();
            if ((fates.small >> j & 1U) == 0)
                continue;
            grow(cut.clusters, place / lanes + 1);
            put(cut.clusters[place / lanes], place % lanes, row, siblings.index % lanes + j);
            cut.places.push_back({siblings.index + j, siblings.level});
        }
        for (std::uint32_t j = VertexTree::forks; siblings.level > 0 && j-- > 0;)
            if ((fates.open >> j & 1U) != 0)
                s.waiting.push_back(
                    {static_cast<std::uint32_t>(VertexTree::forks * (siblings.index + j)),
                     static_cast<std::uint8_t>(siblings.level - 1)});
        for (std::uint32_t j = 0; siblings.level == 0 && j < VertexTree::forks; ++j)
            if ((fates.open >> j & 1U) != 0)
                cut.leaves.push_back(siblings.index + j);
    }
    // the places that are left in the last row shine not
    for (std::size_t place = cut.places.size(); place % lanes != 0; ++place)
        cut.clusters[place / lanes].strength[place % lanes] = 0.0F;
}

} // namespace isolux
