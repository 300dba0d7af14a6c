#include "isolux/io/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "isolux/scene/triangulate.h"

namespace isolux {

namespace {

struct Side {
    Point2 a;
    Point2 b;
};

Side side(std::span<const Point2> outline, std::size_t i) {
    return {outline[i], outline[(i + 1) % outline.size()]};
}

double cross(const Point2& o, const Point2& a, const Point2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double distance_to_side(const Point2& p, const Side& s) {
    const double ex = s.b.x - s.a.x;
    const double ey = s.b.y - s.a.y;
    const double squared = ex * ex + ey * ey;
    const double along = (p.x - s.a.x) * ex + (p.y - s.a.y) * ey;
    const double t = squared > 0.0 ? std::clamp(along / squared, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - s.a.x - t * ex, p.y - s.a.y - t * ey);
}

bool do_cross(const Side& s, const Side& t) {
    return (cross(s.a, s.b, t.a) > 0.0) != (cross(s.a, s.b, t.b) > 0.0)
           && (cross(t.a, t.b, s.a) > 0.0) != (cross(t.a, t.b, s.b) > 0.0);
}

double side_distance(const Side& s, const Side& t) {
    if (do_cross(s, t))
        return 0.0;
    return std::min({distance_to_side(s.a, t),
                     distance_to_side(s.b, t),
                     distance_to_side(t.a, s),
                     distance_to_side(t.b, s)});
}

/// The corner where two sides meet after each has moved inwards.
Point2
inset_corner(const Point2& before, const Point2& corner, const Point2& after, double by) {
    const double la = distance(before, corner);
    const double lb = distance(corner, after);
    const Point2 na{-(corner.y - before.y) / la, (corner.x - before.x) / la};
    const Point2 nb{-(after.y - corner.y) / lb, (after.x - corner.x) / lb};
    const double share = 1.0 + na.x * nb.x + na.y * nb.y; // 1 + cos of the turn
    constexpr double sharpest = 1e-6;                     // a hairpin has no inset corner
    const double k = by / std::max(share, sharpest);
    return {corner.x + k * (na.x + nb.x), corner.y + k * (na.y + nb.y)};
}

constexpr double least_overlap = 1e-3; // m

bool is_well_inside(const Point2& p, std::span<const Point2> outline) {
    return is_inside(p, outline) && distance_to_border(p, outline) > least_overlap;
}

/// Corners, middles of sides and middles of the triangles that make up the polygon.
std::vector<Point2> typical_points(const std::vector<Point2>& outline) {
    std::vector<Point2> points = outline;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto [a, b] = side(outline, i);
        points.push_back({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)});
    }
    for (const TriangleCorners& t : triangulate({outline})) {
        const Point2& a = outline[t[0]];
        const Point2& b = outline[t[1]];
        const Point2& c = outline[t[2]];
        points.push_back({(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0});
    }
    return points;
}

/// The sides cross, and reach more than `least_overlap` to either side of each other.
bool do_cross_well(const Side& s, const Side& t) {
    return do_cross(s, t) && distance_to_side(s.a, t) > least_overlap
           && distance_to_side(s.b, t) > least_overlap
           && distance_to_side(t.a, s) > least_overlap
           && distance_to_side(t.b, s) > least_overlap;
}

} // namespace

bool do_overlap(const std::vector<Point2>& a, const std::vector<Point2>& b) {
    for (const Point2& p : typical_points(a))
        if (is_well_inside(p, b))
            return true;
    for (const Point2& p : typical_points(b))
        if (is_well_inside(p, a))
            return true;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            if (do_cross_well(side(a, i), side(b, j)))
                return true;
    return false;
}

Rectangle2 bounding_rectangle(std::span<const Point2> outline) noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Rectangle2 r{{infinity, infinity}, {-infinity, -infinity}};
    for (const Point2& p : outline) {
        r.lower = {std::min(r.lower.x, p.x), std::min(r.lower.y, p.y)};
        r.upper = {std::max(r.upper.x, p.x), std::max(r.upper.y, p.y)};
    }
    return r;
}

double distance(const Point2& a, const Point2& b) noexcept {
    return std::hypot(b.x - a.x, b.y - a.y);
}

bool is_inside(const Point2& p, std::span<const Point2> outline) noexcept {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto [a, b] = side(outline, i);
        const bool crosses = (a.y > p.y) != (b.y > p.y);
        if (crosses && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

double distance_to_border(const Point2& p, std::span<const Point2> outline) noexcept {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outline.size(); ++i)
        nearest = std::min(nearest, distance_to_side(p, side(outline, i)));
    return nearest;
}

double border_distance(std::span<const Point2> a, std::span<const Point2> b) noexcept {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            nearest = std::min(nearest, side_distance(side(a, i), side(b, j)));
    return nearest;
}

std::vector<Point2> make_inset(std::span<const Point2> outline, double by) {
    if (by <= 0.0)
        return {outline.begin(), outline.end()};
    const std::size_t n = outline.size();
    std::vector<Point2> inset;
    for (std::size_t i = 0; i < n; ++i)
        inset.push_back(
            inset_corner(outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n], by));
    for (std::size_t i = 0; i < n; ++i) {
        const auto [a, b] = side(outline, i);
        const auto [c, d] = side(inset, i);
        if ((b.x - a.x) * (d.x - c.x) + (b.y - a.y) * (d.y - c.y) <= 0.0)
            return {};
    }
    constexpr double rounding = 1e-9;
    for (const Point2& p : inset)
        if (!is_inside(p, outline) || distance_to_border(p, outline) < by - rounding)
            return {};
    return is_simple(inset) ? inset : std::vector<Point2>{};
}

std::vector<Point2>
make_round_outline(const Point2& centre, double diameter, std::size_t corners) {
    const double step = 2.0 * std::numbers::pi / static_cast<double>(corners);
    const double radius = 0.5 * diameter * std::sqrt(step / std::sin(step));
    std::vector<Point2> outline;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = step * static_cast<double>(i);
        outline.push_back(
            {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
    }
    return outline;
}

} // namespace isolux
