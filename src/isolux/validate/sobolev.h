#pragma once

#include "isolux/base/units.h"

/// Sobolev's problem: an isotropic point source between two infinite parallel planes that
/// reflect by Lambert's law. The hardest room with a closed answer: light without walls, every
/// order of reflection, a value at every distance.
namespace isolux {

struct SobolevProblem {
    double reflectance_1 = 0.0; ///< of plane 1, 0..1; the product of both must be below 1
    double reflectance_2 = 0.0; ///< of plane 2
    Metre separation{1.0};      ///< of the planes, H > 0
    Metre source_height{0.5};   ///< of the source above plane 1, 0 < h1 < H
    Lumen flux{1.0};            ///< of the source; 4 pi lm is one candela
};

enum class SobolevPlane {
    one, ///< `source_height` from the source
    two  ///< separation - source_height from it
};

/// Illuminance that comes straight from the source, at `r` from the foot of the source.
/// @pre the ranges given with SobolevProblem, r >= 0
[[nodiscard]] Lux
sobolev_direct(const SobolevProblem& problem, SobolevPlane plane, Metre r) noexcept;

/// Illuminance by reflected light, the integral of METHODS eq. (30) for any separation and
/// flux. Relative error below 1e-8 for r <= 300 H, 1e-12 for r <= 10 H; the work grows in
/// proportion to r/H (50 ms at 300 H).
[[nodiscard]] Lux sobolev_indirect(const SobolevProblem& problem, SobolevPlane plane, Metre r);

/// The whole illuminance, METHODS eq. (30).
[[nodiscard]] Lux
sobolev_illuminance(const SobolevProblem& problem, SobolevPlane plane, Metre r);

/// Mean of the reflected illuminance over the ring inner <= r <= outer around the foot of the
/// source (a disc if `inner` is 0): (2 / (outer^2 - inner^2)) times the integral of E(r) r dr.
/// Relative error below 1e-7 for rings narrower than two separations.
/// @pre 0 <= inner < outer
[[nodiscard]] Lux sobolev_indirect_ring(const SobolevProblem& problem,
                                        SobolevPlane plane,
                                        Metre inner,
                                        Metre outer);

/// The same for the light that comes straight from the source; in closed form.
[[nodiscard]] Lux sobolev_direct_ring(const SobolevProblem& problem,
                                      SobolevPlane plane,
                                      Metre inner,
                                      Metre outer) noexcept;

/// Flux that arrives on the whole of a plane, all reflections counted:
/// (flux/2) (1 + rho_other)/(1 - rho1 rho2).
[[nodiscard]] Lumen sobolev_flux(const SobolevProblem& problem, SobolevPlane plane) noexcept;

} // namespace isolux
