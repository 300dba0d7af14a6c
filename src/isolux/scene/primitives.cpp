#include "isolux/scene/primitives.h"

#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

namespace isolux {
namespace {

/// The prism between an outline (counter-clockwise seen from above) at z = 0 and at `height`.
SurfaceMesh make_prism(std::vector<Point3> points, double height) {
    const auto n = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t i = 0; i < n; ++i)
        points.push_back(points[i] + Vector3{0, 0, height});
    std::vector<std::vector<std::uint32_t>> faces(2);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        faces[0].push_back(n - 1 - i);
        faces[1].push_back(n + i);
        faces.push_back({i, j, n + j, n + i});
    }
    return {points, faces};
}

} // namespace

SurfaceMesh make_box(const Vector3& size) {
    ISOLUX_EXPECT(size.x > 0.0 && size.y > 0.0 && size.z > 0.0);
    const double x = 0.5 * size.x, y = 0.5 * size.y;
    return make_prism({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, size.z);
}

SurfaceMesh make_cylinder(double diameter, double height, int segments) {
    ISOLUX_EXPECT(diameter > 0.0 && height > 0.0 && segments >= 3);
    constexpr double pi = std::numbers::pi;
    // n/2 R^2 sin(2 pi / n), the polygon's area, equals pi r^2.
    const double R =
        0.5 * diameter * std::sqrt(2.0 * pi / (segments * std::sin(2.0 * pi / segments)));
    std::vector<Point3> outline;
    for (int i = 0; i < segments; ++i) {
        const double angle = 2.0 * pi * i / segments;
        outline.push_back({R * std::cos(angle), R * std::sin(angle), 0.0});
    }
    return make_prism(std::move(outline), height);
}

SurfaceMesh make_panel(double width, double height) {
    ISOLUX_EXPECT(width > 0.0 && height > 0.0);
    const double x = 0.5 * width;
    const Point3 points[] = {{-x, 0, 0}, {x, 0, 0}, {x, 0, height}, {-x, 0, height}};
    const std::vector<std::uint32_t> faces[] = {{0, 1, 2, 3}};
    return {points, faces};
}

} // namespace isolux
