#include "isolux/calc/find_importance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "isolux/base/parallel.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

/// Where the darkest point has more than this share of the points' and of all surfaces' mean,
/// paths need no guidance.
constexpr double dark = 0.1;

constexpr std::size_t vertices_of_a_cell = 2; ///< that are looked from
constexpr std::size_t most_points = 32;       ///< that are looked at
constexpr float most = 1000.0F;

constexpr int generations = 24; ///< of reflections that are followed

/// Part of the flux at one cell that reaches another next.
struct Passage {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double share = 0.0;
};

/// What the pilot's vertices say, by cell.
struct Cells {
    explicit Cells(const Bounds& bounds) : order(bounds) {}

    CellOrder order;
    std::vector<double> flux = std::vector<double>(CellOrder::keys, 0.0);
    std::vector<std::vector<const PathVertex*>> some{CellOrder::keys}; ///< of the vertices
    std::vector<Passage> passages;
};

/// What a vertex of unit radiant intensity does at a point beside its light. Nearer than
/// `least` it counts as there: gather rays do more.
double effect(const Scene& scene, const PathVertex& v, const ImportancePoint& p, double least) {
    const Vector3 d = p.at - v.position;
    const double d2 = length_squared(d);
    const double along = dot(v.normal, d);
    if (!(d2 > 0.0) || along <= 0.0)
        return 0.0;
    const double response = evaluate_response(*p.receiver, UnitVector3(-d));
    if (response <= 0.0)
        return 0.0;
    const double seen = scene.caster.transmittance(p.at, v.position);
    return seen * response * along / (std::sqrt(d2) * std::max(d2, least) * p.value);
}

std::size_t paths_of(std::span<const VertexCache> caches) noexcept {
    std::size_t paths = 0;
    for (const VertexCache& c : caches)
        paths += c.paths;
    return paths;
}

/// So many of them as are looked at, evenly spread.
std::vector<ImportancePoint> choose(std::span<const ImportancePoint> points) {
    const std::size_t n = std::min(points.size(), most_points);
    std::vector<ImportancePoint> chosen;
    for (std::size_t k = 0; k < n; ++k)
        chosen.push_back(points[k * points.size() / n]);
    return chosen;
}

/// Whether a point lies in the dark beside the others, or all of them beside the surfaces.
bool is_dark(const Scene& scene,
             std::span<const VertexCache> caches,
             std::span<const ImportancePoint> points) {
    double mean = 0.0;
    double least = points.front().value;
    for (const ImportancePoint& p : points) {
        mean += p.value / static_cast<double>(points.size());
        least = std::min(least, p.value);
    }
    double of_surfaces = 0.0;
    for (const VertexCache& c : caches)
        for (const PathVertex& v : c.vertices)
            of_surfaces += v.carried;
    of_surfaces /= static_cast<double>(paths_of(caches)) * scene.total_area;
    return least > 0.0 && least <= dark * std::max(mean, of_surfaces);
}

Cells sort_into_cells(const Scene& scene, std::span<const VertexCache> caches) {
    Cells cells(scene.bounds);
    std::vector<std::uint32_t> keys;
    for (const VertexCache& c : caches) {
        keys.clear();
        for (std::size_t i = 0; i < c.vertices.size(); ++i) {
            const PathVertex& v = c.vertices[i];
            const std::uint32_t key = cells.order.key(v.position, v.normal);
            keys.push_back(key);
            cells.flux[key] += v.carried;
            if (v.back > 0)
                cells.passages.push_back({keys[i - v.back], key, v.carried});
            if (cells.some[key].size() < vertices_of_a_cell)
                cells.some[key].push_back(&v);
        }
    }
    for (Passage& p : cells.passages)
        p.share /= cells.flux[p.from];
    return cells;
}

/// e of METHODS eq. (135), by cell.
std::vector<double> find_effects(const Scene& scene,
                                 const Cells& cells,
                                 std::span<const ImportancePoint> points,
                                 double near) {
    std::vector<double> own(CellOrder::keys, 0.0);
    for_each_index(CellOrder::keys, 16, [&](std::size_t k) {
        for (const PathVertex* v : cells.some[k])
            for (const ImportancePoint& p : points)
                own[k] += luminance_sum(v->radiant) / v->carried * effect(scene, *v, p, near)
                          / static_cast<double>(cells.some[k].size());
    });
    return own;
}

/// I = e + P I.
std::vector<double> follow_reflections(const Cells& cells, const std::vector<double>& own) {
    std::vector<double> importance = own;
    std::vector<double> next;
    for (int generation = 0; generation < generations; ++generation) {
        next = own;
        for (const Passage& p : cells.passages)
            next[p.from] += p.share * importance[p.to];
        importance.swap(next);
    }
    return importance;
}

} // namespace

PathImportance find_importance(const Scene& scene,
                               std::span<const VertexCache> caches,
                               std::span<const ImportancePoint> points) {
    const std::size_t paths = paths_of(caches);
    if (points.empty() || paths == 0 || !is_dark(scene, caches, points))
        return {};
    const double near = 0.25 * scene.total_area / static_cast<double>(paths);
    const Cells cells = sort_into_cells(scene, caches);
    const std::vector<double> importance =
        follow_reflections(cells, find_effects(scene, cells, choose(points), near));
    const double all_flux = std::accumulate(cells.flux.begin(), cells.flux.end(), 0.0);
    const double weighted =
        std::inner_product(cells.flux.begin(), cells.flux.end(), importance.begin(), 0.0);
    if (!(weighted > 0.0))
        return {};
    const double highest = *std::max_element(importance.begin(), importance.end());
    std::vector<float> factors(CellOrder::keys);
    for (std::size_t k = 0; k < CellOrder::keys; ++k) {
        const double i =
            cells.some[k].empty() ? highest : importance[k]; // nobody was there yet
        factors[k] = std::clamp(static_cast<float>(all_flux / weighted * i), 1.0F, most);
    }
    return {scene.bounds, std::move(factors)};
}

} // namespace isolux
