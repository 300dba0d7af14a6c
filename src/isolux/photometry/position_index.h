#pragma once

#include <optional>

#include "isolux/base/angle.h"

/// Guth's position index: how much less a source disturbs away from the line of sight. METHODS,
/// "UGR table".
namespace isolux {

/// By the formula (49), wherever the source is in front of the eye.
/// @param from_sight_line  angle between line of sight and source
/// @param from_vertical    angle of the plane holding both from the vertical
[[nodiscard]] double guth_position_index(Angle from_sight_line, Angle from_vertical) noexcept;

/// By linear interpolation in table 4.1 of CIE 117:1995, which the tables of makers are made
/// with. Both arguments are at least 0 and in units of the distance along the line of sight.
/// @param height    of the source above the eye
/// @param sideways  of the source from the plane of the line of sight and the vertical
/// @return nothing where the printed table is blank or ends: such a source does not count
[[nodiscard]] std::optional<double> tabulated_position_index(double height,
                                                             double sideways) noexcept;

} // namespace isolux
