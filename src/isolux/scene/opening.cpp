#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "isolux/scene/luminaire.h"

/// The facets of luminous openings, METHODS "Openings".
namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int sides_of_disc = 32;
constexpr int sides_of_cylinder = 24;
constexpr int meridians = 12; ///< of an ellipsoid
constexpr int parallels = 6;

/// A side of length zero beside others that are not (a lamp drawn as a line) gets this width,
/// m: light cannot leave an opening without area.
constexpr double least_width = 1e-3;

Facet make_facet(std::vector<Point3> vertices) {
    Vector3 twice_area;
    double sum = 0.0;
    std::vector<double> fan;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
        const Vector3 twice = cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
        twice_area = twice_area + twice;
        fan.push_back(sum += 0.5 * length(twice));
    }
    if (fan.size() <= 2)
        fan.clear();
    return {
        std::move(vertices), UnitVector3(twice_area), 0.5 * length(twice_area), std::move(fan)};
}

/// A plane to draw outlines in: the facet's normal is u x v.
struct Plane {
    Vector3 middle;
    Vector3 u;
    Vector3 v;

    [[nodiscard]] Point3 at(double a, double b) const noexcept {
        return Point3{} + (middle + a * u + b * v);
    }
};

Facet make_rectangle(const Plane& plane, double width, double height) {
    const double a = 0.5 * width, b = 0.5 * height;
    return make_facet({plane.at(-a, -b), plane.at(a, -b), plane.at(a, b), plane.at(-a, b)});
}

Facet make_ellipse(const Plane& plane, double width, double height, int sides) {
    // The inscribed polygon has n/2 sin(2 pi/n) of pi of the ellipse's area.
    const double scale = std::sqrt(2.0 * pi / (sides * std::sin(2.0 * pi / sides)));
    std::vector<Point3> vertices;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * pi * (i + 0.5) / sides;
        vertices.push_back(plane.at(0.5 * scale * width * std::cos(angle),
                                    0.5 * scale * height * std::sin(angle)));
    }
    return make_facet(std::move(vertices));
}

constexpr Vector3 ex{1, 0, 0};
constexpr Vector3 ey{0, 1, 0};
constexpr Vector3 ez{0, 0, 1};

std::vector<Facet> make_box(double x, double y, double z) {
    return {make_rectangle({0.5 * x * ex, ey, ez}, y, z),
            make_rectangle({-0.5 * x * ex, ez, ey}, z, y),
            make_rectangle({0.5 * y * ey, ez, ex}, z, x),
            make_rectangle({-0.5 * y * ey, ex, ez}, x, z),
            make_rectangle({0.5 * z * ez, ex, ey}, x, y),
            make_rectangle({-0.5 * z * ez, ey, ex}, y, x)};
}

double perimeter_of_ellipse(double width, double height) {
    const double a = 0.5 * std::max(width, height), b = 0.5 * std::min(width, height);
    return 4.0 * a * std::comp_ellint_2(std::sqrt(1.0 - (b / a) * (b / a)));
}

/// A cylinder of elliptic section `width` x `height` in the plane of u and v, axis along
/// u x v. The caps have the ellipse's area and the sides its perimeter; then the projected area
/// is right on average over all directions (Cauchy: a quarter of the surface).
std::vector<Facet>
make_cylinder(const Vector3& u, const Vector3& v, double width, double height, double length) {
    const Vector3 half_axis = 0.5 * length * cross(u, v);
    std::vector<Facet> facets{
        make_ellipse({half_axis, u, v}, width, height, sides_of_cylinder),
        make_ellipse({-half_axis, v, u}, height, width, sides_of_cylinder)};
    const auto rim = [&](int i) {
        const double angle = 2.0 * pi * (i + 0.5) / sides_of_cylinder;
        return 0.5 * width * std::cos(angle) * u + 0.5 * height * std::sin(angle) * v;
    };
    double perimeter = 0.0;
    for (int i = 0; i < sides_of_cylinder; ++i)
        perimeter += isolux::length(rim(i + 1) - rim(i));
    const double scale = perimeter_of_ellipse(width, height) / perimeter;
    for (int i = 0; i < sides_of_cylinder; ++i) {
        const Vector3 p = scale * rim(i), q = scale * rim(i + 1);
        facets.push_back(make_facet({Point3{} + (p - half_axis),
                                     Point3{} + (q - half_axis),
                                     Point3{} + (q + half_axis),
                                     Point3{} + (p + half_axis)}));
    }
    return facets;
}

