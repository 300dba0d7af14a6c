#pragma once

#include <array>
#include <optional>
#include <vector>

#include "isolux/base/angle.h"
#include "isolux/base/units.h"
#include "isolux/photometry/luminaire_photometry.h"

/// What a photometrist reads off a table. Formulas and sources: METHODS, "Luminaire
/// quantities". Azimuths are C of the luminaire's frame, angles from nadir gamma.
namespace isolux {

// ---- flux --------------------------------------------------------------------------------

/// Flux between two angles from nadir by the trapezoid rule ("T"), values at the limits
/// interpolated. @pre 0 <= lower <= upper <= pi
[[nodiscard]] Lumen
flux_between(const IntensityDistribution& distribution, Angle lower, Angle upper);

/// The same within `half_width` on either side of the azimuth `middle`.
[[nodiscard]] Lumen flux_in_sector(const IntensityDistribution& distribution,
                                   Angle lower,
                                   Angle upper,
                                   Angle middle,
                                   Angle half_width);

/// Share of the flux below the horizon, 0..1 (rule T); 0 for a luminaire without light.
[[nodiscard]] double downward_fraction(const IntensityDistribution& distribution);

/// Rated flux of the lamps; nothing in absolute photometry.
[[nodiscard]] std::optional<Lumen> rated_lamp_flux(const LuminairePhotometry& luminaire);

/// Table flux (rule T) over rated lamp flux; nothing in absolute photometry, where it is 1 by
/// definition. Downward: the part that leaves below the horizon.
[[nodiscard]] std::optional<double> light_output_ratio(const LuminairePhotometry& luminaire);
[[nodiscard]] std::optional<double>
downward_light_output_ratio(const LuminairePhotometry& luminaire);

/// lm/W, rule T; nothing where the file states no power.
[[nodiscard]] std::optional<double> luminous_efficacy(const LuminairePhotometry& luminaire);

/// Flux in the 18 zones of 10 degrees from nadir to zenith (rule T).
[[nodiscard]] std::array<Lumen, 18> zonal_flux(const IntensityDistribution& distribution);

/// CIE flux code N1..N5 in percent: flux within pi/2, pi and 3 pi/2 steradian (41.4, 60
/// and 75.5 degrees) over downward flux, downward over total flux, light output ratio (100 in
/// absolute photometry).
[[nodiscard]] std::array<double, 5> cie_flux_code(const LuminairePhotometry& luminaire);

// ---- intensity ---------------------------------------------------------------------------

/// Towards azimuth C and gamma of the luminaire's frame, whatever axes its table has.
[[nodiscard]] Candela
intensity_towards(const LuminairePhotometry& luminaire, Angle plane, Angle gamma);

struct MaximumIntensity {
    Candela value;
    Angle plane; ///< C, 0 <= C < 2 pi; the first of equals
    Angle gamma;
};

[[nodiscard]] MaximumIntensity find_maximum(const IntensityDistribution& distribution);

/// Extent of a beam within the plane C and its opposite. Angles from the axis of the half-space
/// that holds the maximum: positive towards C.
struct BeamExtent {
    Angle towards_plane;
    Angle towards_opposite; ///< positive away from the axis on the other side

    [[nodiscard]] Angle full() const noexcept { return towards_plane + towards_opposite; }
};

/// The outermost directions of the polar curve in plane C whose intensity is at least
/// `share` of the curve's maximum: 0.5 gives the beam angle (EN 12665), 0.1 the field angle.
/// A beam that crosses the horizon is followed beyond it, to the axis at most; a second
/// beam there is not.
/// Nothing if the plane is dark.
[[nodiscard]] std::optional<BeamExtent>
find_beam(const IntensityDistribution& distribution, Angle plane, double share);

// ---- luminance ---------------------------------------------------------------------------

/// Luminous area as seen from afar; 0 for a point. Sides count by their own luminous heights
/// where the file states them.
[[nodiscard]] SquareMetre projected_luminous_area(const LuminairePhotometry& luminaire,
                                                  const UnitVector3& direction);

/// Mean luminance towards a direction; nothing where no luminous area is seen.
[[nodiscard]] std::optional<CandelaPerSquareMetre>
mean_luminance(const LuminairePhotometry& luminaire, Angle plane, Angle gamma);

} // namespace isolux
