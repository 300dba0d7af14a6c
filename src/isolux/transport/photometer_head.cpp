#include "isolux/transport/photometer_head.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"
#include "isolux/base/polygon.h"
#include "isolux/sampling/warp.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/vertex_draws.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t corners = 24;

/// Beyond so many radii the disc counts as its middle: the mean kernel differs from it by less
/// than 0.5 %, METHODS "Photometer head".
constexpr double near_radii = 20.0;

/// A receiver this near to a surface lies on it, m.
constexpr double on_surface = 1e-4;

/// How far along `way` the head may reach: to the next surface, and on the surface it lies on
/// no farther than that goes.
double reach_along(const Scene& scene,
                   const Receiver& receiver,
                   const Point3& at,
                   const UnitVector3& way,
                   double radius,
                   bool lies_on_surface) {
    double reach = radius;
    if (const auto hit = scene.caster.find_first_hit(at, way, radius))
        reach = std::min(reach, hit->distance);
    if (!lies_on_surface)
        return reach;
    const auto has_ground = [&](double r) {
        return scene.caster
            .find_first_hit(at + r * Vector3(way), -receiver.axis, 10.0 * on_surface)
            .has_value();
    };
    if (has_ground(reach))
        return reach;
    double low = 0.0;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (low + reach);
        (has_ground(middle) ? low : reach) = middle;
    }
    return low;
}

/// A point of the head, uniform over its area: the outline is a star around its middle.
Point3 place_on_head(const PhotometerHead& head, const Point3& middle, double u, double v) {
    double left = u * head.area;
    for (std::size_t i = 0;; ++i) {
        const Point3& a = head.outline[i];
        const Point3& b = head.outline[(i + 1) % head.outline.size()];
        const double area = 0.5 * length(cross(a - middle, b - middle));
        if (left >= area && i + 1 < head.outline.size()) {
            left -= area;
            continue;
        }
        const double share = area > 0.0 ? std::min(left / area, 1.0) : 0.0;
        return sample_polygon(std::array{middle, a, b}, share, v);
    }
}

/// Kernel of one vertex at the head, 1/m2: METHODS eq. (77) near by, eq. (5) far away.
double kernel_at(const Receiver& receiver,
                 const Point3& at,
                 const PhotometerHead& head,
                 const PathVertex& v) noexcept {
    const Vector3 d = v.position - at;
    const double height = dot(receiver.axis, d);
    const double d2 = length_squared(d);
    if (height <= 0.0 || !(d2 > 0.0))
        return 0.0;
    if (d2 < head.reach * head.reach)
        return projected_solid_angle(head.outline, v.position, v.normal) / head.area;
    const double cos_v = -dot(v.normal, d);
    return cos_v > 0.0 ? cos_v * height / (d2 * d2) : 0.0;
}

} // namespace

PhotometerHead
make_photometer_head(const Scene& scene, const Receiver& receiver, double radius) {
    ISOLUX_EXPECT(radius > 0.0 && receiver.kind == IlluminanceKind::planar);
    const Point3 at = clear_point(scene, receiver);
    const Basis basis = make_basis(receiver.axis);
    const bool lies_on_surface =
        scene.caster.find_first_hit(at, -receiver.axis, 10.0 * on_surface).has_value();
    // A polygon of the disc's area.
    const double step = 2.0 * pi / corners;
    const double corner = radius * std::sqrt(step / std::sin(step));
    PhotometerHead head;
    head.reach = near_radii * radius;
    std::vector<double> reaches;
    for (std::size_t i = 0; i < corners; ++i) {
        const double phi = step * static_cast<double>(i);
        const UnitVector3 way(basis.to_world({std::cos(phi), std::sin(phi), 0.0}));
        const double r = reach_along(scene, receiver, at, way, corner, lies_on_surface);
        head.is_cut = head.is_cut || r < corner;
        reaches.push_back(std::max(r, 1e-6 * radius));
        head.outline.push_back(at + reaches.back() * Vector3(way));
    }
    for (std::size_t i = 0; i < corners; ++i)
        head.area += 0.5 * std::sin(step) * reaches[i] * reaches[(i + 1) % corners];
    return head;
}

Rgb estimate_at_head(const Scene& scene,
                     const VertexCache& cache,
                     const Receiver& receiver,
                     const PhotometerHead& head,
                     std::size_t draws,
                     double offset,
                     std::uint32_t first,
                     const PointRandomness& random) {
    ISOLUX_EXPECT(draws > 0);
    if (cache.empty())
        return {};
    const Point3 at = clear_point(scene, receiver);
    std::vector<double> u;
    u.reserve(cache.size());
    for (const PathVertex& v : cache.vertices)
        u.push_back(luminance_sum(v.radiant) * kernel_at(receiver, at, head, v));
    Rgb sum;
    std::uint32_t sample = first;
    const double total = draw_in_proportion(u, draws, offset, [&](std::size_t i) {
        NumberSequence numbers(random, sample++);
        const PathVertex& v = cache.vertices[i];
        Point3 from = at;
        if (length_squared(v.position - at) < head.reach * head.reach) {
            const double a = numbers.next();
            from = place_on_head(head, at, a, numbers.next());
        }
        const double visible = scene.caster.transmittance(from, v.position);
        sum += (visible / luminance_sum(v.radiant)) * v.radiant;
    });
    return (total / (static_cast<double>(cache.paths) * static_cast<double>(draws))) * sum;
}

} // namespace isolux
