#pragma once

#include <span>

#include "isolux/base/angle.h"
#include "isolux/base/units.h"

/// Closed answers inside spheres that reflect by Lambert's law. Every point of a sphere sees
/// every other with the same weight, so the reflected light is the same everywhere.
namespace isolux {

/// Reflected illuminance everywhere in a sphere of one reflectance:
/// rho flux/(4 pi R2 (1 - rho)), for any luminaire at any place. @pre 0 <= reflectance < 1
[[nodiscard]] Lux sphere_indirect(Metre radius, double reflectance, Lumen flux) noexcept;

/// Illuminance straight from an isotropic source `offset` from the centre, at the wall point
/// whose direction from the centre makes `angle` with the direction of the source.
/// @pre 0 <= offset < radius
[[nodiscard]] Lux sphere_direct(Metre radius, Lumen flux, Metre offset, Angle angle) noexcept;

/// A part of the sphere's wall: its share of the light that comes straight from the source.
struct SphereZone {
    double reflectance = 0.0;
    SquareMetre area;
    Lumen direct_flux;
};

/// Reflected illuminance everywhere in a sphere whose zones reflect differently:
/// sum(rho_i flux_i)/(A (1 - sum(rho_i A_i)/A)). @pre the zones cover the whole sphere
[[nodiscard]] Lux sphere_indirect(std::span<const SphereZone> zones) noexcept;

/// Area of the cap of a sphere below the level `border`, both counted from the centre along one
/// axis: 2 pi R (R + border).
[[nodiscard]] SquareMetre sphere_cap_area(Metre radius, Metre border) noexcept;

/// Flux of an isotropic source at level `source` on the axis that falls on that cap.
[[nodiscard]] Lumen
sphere_cap_flux(Metre radius, Metre border, Lumen flux, Metre source) noexcept;

/// A sphere of radius r1 that emits the exitance M and reflects rho1, inside one of radius r2
/// that reflects rho2.
struct ConcentricSpheres {
    double radius_ratio = 0.5;   ///< r1/r2, 0..1
    double inner_exitance = 1.0; ///< M, lm/m2, not counting what it reflects
    double inner_reflectance = 0.0;
    double outer_reflectance = 0.0;
};

struct ConcentricIlluminance {
    Lux inner;
    Lux outer;
};

/// With k = (r1/r2)^2: E2 = k M/(1 - rho2 (1 - k (1 - rho1))), E1 = rho2 E2.
[[nodiscard]] ConcentricIlluminance
concentric_illuminance(const ConcentricSpheres& spheres) noexcept;

} // namespace isolux
