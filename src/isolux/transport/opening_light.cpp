#include "isolux/transport/opening_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "isolux/base/polygon.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Nearer than this to the plane of an opening, or to a point source, m, a receiver takes the
/// place where its rays start.
constexpr double least_clearance = 1e-3;

/// Two rules in a row that agree to this share are believed.
constexpr double agreement = 2e-5;

constexpr std::array<std::size_t, 9> orders{1, 2, 3, 4, 6, 9, 12, 18, 27};

/// The second rule's points stand no farther apart than this, rad, as seen from the receiver:
/// about the step of a table, so that no beam hides between them.
constexpr double widest_step = 0.1;

/// Number in `orders` of the second rule along a side that the receiver sees this long, rad;
/// the number of orders where none is fine enough.
std::size_t second_rule(double extent) noexcept {
    std::size_t second = extent <= widest_step ? 1 : 2;
    while (second < orders.size() && widest_step * static_cast<double>(orders[second]) < extent)
        ++second;
    return second;
}

struct Rule {
    std::array<double, orders.back()> node{}; ///< in (0, 1)
    std::array<double, orders.back()> weight{};
};

/// Gauss-Legendre rule of `n` points on (0, 1): Newton's method on the Legendre polynomial.
Rule make_rule(std::size_t n) {
    Rule rule;
    const auto count = static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
        double x = std::cos(pi * (static_cast<double>(i) + 0.75) / (count + 0.5));
        double slope = 1.0;
        for (int turn = 0; turn < 30; ++turn) {
            double p0 = 1.0;
            double p1 = x;
            for (std::size_t k = 2; k <= n; ++k) {
                const auto degree = static_cast<double>(k);
                const double p2 =
                    ((2.0 * degree - 1.0) * x * p1 - (degree - 1.0) * p0) / degree;
                p0 = p1;
                p1 = p2;
            }
            slope = count * (x * p1 - p0) / (x * x - 1.0);
            x -= p1 / slope;
        }
        rule.node[i] = 0.5 * (1.0 + x);
        rule.weight[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

const Rule& rule_of(std::size_t order) {
    static const std::array<Rule, orders.back() + 1> rules = [] {
        std::array<Rule, orders.back() + 1> all;
        for (const std::size_t n : orders)
            all[n] = make_rule(n);
        return all;
    }();
    return rules[order];
}

bool is_parallelogram(std::span<const Point3> p) noexcept {
    if (p.size() != 4)
        return false;
    const Vector3 closing = (p[2] - p[1]) - (p[3] - p[0]);
    return length(closing) < 1e-9 * (distance(p[0], p[1]) + distance(p[0], p[3]));
}

} // namespace

Point3
evaluation_point(const Luminaire& luminaire, const Receiver& receiver, const Point3& clear) {
    const Point3& centre = luminaire.placement.world_from_luminaire.origin;
    if (distance(receiver.point, centre) < least_clearance)
        return clear;
    for (const Facet& facet : luminaire.opening.facets) {
        const double above = dot(facet.normal, receiver.point - facet.vertices.front());
        if (std::abs(above) < least_clearance)
            return clear;
    }
    return receiver.point;
}

OpeningLight::OpeningLight(const Scene& scene,
                           const Emission& emission,
                           const Receiver& receiver,
                           const Point3& clear,
                           std::size_t luminaire)
    : scene_(&scene), emission_(&emission), receiver_(&receiver), luminaire_(luminaire),
      at_(evaluation_point(emission.luminaire(luminaire), receiver, clear)),
      view_(emission.view(luminaire, at_)) {}

Look OpeningLight::look(double u, double v) const noexcept {
    Look k{view_.sample(u, v), {}, 0.0, {}};
    const Vector3 d = at_ - k.from.position;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return k;
    k.w = UnitVector3(d);
    k.response = evaluate_response(*receiver_, -k.w) / d2;
    k.departure = emission_->departure(k.from, k.w);
    return k;
}

double OpeningLight::value(const Look& look) const noexcept {
    if (look.response <= 0.0)
        return 0.0;
    const double density = view_.pdf(look.from);
    return density > 0.0 ? emission_->evaluate(look.from, look.w) * look.response / density
                         : 0.0;
}

std::optional<double> OpeningLight::unshadowed(double negligible) const noexcept {
    const Luminaire& l = emission_->luminaire(luminaire_);
    const Opening& opening = l.opening;
    if (opening.form == OpeningForm::point)
        return value(look(0.5, 0.5));
    const bool is_flat = opening.form == OpeningForm::flat;
    if (is_flat && is_planar(*receiver_)
        && std::holds_alternative<LambertianSource>(scene_->type_of(l).source)) {
        const Facet& facet = opening.facets.front();
        if (dot(facet.normal, at_ - facet.vertices.front()) <= 0.0)
            return 0.0;
        const double luminance = in_lumen(l.flux) / (pi * facet.area);
        return luminance * projected_solid_angle(facet.vertices, at_, receiver_->axis);
    }
    double sum = 0.0;
    for (std::size_t f = 0; f < opening.facets.size(); ++f) {
        const Facet& facet = opening.facets[f];
        if (!is_flat && dot(facet.normal, at_ - facet.vertices.front()) <= 0.0)
            continue;
        const std::optional<double> part =
            integrate(f, negligible / static_cast<double>(opening.facets.size()));
        if (!part)
            return std::nullopt;
        sum += *part;
    }
    return sum;
}

std::optional<double> OpeningLight::integrate(std::size_t facet,
                                              double negligible) const noexcept {
    const Luminaire& l = emission_->luminaire(luminaire_);
    const std::vector<Point3>& vertices = l.opening.facets[facet].vertices;
    if (is_planar(*receiver_)) {
        double lowest = 1e300;
        double highest = -1e300;
        for (const Point3& p : vertices) {
            const double height = dot(receiver_->axis, p - at_);
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
        if (highest <= 0.0)
            return 0.0;
        if (lowest < 0.0)
            return std::nullopt;
    }
    const double away = distance(at_, l.placement.world_from_luminaire.origin);
    double extent = l.opening.largest_dimension / away;
    double other_extent = extent;
    if (is_parallelogram(vertices)) { // long and narrow ones need few points across
        extent = std::min(extent, distance(vertices[0], vertices[1]) / away);
        other_extent = std::min(other_extent, distance(vertices[0], vertices[3]) / away);
    }
    const std::size_t second = second_rule(extent);
    const std::size_t other_second = second_rule(other_extent);
    if (std::max(second, other_second) == orders.size())
        return std::nullopt;                   // too near
    const auto apply = [&](std::size_t rule) { // 0, 1, 2, ...
        return apply_rule(facet, orders[second + rule - 1], orders[other_second + rule - 1]);
    };
    // Two rules may agree by chance; three rarely do. For a rough value
    // (negligible is infinite) two will do, unless they find nothing.
    constexpr double coarser = 4.0; // the first of them
    double before = apply(0);
    double change = 0.0;
    const std::size_t rules = orders.size() - std::max(second, other_second) + 1;
    for (std::size_t i = 1; i < rules; ++i) {
        const double now = apply(i);
        const double last_change = std::exchange(change, std::abs(now - before));
        const bool may_end = i > 1 || (std::isinf(negligible) && now > 0.0);
        if (may_end
            && std::max(change, last_change / coarser) <= std::max(agreement * now, negligible))
            return now;
        before = now;
    }
    return std::nullopt;
}

double OpeningLight::apply_rule(std::size_t facet,
                                std::size_t order,
                                std::size_t other_order) const noexcept {
    const std::vector<Point3>& p =
        emission_->luminaire(luminaire_).opening.facets[facet].vertices;
    const Rule& rule = rule_of(order);
    const Rule& other = rule_of(other_order);
    // c + s a + t (1 - fold s) b, s and t in (0, 1): a parallelogram (fold 0) or a triangle.
    const auto patch = [&](const Point3& c, const Vector3& a, const Vector3& b, double fold) {
        double sum = 0.0;
        for (std::size_t i = 0; i < order; ++i)
            for (std::size_t k = 0; k < other_order; ++k) {
                const double narrow = 1.0 - fold * rule.node[i];
                EmissionPoint from{luminaire_, facet, c};
                from.position = c + (rule.node[i] * a + (narrow * other.node[k]) * b);
                const Vector3 d = at_ - from.position;
                const double d2 = length_squared(d);
                if (!(d2 > 0.0))
                    continue;
                const UnitVector3 w(d);
                sum += rule.weight[i] * other.weight[k] * narrow * emission_->evaluate(from, w)
                       * evaluate_response(*receiver_, -w) / d2;
            }
        return sum * length(cross(a, b));
    };
    if (is_parallelogram(p))
        return patch(p[0], p[1] - p[0], p[3] - p[0], 0.0);
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i)
        sum += patch(p[0], p[i] - p[0], p[i + 1] - p[0], 1.0);
    return sum;
}

} // namespace isolux
