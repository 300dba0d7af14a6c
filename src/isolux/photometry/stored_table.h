#pragma once

#include <string>
#include <vector>

#include "isolux/photometry/intensity_distribution.h"
#include "isolux/photometry/plane_symmetry.h"

namespace isolux {

/// A table as a file stores it: degrees, only the planes that its symmetry does not imply.
struct StoredTable {
    PlaneSymmetry symmetry = PlaneSymmetry::none;
    std::vector<double> circle; ///< all C planes in [0, 360)
    std::vector<double> planes; ///< the stored ones, ascending
    std::vector<double> gammas;
    std::vector<double> candela; ///< gamma fastest
};

/// Finds the symmetry and takes what must be stored. Planes that the formats need (0, and where
/// a symmetry starts and ends) are interpolated if the table lacks them, which changes nothing.
/// @pre nadir poles, full circle
[[nodiscard]] StoredTable make_stored_table(const IntensityDistribution& distribution);

/// The same light on even planes and gammas of type C, for tables that are not on nadir poles
/// or do not go all round. Between the new nodes it differs from the original.
[[nodiscard]] IntensityDistribution resample(const IntensityDistribution& distribution,
                                             double plane_step_degrees,
                                             double gamma_step_degrees);

[[nodiscard]] bool is_full_circle(const IntensityDistribution& distribution) noexcept;

/// Degrees without the last bits that the way through radians left behind.
[[nodiscard]] double rounded_degrees(Angle angle) noexcept;

/// Digits after the point that print the largest value with `significant` digits.
[[nodiscard]] int decimals_for(double largest, int significant) noexcept;

/// Fixed notation, trailing zeros dropped.
[[nodiscard]] std::string to_fixed(double value, int decimals);

/// Fit for one line of a file: control characters become blanks.
[[nodiscard]] std::string one_line(std::string_view text);

} // namespace isolux