/// Surface of an ellipsoid with semi-axes a, b, c: the unit sphere stretched, each element dw
/// becomes abc |(x/a, y/b, z/c)| dw. Midpoint rule in z and azimuth.
double surface_of_ellipsoid(double a, double b, double c) {
    constexpr int rings = 200, steps = 64;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = -1.0 + (2.0 * i + 1.0) / rings;
            const double r = std::sqrt(1.0 - z * z);
            const double azimuth = 2.0 * pi * j / steps;
            sum += length(Vector3{r * std::cos(azimuth) / a, r * std::sin(azimuth) / b, z / c});
        }
    return a * b * c * sum * 4.0 * pi / (rings * steps);
}

std::vector<Facet> make_ellipsoid(double x, double y, double z) {
    const auto facets_at = [=](double scale) {
        const auto at = [=](int ring, int step) {
            const double polar = pi * ring / parallels;
            const double azimuth = 2.0 * pi * (step % meridians) / meridians;
            return Point3{0.5 * scale * x * std::sin(polar) * std::cos(azimuth),
                          0.5 * scale * y * std::sin(polar) * std::sin(azimuth),
                          0.5 * scale * z * std::cos(polar)};
        };
        std::vector<Facet> facets;
        for (int ring = 0; ring < parallels; ++ring)
            for (int step = 0; step < meridians; ++step) {
                if (ring == 0)
                    facets.push_back(make_facet({at(0, 0), at(1, step), at(1, step + 1)}));
                else if (ring + 1 == parallels)
                    facets.push_back(
                        make_facet({at(ring, step), at(parallels, 0), at(ring, step + 1)}));
                else
                    facets.push_back(make_facet({at(ring, step),
                                                 at(ring + 1, step),
                                                 at(ring + 1, step + 1),
                                                 at(ring, step + 1)}));
            }
        return facets;
    };
    double faceted = 0.0;
    for (const Facet& f : facets_at(1.0))
        faceted += f.area;
    return facets_at(std::sqrt(surface_of_ellipsoid(0.5 * x, 0.5 * y, 0.5 * z) / faceted));
}

} // namespace

Opening make_opening(const LuminousOpening& opening) {
    const double given[] = {
        in_metre(opening.extent_x), in_metre(opening.extent_y), in_metre(opening.extent_z)};
    const double largest = std::max({given[0], given[1], given[2]});
    if (opening.shape == OpeningShape::point || !(largest > 0.0))
        return {};
    const double x = std::max(given[0], least_width);
    const double y = std::max(given[1], least_width);
    const double z = std::max(given[2], least_width);
    const Plane down{{}, ey, ex};
    const Plane ahead{{}, ey, ez};
    switch (opening.shape) {
    case OpeningShape::point:
        break;
    case OpeningShape::rectangle:
        return {OpeningForm::flat, {make_rectangle(down, y, x)}, std::max(x, y)};
    case OpeningShape::ellipse:
        return {OpeningForm::flat, {make_ellipse(down, y, x, sides_of_disc)}, std::max(x, y)};
    case OpeningShape::vertical_ellipse:
        return {OpeningForm::flat, {make_ellipse(ahead, y, z, sides_of_disc)}, std::max(y, z)};
    case OpeningShape::box:
        return {OpeningForm::solid, make_box(x, y, z), largest};
    case OpeningShape::vertical_cylinder:
        return {OpeningForm::solid, make_cylinder(ex, ey, x, y, z), largest};
    case OpeningShape::cylinder_along_x:
        return {OpeningForm::solid, make_cylinder(ey, ez, y, z, x), largest};
    case OpeningShape::cylinder_along_y:
        return {OpeningForm::solid, make_cylinder(ez, ex, z, x, y), largest};
    case OpeningShape::ellipsoid:
        return {OpeningForm::solid, make_ellipsoid(x, y, z), largest};
    }
    return {};
}

} // namespace isolux
