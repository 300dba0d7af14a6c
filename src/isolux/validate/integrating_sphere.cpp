#include "isolux/validate/integrating_sphere.h"

#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

namespace isolux {

namespace {

using std::numbers::pi;

} // namespace

Lux sphere_indirect(Metre radius, double reflectance, Lumen flux) noexcept {
    ISOLUX_EXPECT(reflectance >= 0.0 && reflectance < 1.0);
    return reflectance / (1.0 - reflectance) * (flux / (4.0 * pi * (radius * radius)));
}

Lux sphere_direct(Metre radius, Lumen flux, Metre offset, Angle angle) noexcept {
    ISOLUX_EXPECT(offset.value() >= 0.0 && offset < radius);
    const double r = in_metre(radius);
    const double s = in_metre(offset);
    const double c = std::cos(angle.in_radians());
    const double d2 = r * r + s * s - 2.0 * r * s * c;
    return Lux(in_lumen(flux) / (4.0 * pi) * (r - s * c) / (d2 * std::sqrt(d2)));
}

Lux sphere_indirect(std::span<const SphereZone> zones) noexcept {
    double area = 0.0;
    double reflecting = 0.0;
    double reflected = 0.0;
    for (const SphereZone& z : zones) {
        area += z.area.value();
        reflecting += z.reflectance * z.area.value();
        reflected += z.reflectance * in_lumen(z.direct_flux);
    }
    return Lux(reflected / (area - reflecting));
}

SquareMetre sphere_cap_area(Metre radius, Metre border) noexcept {
    return 2.0 * pi * (radius * (radius + border));
}

Lumen sphere_cap_flux(Metre radius, Metre border, Lumen flux, Metre source) noexcept {
    const double down = in_metre(source) - in_metre(border);
    const double r2 = in_metre(radius) * in_metre(radius) - in_metre(border) * in_metre(border);
    return 0.5 * (1.0 - down / std::sqrt(down * down + r2)) * flux;
}

ConcentricIlluminance concentric_illuminance(const ConcentricSpheres& s) noexcept {
    const double k = s.radius_ratio * s.radius_ratio;
    const Lux outer(k * s.inner_exitance
                    / (1.0 - s.outer_reflectance * (1.0 - k * (1.0 - s.inner_reflectance))));
    return {s.outer_reflectance * outer, outer};
}

} // namespace isolux
