#pragma once

#include <array>
#include <optional>
#include <vector>

#include "isolux/photometry/luminaire_photometry.h"

/// A UGR table after CIE 117:1995 and CIE 190:2010: one luminaire in 19 standard rooms.
///
/// Luminaires hang at H = 2 m above the eye in a square grid over the whole room, the outer
/// rows half a spacing from the walls. The observer sits in the middle of one wall and looks
/// straight ahead. Ceiling = plane of the luminaires, floor = plane of the eye. METHODS, "UGR
/// table".
namespace isolux {

/// In multiples of H.
struct UgrRoom {
    int across = 0; ///< X, at right angles to the line of sight
    int along = 0;  ///< Y, along it
};

struct UgrReflectances {
    double ceiling = 0.0;
    double walls = 0.0;
    double plane = 0.0;
};

inline constexpr std::array<UgrRoom, 19> ugr_rooms{{{2, 2},
                                                    {2, 3},
                                                    {2, 4},
                                                    {2, 6},
                                                    {2, 8},
                                                    {2, 12},
                                                    {4, 2},
                                                    {4, 3},
                                                    {4, 4},
                                                    {4, 6},
                                                    {4, 8},
                                                    {4, 12},
                                                    {8, 4},
                                                    {8, 6},
                                                    {8, 8},
                                                    {8, 12},
                                                    {12, 4},
                                                    {12, 6},
                                                    {12, 8}}};

inline constexpr std::array<UgrReflectances, 5> ugr_reflectances{
    {{0.7, 0.5, 0.2}, {0.7, 0.3, 0.2}, {0.5, 0.5, 0.2}, {0.5, 0.3, 0.2}, {0.3, 0.3, 0.2}}};

/// `[room][reflectances]`, in the orders above, for the flux of the table itself. -infinity
/// where no light reaches the eye.
using UgrValues = std::array<std::array<double, ugr_reflectances.size()>, ugr_rooms.size()>;

struct UgrTable {
    double spacing_to_height = 0.25;
    UgrValues crosswise; ///< line of sight at right angles to the luminaire's length
    UgrValues endwise;   ///< line of sight along the length
};

/// The length is the longer side of the opening, y where both are equal. Looking crosswise, the
/// observer faces the luminaire's +x (or its +y where x is the length).
/// @param spacing_to_height  1 or 0.25
/// @return nothing where the luminaire has no luminous area (its luminance is unknown)
[[nodiscard]] std::optional<UgrTable> make_ugr_table(const LuminairePhotometry& luminaire,
                                                     double spacing_to_height = 0.25);

/// Mean indirect illuminance on the walls of a box whose floor and ceiling are `x` by `y` and
/// `height` apart, from the flux that first meets ceiling, walls and floor.
[[nodiscard]] Lux indirect_wall_illuminance(double x,
                                            double y,
                                            double height,
                                            const std::array<Lumen, 3>& direct_flux,
                                            const UgrReflectances& reflectances);

} // namespace isolux
