#include "isolux/validate/shadow_and_mirror.h"

#include <cstddef>
#include <vector>

#include "isolux/base/check.h"
#include "isolux/base/polygon.h"
#include "isolux/validate/lambertian_shapes.h"

namespace isolux {

namespace {

/// `v` or its opposite, whichever points to the side of `side`.
Vector3 turned_to(const Vector3& v, const Vector3& side) noexcept {
    return dot(v, side) >= 0.0 ? v : -v;
}

UnitVector3 mirror_normal(const FlatMirror& m) noexcept {
    ISOLUX_EXPECT(m.outline.size() >= 3);
    return UnitVector3(cross(m.outline[1] - m.outline[0], m.outline[2] - m.outline[0]));
}

double height_above(const FlatMirror& m, const Point3& p) noexcept {
    return dot(mirror_normal(m), p - m.outline[0]);
}

Vector3 mirror_vector(const Vector3& v, const UnitVector3& n) noexcept {
    return v - 2.0 * dot(n, v) * Vector3(n);
}

/// Inward normals of the planes through the eye and the mirror's edges.
std::vector<Vector3> pyramid(const FlatMirror& m, const Point3& eye) {
    Vector3 middle;
    for (const Point3& p : m.outline)
        middle = middle + (p - eye);
    std::vector<Vector3> planes;
    for (std::size_t i = 0; i < m.outline.size(); ++i) {
        const Vector3 a = m.outline[i] - eye;
        const Vector3 b = m.outline[(i + 1) % m.outline.size()] - eye;
        planes.push_back(turned_to(cross(a, b), middle));
    }
    return planes;
}

} // namespace

Lux penumbra_illuminance(std::span<const Point3> polygon,
                         CandelaPerSquareMetre luminance,
                         const OccludingEdge& edge,
                         const Point3& point,
                         const UnitVector3& normal) {
    const Vector3 plane = turned_to(cross(edge.direction, edge.point - point), edge.open_side);
    return polygon_illuminance(
        clip_to_half_space(polygon, point, plane), luminance, point, normal);
}

Point3 mirror_image(const Point3& p, const FlatMirror& mirror) noexcept {
    return p - 2.0 * height_above(mirror, p) * Vector3(mirror_normal(mirror));
}

Lux mirrored_illuminance(const IdealPointSource& source,
                         const FlatMirror& mirror,
                         const Point3& point,
                         const UnitVector3& normal) {
    if (height_above(mirror, source.position) * height_above(mirror, point) <= 0.0)
        return Lux(0.0);
    const IdealPointSource image{
        mirror_image(source.position, mirror),
        source.flux,
        UnitVector3::from_unit(mirror_vector(source.axis, mirror_normal(mirror))),
        source.exponent};
    for (const Vector3& plane : pyramid(mirror, point))
        if (dot(plane, image.position - point) < 0.0)
            return Lux(0.0);
    return mirror.reflectance * point_source_illuminance(image, {point, normal});
}

Lux mirrored_illuminance(std::span<const Point3> polygon,
                         CandelaPerSquareMetre luminance,
                         const FlatMirror& mirror,
                         const Point3& point,
                         const UnitVector3& normal) {
    std::vector<Point3> image;
    for (const Point3& p : polygon)
        image.push_back(mirror_image(p, mirror));
    for (const Vector3& plane : pyramid(mirror, point))
        image = clip_to_half_space(image, point, plane);
    return mirror.reflectance * polygon_illuminance(image, luminance, point, normal);
}

} // namespace isolux
