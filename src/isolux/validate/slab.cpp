#include "isolux/validate/slab.h"

#include <cmath>

#include <boost/math/quadrature/gauss.hpp>

#include "isolux/base/check.h"

namespace isolux {

namespace {

SlabShares add_internal_reflections(double r, double a) noexcept {
    const double passed = (1.0 - r) * (1.0 - r) * a / (1.0 - r * r * a * a);
    return {passed, r + r * a * passed};
}

} // namespace

SlabShares exact_slab(const ClearSlab& slab, double cos_theta) noexcept {
    ISOLUX_EXPECT(cos_theta >= 0.0 && cos_theta <= 1.0 && slab.refractive_index >= 1.0);
    if (cos_theta == 0.0)
        return {0.0, 1.0};
    const double n = slab.refractive_index;
    const double cos_t = std::sqrt(1.0 - (1.0 - cos_theta * cos_theta) / (n * n));
    const double s = (cos_theta - n * cos_t) / (cos_theta + n * cos_t);
    const double p = (n * cos_theta - cos_t) / (n * cos_theta + cos_t);
    const double a = std::pow(slab.internal_transmittance, 1.0 / cos_t);
    const SlabShares across = add_internal_reflections(s * s, a);
    const SlabShares along = add_internal_reflections(p * p, a);
    return {0.5 * (across.transmittance + along.transmittance),
            0.5 * (across.reflectance + along.reflectance)};
}

double exact_diffuse_transmittance(const ClearSlab& slab) {
    return boost::math::quadrature::gauss<double, 60>::integrate(
        [&](double c) { return 2.0 * c * exact_slab(slab, c).transmittance; }, 0.0, 1.0);
}

} // namespace isolux
