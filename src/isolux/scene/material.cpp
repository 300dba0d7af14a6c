#include "isolux/scene/material.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isolux {
namespace {

/// Transmittance and reflectance for one polarisation whose single surface reflects `r`; `a` is
/// what one passage through the glass leaves.
SlabOptics sum_reflections(double r, double a) noexcept {
    if (r >= 1.0)
        return {0.0, 1.0};
    const double once = (1.0 - r) * (1.0 - r) * a;
    const double rest = 1.0 - r * r * a * a;
    return {once / rest, r + r * once * a / rest};
}

} // namespace

SlabOptics evaluate_slab(const ClearPane& pane, double cos_theta) noexcept {
    const double n = pane.refractive_index;
    const double c = std::min(cos_theta, 1.0);
    const double sin2_inside = (1.0 - c * c) / (n * n);
    if (!(c > 0.0) || sin2_inside >= 1.0)
        return {0.0, 1.0}; // grazing, or total reflection at a medium thinner than air
    const double c_inside = std::sqrt(1.0 - sin2_inside);
    const double root_s = (c - n * c_inside) / (c + n * c_inside); // Fresnel amplitudes
    const double root_p = (n * c - c_inside) / (n * c + c_inside);
    const double a = std::pow(pane.internal_transmittance, 1.0 / c_inside);
    const SlabOptics s = sum_reflections(root_s * root_s, a);
    const SlabOptics p = sum_reflections(root_p * root_p, a);
    return {0.5 * (s.transmittance + p.transmittance), 0.5 * (s.reflectance + p.reflectance)};
}

} // namespace isolux
