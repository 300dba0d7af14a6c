#include "isolux/base/polygon.h"

#include <cmath>
#include <cstddef>

namespace isolux {

namespace {

/// An edge seen along its own line, or from its end, has no plane with the eye and adds
/// nothing.
constexpr double least_sine = 1e-12;

/// Angle under which the edge from `a` to `b` is seen times n . g, g the unit normal of the
/// plane through edge and eye: one term of METHODS eq. (12).
double edge_term(const Vector3& a, const Vector3& b, const Vector3& n) noexcept {
    const Vector3 c = cross(a, b);
    const double c2 = length_squared(c);
    if (c2 <= least_sine * least_sine * length_squared(a) * length_squared(b))
        return 0.0;
    const double c1 = std::sqrt(c2);
    return std::atan2(c1, dot(a, b)) * dot(n, c) / c1;
}

/// Where the segment from height ha > 0 to hb <= 0, or the reverse, meets height 0.
template <class T> T crossing(const T& a, double ha, const T& b, double hb) noexcept {
    return a + (ha / (ha - hb)) * (b - a);
}

} // namespace

std::vector<Point3> clip_to_half_space(std::span<const Point3> polygon,
                                       const Point3& point,
                                       const Vector3& normal) {
    std::vector<Point3> kept;
    kept.reserve(polygon.size() + 1);
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point3& a = polygon[i];
        const Point3& b = polygon[(i + 1) % n];
        const double ha = dot(normal, a - point);
        const double hb = dot(normal, b - point);
        if (ha >= 0.0)
            kept.push_back(a);
        if ((ha > 0.0 && hb < 0.0) || (ha < 0.0 && hb > 0.0))
            kept.push_back(crossing(a, ha, b, hb));
    }
    if (kept.size() < 3)
        kept.clear();
    return kept;
}

double projected_solid_angle(std::span<const Point3> polygon,
                             const Point3& point,
                             const UnitVector3& normal) noexcept {
    const Vector3 n = normal;
    double sum = 0.0;
    Vector3 first_entry;
    Vector3 exit;
    bool is_open = false; // left through the horizon and not yet back
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3 a = polygon[i] - point;
        const Vector3 b = polygon[i + 1 < polygon.size() ? i + 1 : 0] - point;
        const double ha = dot(n, a);
        const double hb = dot(n, b);
        if (ha > 0.0 && hb > 0.0) {
            sum += edge_term(a, b, n);
        } else if (ha > 0.0) {
            exit = crossing(a, ha, b, hb);
            is_open = true;
            sum += edge_term(a, exit, n);
        } else if (hb > 0.0) {
            const Vector3 entry = crossing(a, ha, b, hb);
            sum += edge_term(entry, b, n);
            if (is_open)
                sum += edge_term(exit, entry, n); // along the horizon
            else
                first_entry = entry; // the walk began below the horizon
            is_open = false;
        }
    }
    if (is_open)
        sum += edge_term(exit, first_entry, n);
    return 0.5 * std::abs(sum);
}

} // namespace isolux
