#include "isolux/transport/light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t bins = 12;

/// A unit vector at `angle` from `a` in the plane of a and b.
UnitVector3 turned_towards(const Vector3& a, const Vector3& b, double angle) noexcept {
    const Vector3 across = b - dot(a, b) * a;
    if (!(length_squared(across) > 1e-24))
        return UnitVector3(a);
    return UnitVector3(std::cos(angle) * a + std::sin(angle) * Vector3(UnitVector3(across)));
}

/// The narrowest cone we know of around two cones.
void unite_axes(LightBounds& a, const LightBounds& b) noexcept {
    const LightBounds& wide = a.spread >= b.spread ? a : b;
    const LightBounds& thin = a.spread >= b.spread ? b : a;
    const double between = std::acos(std::clamp(dot(wide.axis, thin.axis), -1.0, 1.0));
    if (between + thin.spread <= wide.spread) {
        const UnitVector3 axis = wide.axis;
        a.spread = wide.spread;
        a.axis = axis;
        return;
    }
    const double spread = 0.5 * (between + wide.spread + thin.spread);
    const UnitVector3 axis =
        turned_towards(wide.axis, thin.axis, std::max(0.0, spread - wide.spread));
    // Turning rounds; a little more width covers it.
    a.spread = std::min(pi, spread + 1e-9);
    a.axis = axis;
    // Opposite axes have no plane in common to turn in: then nothing is excluded.
    if (between > pi - 1e-6)
        a.spread = pi;
}

LightBounds unite(LightBounds a, const LightBounds& b) noexcept {
    if (a.count == 0.0)
        return b;
    a.lower = {std::min(a.lower.x, b.lower.x),
               std::min(a.lower.y, b.lower.y),
               std::min(a.lower.z, b.lower.z)};
    a.upper = {std::max(a.upper.x, b.upper.x),
               std::max(a.upper.y, b.upper.y),
               std::max(a.upper.z, b.upper.z)};
    unite_axes(a, b);
    a.reach = std::max(a.reach, b.reach);
    a.count += b.count;
    a.flux += b.flux;
    a.facets = std::max(a.facets, b.facets);
    for (std::size_t i = 0; i < LightBounds::bands; ++i)
        a.largest[i] = std::max(a.largest[i], b.largest[i]);
    return a;
}

/// Solid angle over which the members may shine, with a cosine at the rim (METHODS, "Many
/// luminaires").
double cone_measure(double spread, double reach) noexcept {
    const double w = std::min(spread + reach, pi);
    const double s = std::sin(spread);
    const double c = std::cos(spread);
    return 2.0 * pi * (1.0 - c)
           + 0.5 * pi * (2.0 * w * s - std::cos(spread - 2.0 * w) - 2.0 * spread * s + c);
}

/// Flux times squared size times cone: what it costs to look into a node. (The surface of the
/// box would make lines of luminaires in a plane look small, however long they are.)
double measure(const LightBounds& b) noexcept {
    return b.flux * (length_squared(b.upper - b.lower) + 1e-12)
           * cone_measure(b.spread, b.reach);
}

double along(const Vector3& v, std::size_t axis) noexcept {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

double middle(const LightBounds& b, std::size_t axis) noexcept {
    return 0.5 * along((b.lower - Point3{}) + (b.upper - Point3{}), axis);
}

} // namespace

LightTree::LightTree(const Scene& scene) {
    leaf_of_.assign(scene.luminaires.size(), no_node);
    leaves_.reserve(scene.luminaires.size());
    std::vector<TypeLight> types;
    for (const LuminaireType& type : scene.luminaire_types)
        types.push_back(describe_type(type));
    std::vector<std::uint32_t>& members = luminaires_;
    for (std::size_t l = 0; l < scene.luminaires.size(); ++l) {
        const Luminaire& luminaire = scene.luminaires[l];
        leaves_.push_back(bound_luminaire(luminaire, types[luminaire.placement.type.index()]));
        if (leaves_.back().flux > 0.0)
            members.push_back(static_cast<std::uint32_t>(l));
    }
    if (members.empty())
        return;
    nodes_.reserve(2 * members.size());
    nodes_.emplace_back();
    build(0, members, 0);
    leaves_ = {};
    glows_.reserve(nodes_.size());
    for (const Node& node : nodes_)
        glows_.push_back(glow_of(node.bounds));
}

