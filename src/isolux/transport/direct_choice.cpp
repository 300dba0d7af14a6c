#include <algorithm>
#include <array>
#include <queue>
#include <utility>
#include <vector>

#include "isolux/transport/direct_task.h"
#include "isolux/transport/light_tree.h"

namespace isolux {

namespace {

/// Luminaires whose bound is below this share of the sum of the others' are drawn, not looked
/// at one by one.
constexpr double negligible = 1e-4;

/// Parts of the light tree with no more luminaires than this, and no larger than this share of
/// the distance, are taken whole.
constexpr double most_alike = 16.0;
constexpr double alike_size = 0.5;

/// Thickness of openings in one plane, m.
constexpr double flat = 1e-9;

/// Draws from the tail, more where it may matter.
constexpr double draws_per_share = 256.0;
constexpr double most_draws = 16.0;

} // namespace

bool DirectLight::is_wholly_visible(std::size_t luminaire, const Point3& clear) const {
    const Opening& opening = emission_->luminaire(luminaire).opening;
    std::vector<Point3> polygon;
    for (const Facet& facet : opening.facets) {
        const bool is_front = dot(facet.normal, clear - facet.vertices.front()) > 0.0;
        if (!is_front && opening.form == OpeningForm::solid)
            continue;
        const Vector3 side = is_front ? Vector3(facet.normal) : -Vector3(facet.normal);
        polygon.clear();
        for (const Point3& p : facet.vertices)
            polygon.push_back(scene_->caster.offset_point(p, side));
        if (!view_.is_clear(clear, polygon))
            return false;
    }
    return true;
}

/// Whether nothing hides any luminaire of a part of the light tree: looked for where all of
/// their openings lie in one plane.
bool DirectLight::is_wholly_visible(const LightBounds& b, const Point3& clear) const {
    const Vector3 side = b.upper - b.lower;
    const double thin = std::min({side.x, side.y, side.z});
    if (!(thin < flat))
        return false;
    const Vector3 half = 0.5 * side;
    const Point3 middle = midpoint(b.lower, b.upper);
    const auto [along, across, normal] = [&]() -> std::array<Vector3, 3> {
        if (thin == side.z)
            return {Vector3{half.x, 0, 0}, Vector3{0, half.y, 0}, Vector3{0, 0, 1}};
        if (thin == side.y)
            return {Vector3{half.x, 0, 0}, Vector3{0, 0, half.z}, Vector3{0, 1, 0}};
        return {Vector3{0, half.y, 0}, Vector3{0, 0, half.z}, Vector3{1, 0, 0}};
    }();
    const Vector3 free_side = dot(normal, clear - middle) > 0.0 ? normal : -normal;
    std::array<Point3, 4> corners{middle - along - across,
                                  middle + along - across,
                                  middle + along + across,
                                  middle - along + across};
    for (Point3& p : corners)
        p = scene_->caster.offset_point(p, free_side);
    return view_.is_clear(clear, corners);
}

/// Luminaires that are looked at one by one; the others go to the plan's tail. The brightest
/// parts of the light tree are split until what is left is negligible, or so small and far that
/// its members are taken as alike.
std::vector<DirectLight::Chosen> DirectLight::choose(const Task& task, DirectPlan& plan) const {
    std::vector<Chosen> chosen;
    const LightTree* tree = emission_->tree();
    if (tree == nullptr) {
        for (std::uint32_t l = 0; l < emission_->luminaires(); ++l)
            if (in_lumen(emission_->luminaire(l).flux) > 0.0)
                chosen.push_back({l, false});
        return chosen;
    }
    const auto nodes = tree->nodes();
    std::priority_queue<std::pair<double, std::uint32_t>> waiting;
    const auto add = [&](std::uint32_t node) {
        const double bound = upper_bound(nodes[node].bounds, task.receiver);
        if (bound > 0.0)
            waiting.emplace(bound, node);
    };
    const auto is_small = [&](const LightBounds& b) {
        const double away = distance(task.clear, midpoint(b.lower, b.upper));
        return b.count <= most_alike && distance(b.lower, b.upper) <= alike_size * away;
    };
    if (!nodes.empty())
        add(0);
    double sum = 0.0;
    while (!waiting.empty() && waiting.top().first > negligible * sum) {
        const auto [bound, node] = waiting.top();
        waiting.pop();
        if (nodes[node].is_leaf() || is_small(nodes[node].bounds)) {
            const bool is_clear =
                !nodes[node].is_leaf() && is_wholly_visible(nodes[node].bounds, task.clear);
            for (const std::uint32_t l : tree->luminaires_below(node))
                chosen.push_back({l, is_clear});
            sum += bound;
        } else {
            add(nodes[node].left);
            add(nodes[node].left + 1);
        }
    }
    for (; !waiting.empty(); waiting.pop()) {
        plan.tail.push_back({waiting.top().second, waiting.top().first});
        plan.tail_bound += waiting.top().first;
    }
    if (!plan.tail.empty())
        plan.tail_draws = static_cast<std::uint32_t>(std::clamp(
            draws_per_share * plan.tail_bound / (plan.tail_bound + sum), 1.0, most_draws));
    return chosen;
}

} // namespace isolux
