#include "isolux/transport/light_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

#include "isolux/base/parallel.h"

namespace isolux {

namespace {

/// Cells of a grid at most, and no more than there are luminaires.
constexpr std::size_t most_cells = 128;

double half_diagonal(const LightBounds& b) noexcept { return 0.5 * distance(b.lower, b.upper); }

/// What a node's members send in the bands of the angle to their own axes, together; a member
/// may look otherwise than the node does by the width of the cone of axes and about a band.
LightBounds together(const LightBounds& node,
                     const std::array<double, LightBounds::bands>& sum) {
    constexpr double width = std::numbers::pi / static_cast<double>(LightBounds::bands);
    const auto doubt = 1 + static_cast<std::size_t>(node.spread / width);
    LightBounds b = node;
    for (std::size_t i = 0; i < LightBounds::bands; ++i) {
        const std::size_t first = i - std::min(i, doubt);
        const std::size_t last = std::min(LightBounds::bands - 1, i + doubt);
        b.largest[i] = *std::max_element(sum.begin() + first, sum.begin() + last + 1);
    }
    return b;
}

/// Where luminaires are near: around all of them, by a quarter of the diagonal, as far as there
/// is anything to light.
Bounds around(const LightBounds& all, const Bounds& scene) {
    const double margin = 0.5 * half_diagonal(all);
    const auto lower = [margin](double own, double least) {
        return std::min(own, std::max(own - margin, least));
    };
    const auto upper = [margin](double own, double most) {
        return std::max(own, std::min(own + margin, most));
    };
    return {{lower(all.lower.x, scene.lower.x),
             lower(all.lower.y, scene.lower.y),
             lower(all.lower.z, scene.lower.z)},
            {upper(all.upper.x, scene.upper.x),
             upper(all.upper.y, scene.upper.y),
             upper(all.upper.z, scene.upper.z)}};
}

/// The longest sides of cells are halved until there are `most`.
std::array<std::size_t, 3> divide(const Bounds& bounds, std::size_t most) {
    std::array<std::size_t, 3> counts{1, 1, 1};
    std::array<double, 3> sides{bounds.upper.x - bounds.lower.x,
                                bounds.upper.y - bounds.lower.y,
                                bounds.upper.z - bounds.lower.z};
    for (std::size_t all = 2; all <= most; all *= 2) {
        const auto longest = static_cast<std::size_t>(
            std::max_element(sides.begin(), sides.end()) - sides.begin());
        sides[longest] *= 0.5;
        counts[longest] *= 2;
    }
    return counts;
}

double squared_distance(const Bounds& box, const Point3& p) noexcept {
    const auto beyond = [](double v, double lower, double upper) {
        return std::max({0.0, lower - v, v - upper});
    };
    const double x = beyond(p.x, box.lower.x, box.upper.x);
    const double y = beyond(p.y, box.lower.y, box.upper.y);
    const double z = beyond(p.z, box.lower.z, box.upper.z);
    return x * x + y * y + z * z;
}

} // namespace

LightGrid::LightGrid(const Scene& scene) : tree_(scene) {
    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return;
    bounds_ = around(nodes[0].bounds, scene.bounds);
    // Children come after their parents.
    std::vector<std::array<double, LightBounds::bands>> sums(nodes.size());
    for (std::size_t n = nodes.size(); n-- > 0;) {
        if (nodes[n].is_leaf()) {
            sums[n] = nodes[n].bounds.largest;
            continue;
        }
        for (std::size_t i = 0; i < LightBounds::bands; ++i)
            sums[n][i] = sums[nodes[n].left][i] + sums[nodes[n].left + 1][i];
    }
    const auto tables = std::make_shared<GlowTables>();
    for (std::size_t n = 0; n < nodes.size(); ++n)
        glow_.push_back(tables->add(nodes[n].is_leaf() ? nodes[n].bounds
                                                       : together(nodes[n].bounds, sums[n])));
    tables_ = tables;

    if (scene.luminaires.size() > LuminairePick::most)
        counts_ = divide(bounds_, std::min(most_cells, scene.luminaires.size()));
    const auto [nx, ny, nz] = counts_;
    const Vector3 side = bounds_.upper - bounds_.lower;
    const Vector3 step{side.x / static_cast<double>(nx),
                       side.y / static_cast<double>(ny),
                       side.z / static_cast<double>(nz)};
    cells_.assign(nx * ny * nz, Cell{LuminairePick(tables_)});
    for_each_index(cells_.size(), 16, [&](std::size_t c) {
        const Vector3 lower{step.x * static_cast<double>(c % nx),
                            step.y * static_cast<double>(c / nx % ny),
                            step.z * static_cast<double>(c / nx / ny)};
        cells_[c] = make_cell({bounds_.lower + lower, bounds_.lower + lower + step});
    });
}

/// The node whose members differ most, seen from the cell, is split again and again.
LightGrid::Cell LightGrid::make_cell(const Bounds& box) const {
    const auto nodes = tree_.nodes();
    std::priority_queue<std::pair<double, std::uint32_t>> waiting;
    const auto add = [&](std::uint32_t n) {
        const LightBounds& b = nodes[n].bounds;
        const double h = half_diagonal(b);
        const double d2 = squared_distance(box, midpoint(b.lower, b.upper)) + h * h + 1e-12;
        waiting.emplace(nodes[n].is_leaf() ? -1.0 : b.flux * h / (d2 * std::sqrt(d2)), n);
    };
    add(0);
    while (waiting.size() < LuminairePick::most && waiting.top().first >= 0.0) {
        const std::uint32_t left = nodes[waiting.top().second].left;
        waiting.pop();
        add(left);
        add(left + 1);
    }
    std::vector<std::uint32_t> cut;
    for (; !waiting.empty(); waiting.pop())
        cut.push_back(waiting.top().second);
    std::ranges::sort(cut, {}, [&](std::uint32_t n) { return nodes[n].first_leaf; });
    Cell cell{LuminairePick(tables_)};
    for (std::size_t i = 0; i < cut.size(); ++i) {
        const LightBounds& b = nodes[cut[i]].bounds;
        cell.nodes[i] = cut[i];
        cell.first_leaf[i] = nodes[cut[i]].first_leaf;
        cell.cut.add(glow_[cut[i]], b.axis, midpoint(b.lower, b.upper), 2.0 * half_diagonal(b));
    }
    return cell;
}

const LightGrid::Cell& LightGrid::cell_of(const Point3& place) const noexcept {
    const auto along = [](double v, double lower, double upper, std::size_t count) {
        const double at =
            (v - lower) / std::max(upper - lower, 1e-9) * static_cast<double>(count);
        return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count) - 0.5));
    };
    const std::size_t x = along(place.x, bounds_.lower.x, bounds_.upper.x, counts_[0]);
    const std::size_t y = along(place.y, bounds_.lower.y, bounds_.upper.y, counts_[1]);
    const std::size_t z = along(place.z, bounds_.lower.z, bounds_.upper.z, counts_[2]);
    return cells_[(z * counts_[1] + y) * counts_[0] + x];
}

LightTree::Pick LightGrid::pick(const Point3& place, double u) const noexcept {
    if (cells_.empty())
        return {};
    const Cell& cell = cell_of(place);
    const LuminairePick::Pick entry = cell.cut.pick(place, u);
    LightTree::Pick pick = tree_.pick(cell.nodes[entry.entry], place, entry.rest);
    pick.probability *= entry.probability;
    return pick;
}

double LightGrid::probability(const Point3& place, std::size_t luminaire) const noexcept {
    const std::uint32_t leaf = tree_.leaf_of(luminaire);
    if (leaf == LightTree::no_node)
        return 0.0;
    const Cell& cell = cell_of(place);
    const auto begin = cell.first_leaf.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(cell.cut.size());
    const auto entry = static_cast<std::size_t>(
        std::upper_bound(begin, end, tree_.nodes()[leaf].first_leaf) - begin - 1);
    return cell.cut.probability(place, entry)
           * tree_.probability(cell.nodes[entry], place, luminaire);
}

} // namespace isolux