std::size_t LightTree::split(std::span<std::uint32_t> members) const {
    double best = std::numeric_limits<double>::infinity();
    std::size_t best_axis = 0;
    double best_at = 0.0;
    LightBounds all;
    std::array<double, 3> lower;
    std::array<double, 3> upper;
    lower.fill(std::numeric_limits<double>::infinity());
    upper.fill(-std::numeric_limits<double>::infinity());
    for (const std::uint32_t m : members) {
        all = unite(all, leaves_[m]);
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] = std::min(lower[a], middle(leaves_[m], a));
            upper[a] = std::max(upper[a], middle(leaves_[m], a));
        }
    }
    const Vector3 sides = all.upper - all.lower;
    const double longest = std::max({sides.x, sides.y, sides.z});
    for (std::size_t a = 0; a < 3; ++a) {
        const double width = upper[a] - lower[a];
        if (!(width > 1e-9))
            continue;
        std::array<LightBounds, bins> bin;
        for (const std::uint32_t m : members) {
            const double t = (middle(leaves_[m], a) - lower[a]) / width;
            auto& b = bin[std::min(bins - 1, static_cast<std::size_t>(t * bins))];
            b = unite(b, leaves_[m]);
        }
        const double stretch = longest / std::max(1e-9, along(sides, a));
        for (std::size_t k = 1; k < bins; ++k) {
            LightBounds left;
            LightBounds right;
            for (std::size_t i = 0; i < bins; ++i)
                if (bin[i].count > 0.0)
                    (i < k ? left : right) = unite(i < k ? left : right, bin[i]);
            if (left.count == 0.0 || right.count == 0.0)
                continue;
            const double cost = stretch * (measure(left) + measure(right));
            if (cost < best) {
                best = cost;
                best_axis = a;
                best_at = lower[a] + width * static_cast<double>(k) / bins;
            }
        }
    }
    if (best == std::numeric_limits<double>::infinity())
        return members.size() / 2; // all in one place
    const auto first_right =
        std::stable_partition(members.begin(), members.end(), [&](std::uint32_t m) {
            return middle(leaves_[m], best_axis) < best_at;
        });
    const auto left = static_cast<std::size_t>(first_right - members.begin());
    return left == 0 || left == members.size() ? members.size() / 2 : left;
}

void LightTree::build(std::uint32_t node,
                      std::span<std::uint32_t> members,
                      std::uint32_t first_leaf) {
    nodes_[node].first_leaf = first_leaf;
    if (members.size() == 1) {
        nodes_[node].bounds = leaves_[members[0]];
        nodes_[node].luminaire = members[0];
        leaf_of_[members[0]] = node;
        return;
    }
    const std::size_t left = split(members);
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].left = children;
    nodes_[children].parent = node;
    nodes_[children + 1].parent = node;
    build(children, members.first(left), first_leaf);
    build(children + 1, members.subspan(left), first_leaf + static_cast<std::uint32_t>(left));
    nodes_[node].bounds = unite(nodes_[children].bounds, nodes_[children + 1].bounds);
}

namespace {

/// Goes down from a node, at every fork in proportion to `weigh`.
template <class Weigh>
LightTree::Pick
descend(std::span<const LightTree::Node> nodes, std::uint32_t node, double u, Weigh&& weigh) {
    double probability = 1.0;
    while (!nodes[node].is_leaf()) {
        const std::uint32_t left = nodes[node].left;
        const double a = weigh(left);
        const double b = weigh(left + 1);
        const double sum = a + b;
        if (!(sum > 0.0))
            return {};
        const double share = a / sum;
        if (u < share) {
            node = left;
            probability *= share;
            u = std::min(u / share, 1.0 - 1e-16);
        } else {
            node = left + 1;
            probability *= b / sum;
            u = std::min((u - share) / (b / sum), 1.0 - 1e-16);
        }
    }
    return {nodes[node].luminaire, probability};
}

} // namespace

LightTree::Pick
LightTree::pick(std::uint32_t node, const Receiver& receiver, double u) const noexcept {
    return descend(nodes_, node, u, [&](std::uint32_t n) {
        return upper_bound(nodes_[n].bounds, receiver);
    });
}

LightTree::Pick
LightTree::pick(std::uint32_t node, const Point3& place, double u) const noexcept {
    return descend(nodes_, node, u, [&](std::uint32_t n) {
        return static_cast<double>(importance(glows_[n], place));
    });
}

double LightTree::probability(std::uint32_t node,
                              const Point3& place,
                              std::size_t luminaire) const noexcept {
    double probability = 1.0;
    for (std::uint32_t n = leaf_of_[luminaire]; n != node; n = nodes_[n].parent) {
        const std::uint32_t left = nodes_[nodes_[n].parent].left;
        const auto a = static_cast<double>(importance(glows_[left], place));
        const auto b = static_cast<double>(importance(glows_[left + 1], place));
        const double own = n == left ? a : b;
        if (!(own > 0.0))
            return 0.0;
        probability *= own / (a + b);
    }
    return probability;
}

} // namespace isolux
