#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isolux/base/angle.h"
#include "isolux/photometry/file_number.h"
#include "isolux/photometry/findings.h"
#include "isolux/photometry/plane_symmetry.h"

/// Steps that both readers take between a stored table and our grid.
namespace isolux {

/// Stored values times `factor`. Negative ones (noise) become 0 with one warning.
/// @throws InputError  a product that no double holds
[[nodiscard]] std::vector<double>
scale_values(std::span<const FileNumber> stored, double factor, Findings& findings);

/// Degrees to angles, snapped to the poles so that all stay within [0, pi].
[[nodiscard]] std::vector<Angle> to_gammas(const std::vector<double>& in_degrees);

/// The stored planes an expanded circle asks for, one after another.
/// @param values  stored planes, `gammas` values each
[[nodiscard]] std::vector<double> take_planes(std::span<const double> values,
                                              std::size_t gammas,
                                              std::span<const ExpandedPlane> planes);

} // namespace isolux
