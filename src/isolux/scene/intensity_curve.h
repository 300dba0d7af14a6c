#pragma once

#include <array>
#include <vector>

#include "isolux/base/angle.h"
#include "isolux/scene/luminaire.h"

namespace isolux {

/// Intensity over gamma in one half-plane, as diagrams show it.
struct IntensityCurve {
    std::vector<double> gamma;   ///< degrees from nadir, ascending, 0 to 180
    std::vector<double> candela; ///< as many
};

/// The curve of a type in half-plane C: a value each degree and at every gamma of the table, so
/// that no tabulated peak is missed. A flux override counts, dimming and maintenance do not.
[[nodiscard]] IntensityCurve sample_curve(const LuminaireType& type, Angle plane);

/// The four half-planes of a polar diagram, in this order: C0, C90, C180, C270.
using PolarCurves = std::array<IntensityCurve, 4>;

[[nodiscard]] PolarCurves sample_polar_curves(const LuminaireType& type);

/// Flux that "per kilolumen" refers to, lm: that of the lamps, as both file formats have it;
/// the luminaire's own in absolute photometry and without a file.
[[nodiscard]] double reference_flux(const LuminaireType& type);

} // namespace isolux
