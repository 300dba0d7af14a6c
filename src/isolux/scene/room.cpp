#include "isolux/scene/room.h"

#include <algorithm>
#include <cmath>

namespace isolux {
namespace {

/// Points this close to a border, in metres, lie on it.
constexpr double border = 1e-6;

double cross(const Point2& o, const Point2& a, const Point2& b) noexcept {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double distance_to_segment(const Point2& p, const Point2& a, const Point2& b) noexcept {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double l2 = dx * dx + dy * dy;
    const double t =
        l2 > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / l2, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

enum class Side { inside, on_border, outside };

Side side_of(const std::vector<Point2>& polygon, const Point2& p) noexcept {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (distance_to_segment(p, a, b) <= border)
            return Side::on_border;
        // Count crossings of the ray towards +x.
        if ((a.y > p.y) != (b.y > p.y) && (cross(a, b, p) > 0.0) == (b.y > a.y))
            inside = !inside;
    }
    return inside ? Side::inside : Side::outside;
}

/// True if the segments have a point in common.
bool segments_meet(const Point2& a,
                   const Point2& b,
                   const Point2& c,
                   const Point2& d) noexcept {
    const double c1 = cross(a, b, c), c2 = cross(a, b, d);
    const double d1 = cross(c, d, a), d2 = cross(c, d, b);
    if (((c1 > 0.0) != (c2 > 0.0)) && ((d1 > 0.0) != (d2 > 0.0)) && c1 != 0.0 && c2 != 0.0
        && d1 != 0.0 && d2 != 0.0)
        return true;
    return distance_to_segment(a, c, d) <= border || distance_to_segment(b, c, d) <= border
           || distance_to_segment(c, a, b) <= border || distance_to_segment(d, a, b) <= border;
}

} // namespace

double signed_area(const std::vector<Point2>& polygon) noexcept {
    double sum = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += cross(polygon[0], polygon[i], polygon[i + 1]);
    return 0.5 * sum;
}

bool is_simple(const std::vector<Point2>& polygon) noexcept {
    const std::size_t n = polygon.size();
    if (n < 3)
        return false;
    for (std::size_t i = 0; i < n; ++i) {
        const Point2 &a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
        if (std::hypot(b.x - a.x, b.y - a.y) <= border)
            return false;
        // Neighbouring edges share a corner and nothing else: no turning back on itself.
        if (distance_to_segment(c, a, b) <= border || distance_to_segment(a, b, c) <= border)
            return false;
        for (std::size_t j = i + 2; j < n && !(i == 0 && j == n - 1); ++j)
            if (segments_meet(a, b, polygon[j], polygon[(j + 1) % n]))
                return false;
    }
    return true;
}

bool contains(const Room& room, const Point3& p) noexcept {
    if (p.z < room.floor_level - border || p.z > room.floor_level + room.height + border)
        return false;
    const Point2 q{p.x, p.y};
    return side_of(room.footprint, q) != Side::outside
           && std::ranges::none_of(room.columns, [&](const Column& column) {
                  return side_of(column.outline, q) == Side::inside;
              });
}

} // namespace isolux
