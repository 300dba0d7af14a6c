#include "isolux/validate/glare.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

namespace isolux {

GlareSource see_glare_source(const Point3& eye,
                             const UnitVector3& sight,
                             const UnitVector3& up,
                             const Point3& centre,
                             const UnitVector3& facing,
                             SquareMetre area,
                             CandelaPerSquareMetre luminance) noexcept {
    const Vector3 d = centre - eye;
    const double ahead = dot(sight, d);
    const double upwards = dot(up, d);
    const double sideways = dot(cross(sight, up), d);
    const double r = length(d);
    const double cos_gamma = std::max(0.0, -dot(facing, d) / r);
    return {r,
            radians(std::atan2(std::hypot(upwards, sideways), ahead)),
            radians(std::atan2(std::abs(sideways), upwards)),
            Steradian(area.value() * cos_gamma / (r * r)),
            luminance};
}

double guth_index(Angle from_sight, Angle from_vertical) noexcept {
    const double sigma = from_sight.in_degrees();
    const double tau = from_vertical.in_degrees();
    return std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 * tau / 9.0)) * 1e-3 * sigma
                    + (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
}

double exact_ugr(std::span<const GlareSource> sources,
                 CandelaPerSquareMetre background) noexcept {
    ISOLUX_EXPECT(in_candela_per_square_metre(background) > 0.0);
    double sum = 0.0;
    for (const GlareSource& s : sources) {
        if (s.from_sight.in_radians() >= 0.5 * std::numbers::pi)
            continue;
        const double seen = in_candela_per_square_metre(s.luminance)
                            / guth_index(s.from_sight, s.from_vertical);
        sum += seen * seen * s.solid_angle.value();
    }
    return 8.0 * std::log10(0.25 / in_candela_per_square_metre(background) * sum);
}

} // namespace isolux
