#pragma once

namespace isolux {

/// A plane-parallel pane of clear glass in air, all internal reflections added without
/// interference.
struct ClearSlab {
    double refractive_index = 1.5;
    double internal_transmittance = 1.0; ///< of the glass at normal incidence, 0..1
};

struct SlabShares {
    double transmittance = 0.0;
    double reflectance = 0.0;
};

/// Mean of the two polarisations. With r Fresnel's reflectance of one face and
/// a = ti^(1/cos theta_t): T = (1-r)^2 a/(1-r^2 a^2), R = r + r (1-r)^2 a^2/(1-r^2 a^2).
/// @param cos_theta  of the angle of incidence in air, 0..1
[[nodiscard]] SlabShares exact_slab(const ClearSlab& slab, double cos_theta) noexcept;

/// Transmittance for light of one luminance from the whole half space: the mean of T weighted
/// by 2 cos theta. Relative error below 1e-10.
[[nodiscard]] double exact_diffuse_transmittance(const ClearSlab& slab);

} // namespace isolux
