#include "isolux/measure/surface_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "isolux/base/check.h"

namespace isolux {

namespace {

constexpr double rounding = 1e-9; ///< lengths that differ by less, relatively, are equal

std::size_t at_least_one(double n) noexcept {
    return static_cast<std::size_t>(std::max(1.0, n));
}

std::size_t count_up(double side, double spacing) noexcept {
    return at_least_one(std::ceil(side / spacing * (1.0 - rounding)));
}

std::size_t count_nearest(double side, double spacing) noexcept {
    return at_least_one(std::floor(side / spacing + 0.5));
}

std::size_t count_odd(double side, double spacing) noexcept {
    return count_up(side, spacing) | 1U;
}

/// EN 12464-1:2011, 4.4: d/p decides one side, and the spacing found there the other one.
GridCounts make_nearest_grid(double u, double v, double p) noexcept {
    const bool is_long = std::max(u, v) >= 2.0 * std::min(u, v) * (1.0 - rounding);
    const bool u_leads = is_long ? u <= v : u >= v;
    const double leading = u_leads ? u : v;
    const double other = u_leads ? v : u;
    const std::size_t n = count_nearest(leading, p);
    const std::size_t m = count_nearest(other, leading / static_cast<double>(n));
    return u_leads ? GridCounts{n, m} : GridCounts{m, n};
}

struct PlanePoint {
    double x = 0.0;
    double y = 0.0;
};

bool is_on_segment(PlanePoint p, PlanePoint a, PlanePoint b, double tolerance) noexcept {
    const double ex = b.x - a.x;
    const double ey = b.y - a.y;
    const double squared = ex * ex + ey * ey;
    const double along = (p.x - a.x) * ex + (p.y - a.y) * ey;
    const double t = squared > 0.0 ? std::clamp(along / squared, 0.0, 1.0) : 0.0;
    return std::hypot(p.x - a.x - t * ex, p.y - a.y - t * ey) <= tolerance;
}

/// Even-odd rule, with the border belonging to the inside.
bool is_inside(PlanePoint p,
               const std::vector<PlanePoint>& polygon,
               double tolerance) noexcept {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const PlanePoint a = polygon[i];
        const PlanePoint b = polygon[(i + 1) % polygon.size()];
        if (is_on_segment(p, a, b, tolerance))
            return true;
        const bool crosses = (a.y > p.y) != (b.y > p.y);
        if (crosses && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

UnitVector3 axis_of(IlluminanceKind kind, const UnitVector3& normal) noexcept {
    const bool is_upright =
        kind == IlluminanceKind::cylindrical || kind == IlluminanceKind::semi_cylindrical;
    return is_upright ? UnitVector3::from_unit({0, 0, 1}) : normal;
}

} // namespace

Metre standard_spacing(Metre side_u, Metre side_v) {
    ISOLUX_EXPECT(in_metre(side_u) > 0.0 && in_metre(side_v) > 0.0);
    const double shorter = std::min(in_metre(side_u), in_metre(side_v));
    const double longer = std::max(in_metre(side_u), in_metre(side_v));
    const double d = longer >= 2.0 * shorter * (1.0 - rounding) ? shorter : longer;
    return Metre(std::min(10.0, 0.2 * std::pow(5.0, std::log10(d))));
}

GridCounts make_standard_grid(Metre side_u, Metre side_v, GridRounding rule) {
    const double u = in_metre(side_u);
    const double v = in_metre(side_v);
    const double p = in_metre(standard_spacing(side_u, side_v));
    switch (rule) {
    case GridRounding::up:
        return {count_up(u, p), count_up(v, p)};
    case GridRounding::odd:
        return {count_odd(u, p), count_odd(v, p)};
    case GridRounding::nearest:
        break;
    }
    return make_nearest_grid(u, v, p);
}

CalculationSurface make_grid_surface(std::string name,
                                     const Frame& corner_frame,
                                     Metre width,
                                     Metre height,
                                     GridCounts counts,
                                     std::vector<Point3> outline,
                                     IlluminanceKind kind,
                                     const UnitVector3& reference) {
    ISOLUX_EXPECT(in_metre(width) > 0.0 && in_metre(height) > 0.0);
    ISOLUX_EXPECT(counts.columns >= 1 && counts.rows >= 1);
    GridLayout grid{corner_frame, in_metre(width), in_metre(height), counts, {}};
    const double tolerance = rounding * std::hypot(grid.width, grid.height);

    std::vector<PlanePoint> polygon;
    for (const Point3& p : outline) {
        const Vector3 local = corner_frame.point_to_local(p);
        polygon.push_back({local.x, local.y});
    }

    CalculationSurface surface{std::move(name), kind, {}, {}, std::move(outline)};
    const double dx = grid.width / static_cast<double>(counts.columns);
    const double dy = grid.height / static_cast<double>(counts.rows);
    for (std::size_t j = 0; j < counts.rows; ++j)
        for (std::size_t i = 0; i < counts.columns; ++i) {
            const PlanePoint p{(static_cast<double>(i) + 0.5) * dx,
                               (static_cast<double>(j) + 0.5) * dy};
            if (!polygon.empty() && !is_inside(p, polygon, tolerance))
                continue;
            grid.cell_of_point.push_back(j * counts.columns + i);
            surface.receivers.push_back({corner_frame.point_from_local({p.x, p.y, 0.0}),
                                         axis_of(kind, corner_frame.z),
                                         kind,
                                         reference});
        }
    surface.grid = std::move(grid);
    return surface;
}

} // namespace isolux
