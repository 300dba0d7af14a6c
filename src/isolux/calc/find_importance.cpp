#include "isolux/calc/find_importance.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/parallel.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

/// Where the darkest point has this share of the points' or of all surfaces' mean, paths need
/// no guidance.
constexpr double dark = 0.2;

constexpr std::size_t vertices_of_a_cell = 2; ///< that are looked from
constexpr std::size_t most_points = 32;       ///< that are looked at
constexpr float most = 1000.0F;

/// Part of the flux at one cell that reaches another next.
struct Passage {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double share = 0.0;
};

constexpr int generations = 24; ///< of reflections that are followed

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

/// So many of them as are looked at, evenly spread.
std::vector<ImportancePoint> choose(std::span<const ImportancePoint> points) {
    const std::size_t n = std::min(points.size(), most_points);
    std::vector<ImportancePoint> chosen;
    for (std::size_t k = 0; k < n; ++k)
        chosen.push_back(points[k * points.size() / n]);
    return chosen;
}

} // namespace

PathImportance find_importance(const Scene& scene,
                               std::span<const VertexCache> caches,
                               std::span<const ImportancePoint> points) {
    double mean = 0.0;
    double least = 1e300;
    for (const ImportancePoint& p : points) {
        mean += p.value / static_cast<double>(points.size());
        least = std::min(least, p.value);
    }
    std::size_t paths = 0;
    double carried = 0.0;
    for (const VertexCache& c : caches) {
        paths += c.paths;
        for (const PathVertex& v : c.vertices)
            carried += v.carried;
    }
    if (paths > 0) // or all points lie in the dark
        mean = std::max(mean, carried / (static_cast<double>(paths) * scene.total_area));
    if (points.empty() || paths == 0 || !(least > 0.0) || least > dark * mean)
        return {};
    const double near = 0.25 * scene.total_area / static_cast<double>(paths);
    const std::vector<ImportancePoint> seen_from = choose(points);

    // By cell: its flux, what its vertices do, and where light goes from there.
    const CellOrder order(scene.bounds);
    std::vector<double> flux(CellOrder::keys, 0.0);
    std::vector<double> own(CellOrder::keys, 0.0);
    std::vector<std::size_t> looks(CellOrder::keys, 0);

    struct Look {
        std::uint32_t key = 0;
        const PathVertex* vertex = nullptr;
    };

    std::vector<Look> looked_from;
    std::vector<Passage> passages;
    std::vector<std::uint32_t> keys;
    for (const VertexCache& c : caches) {
        keys.clear();
        for (std::size_t i = 0; i < c.vertices.size(); ++i) {
            const PathVertex& v = c.vertices[i];
            const std::uint32_t key = order.key(v.position, v.normal);
            keys.push_back(key);
            flux[key] += v.carried;
            if (v.back > 0)
                passages.push_back({keys[i - v.back], key, v.carried});
            if (looks[key]++ < vertices_of_a_cell)
                looked_from.push_back({key, &v});
        }
    }
    std::vector<double> effects(looked_from.size(), 0.0);
    for_each_index(looked_from.size(), 8, [&](std::size_t i) {
        const PathVertex& v = *looked_from[i].vertex;
        for (const ImportancePoint& p : seen_from)
            effects[i] += luminance_sum(v.radiant) / v.carried * effect(scene, v, p, near);
    });
    for (std::size_t i = 0; i < effects.size(); ++i)
        own[looked_from[i].key] += effects[i];
    for (std::size_t k = 0; k < CellOrder::keys; ++k)
        if (looks[k] > 0)
            own[k] /= static_cast<double>(std::min(looks[k], vertices_of_a_cell));
    for (Passage& p : passages)
        p.share /= flux[p.from];
    std::vector<double> importance = own;
    std::vector<double> next;
    for (int generation = 0; generation < generations; ++generation) {
        next = own;
        for (const Passage& p : passages)
            next[p.from] += p.share * importance[p.to];
        importance.swap(next);
    }
    double all_flux = 0.0;
    double weighted = 0.0;
    double highest = 0.0;
    for (std::size_t k = 0; k < CellOrder::keys; ++k) {
        all_flux += flux[k];
        weighted += flux[k] * importance[k];
        highest = std::max(highest, importance[k]);
    }
    if (!(weighted > 0.0))
        return {};
    const double scale = all_flux / weighted;
    std::vector<float> factors(CellOrder::keys);
    for (std::size_t k = 0; k < CellOrder::keys; ++k) {
        const double i = looks[k] == 0 ? highest : importance[k]; // nobody was there yet
        factors[k] = std::clamp(static_cast<float>(scale * i), 1.0F, most);
    }
    return {scene.bounds, std::move(factors)};
}

} // namespace isolux
