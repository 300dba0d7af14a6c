#include "isolux/validate/lambertian_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"
#include "isolux/base/polygon.h"

namespace isolux {

namespace {

using std::numbers::pi;

/// Element under the corner of a parallel rectangle x by y at distance c; odd in x and in y, so
/// that four of them make any rectangle. METHODS "Closed answers", row 4, without the 1/pi.
double parallel_corner(double x, double y, double c) noexcept {
    const double p = std::hypot(c, x);
    const double q = std::hypot(c, y);
    return 0.5 * (x / p * std::atan(y / p) + y / q * std::atan(x / q));
}

/// Element at the foot corner of a wall y wide and z high at distance c; odd in y. Row 5.
double perpendicular_corner(double y, double z, double c) noexcept {
    const double p = std::hypot(c, z);
    return 0.5 * (std::atan(y / c) - c / p * std::atan(y / p));
}

/// pi L F for a disc needs t = x2 + h2 and the root of (t + a2)^2 - 4 a2 x2, written as a
/// product that does not cancel.
double disc_root(const LambertianDisc& d) noexcept {
    return std::hypot(d.height, d.offset + d.radius)
           * std::hypot(d.height, d.offset - d.radius);
}

} // namespace

Lux illuminance_from(const ParallelRectangle& s, CandelaPerSquareMetre luminance) noexcept {
    const auto corner = [&](double x, double y) { return parallel_corner(x, y, s.height); };
    return Lux(
        in_candela_per_square_metre(luminance)
        * (corner(s.x1, s.y1) - corner(s.x0, s.y1) - corner(s.x1, s.y0) + corner(s.x0, s.y0)));
}

Lux illuminance_from(const PerpendicularRectangle& s,
                     CandelaPerSquareMetre luminance) noexcept {
    const double bottom = std::max(0.0, s.z0);
    const double top = std::max(0.0, s.z1);
    const auto corner = [&](double y, double z) {
        return perpendicular_corner(y, z, s.distance);
    };
    return Lux(in_candela_per_square_metre(luminance)
               * (corner(s.y1, top) - corner(s.y0, top) - corner(s.y1, bottom)
                  + corner(s.y0, bottom)));
}

Lux illuminance_from(const LambertianDisc& s, CandelaPerSquareMetre luminance) noexcept {
    const double t = s.offset * s.offset + s.height * s.height;
    return Lux(0.5 * pi * in_candela_per_square_metre(luminance)
               * (1.0 - (t - s.radius * s.radius) / disc_root(s)));
}

Lux vertical_illuminance_from(const LambertianDisc& s,
                              CandelaPerSquareMetre luminance) noexcept {
    ISOLUX_EXPECT(s.offset >= s.radius && s.radius > 0.0);
    const double t = s.offset * s.offset + s.height * s.height;
    return Lux(0.5 * pi * in_candela_per_square_metre(luminance) * s.height / s.offset
               * ((t + s.radius * s.radius) / disc_root(s) - 1.0));
}

Lux illuminance_from(const LambertianSphere& s, CandelaPerSquareMetre luminance) noexcept {
    ISOLUX_EXPECT(s.distance > s.radius);
    const double h = s.distance / s.radius;
    const double c = std::cos(s.tilt.in_radians());
    const double full = pi * in_candela_per_square_metre(luminance);
    if (c >= 1.0 / h)
        return Lux(full * c / (h * h));
    if (c <= -1.0 / h)
        return Lux(0.0);
    const double sine = std::sin(s.tilt.in_radians());
    const double q = std::sqrt((h - 1.0) * (h + 1.0));
    const double cot = c / sine;
    return Lux(full
               * (0.5 - std::asin(std::min(1.0, q / (h * sine))) / pi
                  + (c * std::acos(std::clamp(-q * cot, -1.0, 1.0))
                     - q * std::sqrt(std::max(0.0, 1.0 - h * h * c * c)))
                        / (pi * h * h)));
}

Lux illuminance_from(const LambertianLine& s, double intensity_per_metre) noexcept {
    const auto end = [&](double x) {
        const double psi = std::atan(x / s.distance);
        return psi + std::sin(psi) * std::cos(psi);
    };
    return Lux(intensity_per_metre * s.height / (2.0 * s.distance * s.distance)
               * (end(s.x1) - end(s.x0)));
}

Lux polygon_illuminance(std::span<const Point3> polygon,
                        CandelaPerSquareMetre luminance,
                        const Point3& point,
                        const UnitVector3& normal) noexcept {
    return Lux(in_candela_per_square_metre(luminance)
               * projected_solid_angle(polygon, point, normal));
}

} // namespace isolux
