#include "isolux/transport/tree_draws.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/check.h"
#include "isolux/base/grow.h"

namespace isolux {

namespace {

constexpr std::size_t lanes = ClusterRow::size;

/// Which of 16 numbers a running sum passes at `target`, which is then what is left of it, as a
/// share of the number found. Zeros are never found.
/// @param first, last  of the 16  @pre one of them is positive
std::size_t find(const float* u, std::size_t first, std::size_t last, double& target) noexcept {
    std::size_t found = first;
    double before = 0.0;
    double running = 0.0;
    for (std::size_t i = first; i < last; ++i) {
        if (u[i] <= 0.0F)
            continue;
        found = i;
        before = running;
        running += static_cast<double>(u[i]);
        if (running > target)
            break;
    }
    constexpr double below_one = 1.0 - 1e-15;
    target = std::clamp((target - before) / static_cast<double>(u[found]), 0.0, below_one);
    return found;
}

double sum_of(const float* u, std::size_t first, std::size_t last) noexcept {
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i)
        sum += static_cast<double>(u[i]);
    return sum;
}

/// METHODS eq. (122), (145): whether a point takes nothing from the vertex at a place.
bool is_left(const VertexCache& cache, const TreePoint& p, std::size_t place) noexcept {
    const std::uint8_t left = cache.tree.left[place];
    if (left == 0)
        return false;
    const double d2 = length_squared(cache.vertices[cache.vertex_at[place]].position - p.at);
    const auto is_within = [d2](const LeftVertices& v) { return d2 < v.radius * v.radius; };
    return (p.leaves_corners && (left & VertexTree::close) != 0 && is_within(cache.close))
           || (p.leaves_mirrored && (left & VertexTree::mirrored) != 0
               && is_within(cache.mirrored));
}

void leave_to_rays(const VertexCache& cache,
                   const TreePoint& p,
                   const TreeCut& cut,
                   float* u,
                   float* sums) noexcept {
    const std::size_t first = cut.cluster_rows();
    for (std::size_t k = 0; p.leaves_any() && k < cut.leaves.size(); ++k)
        for (std::size_t i = 0; i < lanes; ++i)
            if (is_left(cache, p, cut.leaves[k] * lanes + i)) {
                float* row = u + (first + k) * lanes;
                row[i] = 0.0F;
                sums[first + k] = static_cast<float>(sum_of(row, 0, lanes));
            }
}

/// Systematic draws over the cut: draws of vertices are done, those of clusters go on.
void draw_from_cut(const VertexCache& cache,
                   std::span<const TreePoint> points,
                   TreeScratch& s,
                   std::span<TreeDraw> draws) {
    const std::size_t rows = s.cut.rows();
    const std::size_t exact = s.cut.cluster_rows();
    std::size_t first = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        float* u = s.u.data() + p * rows * lanes;
        float* sums = s.sums.data() + p * rows;
        leave_to_rays(cache, points[p], s.cut, u, sums);
        double total = 0.0;
        for (std::size_t r = 0; r < rows; ++r)
            total += static_cast<double>(sums[r]);
        const std::size_t count = points[p].draws;
        const double step = total / static_cast<double>(count);
        std::size_t row = 0;
        double before = 0.0;
        for (std::size_t k = 0; total > 0.0 && k < count; ++k) {
            const double target = (static_cast<double>(k) + points[p].offset) * step;
            while (row + 1 < rows && before + static_cast<double>(sums[row]) <= target)
                before += static_cast<double>(sums[row++]);
            std::size_t lit = row; // where rounding led past the last light
            while (sums[lit] <= 0.0F)
                lit = lit > 0 ? lit - 1 : rows - 1;
            double left = target - before;
            const std::size_t i = find(u + lit * lanes, 0, lanes, left);
            if (lit >= exact)
                draws[first + k] = {
                    static_cast<std::uint32_t>(s.cut.leaves[lit - exact] * lanes + i), step};
            else
                s.descents.push_back({static_cast<std::uint32_t>(p),
                                      static_cast<std::uint32_t>(first + k),
                                      s.cut.places[lit * lanes + i],
                                      left,
                                      step,
                                      u[lit * lanes + i]});
        }
        first += count;
    }
}

