#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "isolux/base/angle.h"

namespace isolux {

/// What one stored half of a table says about the other one.
enum class PlaneSymmetry {
    none,             ///< planes all round
    rotational,       ///< one plane holds everywhere
    quadrant,         ///< I(C) = I(180 - C) = I(180 + C) = I(360 - C)
    bilateral_0_180,  ///< I(360 - C) = I(C)
    bilateral_90_270, ///< I(180 - C) = I(C)
};

/// "none", "rotational", "quadrant", "bilateral 0-180", "bilateral 90-270".
[[nodiscard]] std::string to_string(PlaneSymmetry symmetry);

/// A plane of the full circle and the stored plane that holds its values.
struct ExpandedPlane {
    double degrees = 0.0;
    std::size_t stored = 0;
};

/// Two angles of a file that differ by less than this are the same angle, in degrees.
inline constexpr double same_file_angle = 1e-3;

[[nodiscard]] bool is_same_angle(double a, double b) noexcept;

/// The full, closed circle of planes, ascending: from the first in [0, 360) to the same plane
/// 360 degrees on. Where two stored planes claim one direction the earlier one wins.
/// @param stored  degrees of the stored planes, any turn; at least 1
[[nodiscard]] std::vector<ExpandedPlane> expand_planes(std::span<const double> stored,
                                                       PlaneSymmetry symmetry);

[[nodiscard]] std::vector<Angle> to_angles(std::span<const ExpandedPlane> planes);

} // namespace isolux
