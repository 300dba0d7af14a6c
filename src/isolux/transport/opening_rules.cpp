#include "isolux/transport/opening_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Two rules in a row that agree to this share are believed.
constexpr double agreement = 2e-5;

/// ... if the first of them differed by no more than this many times so much from its own: two
/// rules may agree by chance, three rarely do.
constexpr double coarser = 4.0;

constexpr std::array<std::size_t, 9> orders{1, 2, 3, 4, 6, 9, 12, 18, 27};

/// The second rule's points stand no farther apart than this, rad, as seen from the eye: about
/// the step of a table, so that no beam hides between them.
constexpr double widest_step = 0.1;

/// Places of one polygon at most, or for each of its corners where that is more; with more it
/// is as well drawn at random.
constexpr std::size_t most_places = 8192;
constexpr std::size_t most_places_of_a_corner = 2048;

/// Number in `orders` of the second rule along a side that is seen this long, rad; the number
/// of orders where none is fine enough.
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

/// corner + s a + t b with s and t in (0, 1), or a triangle: corner + s a + t (1 - s) b.
struct Patch {
    Point3 corner;
    Vector3 a;
    Vector3 b;
    bool is_triangle = false;
    double extent = 0.0; ///< along a, as the eye sees it, rad
    double other_extent = 0.0;

    [[nodiscard]] double area() const noexcept {
        return length(cross(a, b)) * (is_triangle ? 0.5 : 1.0);
    }

    void measure(const Point3& eye) noexcept {
        const double share = is_triangle ? 1.0 / 3.0 : 0.5;
        const double away = distance(eye, corner + share * (a + b));
        extent = length(a) / away;
        other_extent = length(b) / away;
        if (is_triangle) // the points of both rules run along the third side, too
            extent = other_extent = std::max({extent, other_extent, length(a - b) / away});
    }

    [[nodiscard]] std::pair<Patch, Patch> halves() const noexcept {
        const Vector3 third = b - a;
        if (!is_triangle) {
            if (extent >= other_extent)
                return {{corner, 0.5 * a, b}, {corner + 0.5 * a, 0.5 * a, b}};
            return {{corner, a, 0.5 * b}, {corner + 0.5 * b, a, 0.5 * b}};
        }
        const double longest = std::max({length(a), length(b), length(third)});
        if (length(a) == longest)
            return {{corner, 0.5 * a, b, true}, {corner + 0.5 * a, 0.5 * a, b - 0.5 * a, true}};
        if (length(b) == longest)
            return {{corner, a, 0.5 * b, true}, {corner + 0.5 * b, a - 0.5 * b, 0.5 * b, true}};
        return {{corner, a, a + 0.5 * third, true}, {corner, a + 0.5 * third, b, true}};
    }
};

bool is_parallelogram(std::span<const Point3> p) noexcept {
    if (p.size() != 4)
        return false;
    const Vector3 closing = (p[2] - p[1]) - (p[3] - p[0]);
    return length(closing) < 1e-9 * (distance(p[0], p[1]) + distance(p[0], p[3]));
}

class Integral {
public:
    Integral(const Point3& eye, const PlaceDensity& density, std::size_t corners)
        : eye_(eye), density_(density),
          most_(std::max(most_places, corners * most_places_of_a_corner)) {}

    std::optional<RuleValue> over(Patch patch, double negligible) {
        if (!(patch.area() > 0.0))
            return RuleValue{};
        patch.measure(eye_);
        if (!(std::max(patch.extent, patch.other_extent) < 1e6))
            return std::nullopt; // the eye is in it
        if (const std::optional<RuleValue> whole = by_rules(patch, negligible))
            return whole;
        if (places_ >= most_)
            return std::nullopt;
        places_ += 4; // halving has an end, too
        const auto [one, other] = patch.halves();
        std::optional<RuleValue> sum = over(one, 0.5 * negligible);
        const std::optional<RuleValue> second =
            sum ? over(other, 0.5 * negligible) : std::nullopt;
        if (!second)
            return std::nullopt;
        return *sum += *second;
    }

private:
    std::optional<RuleValue> by_rules(const Patch& patch, double negligible) {
        const std::size_t first = second_rule(patch.extent);
        const std::size_t other = second_rule(patch.other_extent);
        const std::size_t last = std::max(first, other);
        const std::size_t rules =
            std::isinf(negligible) ? 1 : 2; // that have to follow the first
        if (last + rules > orders.size())
            return std::nullopt;                // too near
        const auto apply = [&](std::size_t i) { // 0, 1, 2, ...
            return apply_rule(patch, orders[first + i - 1], orders[other + i - 1]);
        };
        double before = apply(0);
        double change = 0.0;
        for (std::size_t i = 1; i <= orders.size() - last; ++i) {
            if (places_ >= most_)
                return std::nullopt;
            const double now = apply(i);
            const double last_change = std::exchange(change, std::abs(now - before));
            // For a rough value two will do, unless they find nothing.
            const bool may_end = i > 1 || (std::isinf(negligible) && now > 0.0);
            if (may_end
                && std::max(change, last_change / coarser)
                       <= std::max(agreement * now, negligible))
                return RuleValue{now, change};
            before = now;
        }
        return std::nullopt;
    }

    double apply_rule(const Patch& patch, std::size_t order, std::size_t other_order) {
        const Rule& rule = rule_of(order);
        const Rule& other = rule_of(other_order);
        double sum = 0.0;
        for (std::size_t i = 0; i < order; ++i) {
            const double narrow = patch.is_triangle ? 1.0 - rule.node[i] : 1.0;
            for (std::size_t k = 0; k < other_order; ++k)
                sum +=
                    rule.weight[i] * other.weight[k] * narrow
                    * density_(patch.corner
                               + (rule.node[i] * patch.a + (narrow * other.node[k]) * patch.b));
        }
        places_ += order * other_order;
        return sum * length(cross(patch.a, patch.b));
    }

    Point3 eye_;
    const PlaceDensity& density_;
    std::size_t places_ = 0;
    std::size_t most_;
};

} // namespace

std::optional<RuleValue> integrate_polygon(std::span<const Point3> polygon,
                                           const Point3& eye,
                                           double negligible,
                                           const PlaceDensity& density) {
    Integral integral(eye, density, polygon.size());
    if (is_parallelogram(polygon))
        return integral.over({polygon[0], polygon[1] - polygon[0], polygon[3] - polygon[0]},
                             negligible);
    RuleValue sum;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const std::optional<RuleValue> part = integral.over(
            {polygon[0], polygon[i] - polygon[0], polygon[i + 1] - polygon[0], true},
            negligible / static_cast<double>(polygon.size() - 2));
        if (!part)
            return std::nullopt;
        sum += *part;
    }
    return sum;
}

} // namespace isolux