/// The row that holds what a cluster consists of, one or two levels below.
RowOfTree look_into(const VertexCache& cache, const TreeScratch::Descent& d) noexcept {
    const std::uint32_t i = d.cluster.index;
    switch (d.cluster.level) {
    case 0:
        return {nullptr,
                &cache.blocks[i / VertexBlock::most_rows],
                static_cast<std::uint32_t>(i % VertexBlock::most_rows),
                d.point};
    case 1:
        return {&cache.tree.levels[0][i / VertexTree::forks], nullptr, 0, d.point};
    default:
        return {&cache.tree.levels[d.cluster.level - 2U][i], nullptr, 0, d.point};
    }
}

/// METHODS eq. (138): on to one of the members. @return whether the draw has more to go
bool step_down(const VertexCache& cache,
               const TreePoint& point,
               float* u,
               TreeScratch::Descent& d,
               TreeDraw& draw) noexcept {
    const std::size_t level = d.cluster.level;
    std::size_t first = 0;
    std::size_t last = lanes;
    if (level == 1) { // a quarter of the row
        first = d.cluster.index % VertexTree::forks * VertexTree::forks;
        last = first + VertexTree::forks;
    }
    const std::size_t begin = lanes * d.cluster.index; // of vertices, or two levels below
    if (level == 0 && point.leaves_any())
        for (std::size_t i = 0; i < lanes; ++i)
            if (is_left(cache, point, begin + i))
                u[i] = 0.0F;
    const double sum = sum_of(u, first, last);
    if (!(sum > 0.0))
        return false;
    d.share *= sum / static_cast<double>(d.u);
    d.left *= sum;
    const std::size_t i = find(u, first, last, d.left);
    if (level == 0) {
        draw = {static_cast<std::uint32_t>(begin + i), d.share};
        return false;
    }
    d.u = u[i];
    d.cluster.index = static_cast<std::uint32_t>(
        level == 1 ? VertexTree::forks * d.cluster.index + i - first : begin + i);
    d.cluster.level = static_cast<std::uint8_t>(level == 1 ? 0 : level - 2);
    return true;
}

} // namespace

void draw_by_tree(const VertexCache& cache,
                  std::span<const TreePoint> points,
                  IlluminanceKind kind,
                  Weighting weighting,
                  TreeScratch& s,
                  std::span<TreeDraw> draws) {
    ISOLUX_EXPECT(!cache.tree.empty() && !points.empty());
    cut_tree(cache, points, kind, s);
    const std::size_t rows = s.cut.rows();
    std::fill(draws.begin(), draws.end(), TreeDraw{});
    s.receivers.clear();
    for (const TreePoint& p : points)
        s.receivers.push_back(p.receiver);
    grow(s.u, points.size() * rows * lanes);
    grow(s.sums, points.size() * rows);
    s.descents.clear();
    weigh_cut({std::span(s.cut.clusters).first(s.cut.cluster_rows()),
               cache.blocks,
               s.cut.leaves,
               kind,
               weighting,
               s.receivers,
               s.u,
               s.sums});
    draw_from_cut(cache, points, s, draws);
    while (!s.descents.empty()) {
        s.members.clear();
        for (const TreeScratch::Descent& d : s.descents)
            s.members.push_back(look_into(cache, d));
        grow(s.member_u, s.members.size() * lanes);
        weigh_rows({s.members, kind, weighting, s.receivers, s.member_u});
        std::size_t kept = 0;
        for (std::size_t k = 0; k < s.descents.size(); ++k) {
            TreeScratch::Descent d = s.descents[k];
            if (step_down(
                    cache, points[d.point], s.member_u.data() + k * lanes, d, draws[d.draw]))
                s.descents[kept++] = d;
        }
        s.descents.resize(kept);
    }
}

} // namespace isolux
