#pragma once

#include "isolux/photometry/luminaire_photometry.h"

/// What a photometrist reads off a table. Formulas and sources: METHODS, "Luminaire
/// quantities".
namespace isolux {

/// Share of the flux below the horizon, 0..1, by the trapezoid rule (a value at gamma 90 is
/// interpolated where the table has none); 0 for a luminaire without light.
[[nodiscard]] double downward_fraction(const IntensityDistribution& distribution) noexcept;

/// Flux between two angles from nadir, by the trapezoid rule with values at the limits
/// interpolated.
/// @pre 0 <= lower <= upper <= pi
[[nodiscard]] Lumen
flux_between(const IntensityDistribution& distribution, Angle lower, Angle upper) noexcept;

} // namespace isolux
