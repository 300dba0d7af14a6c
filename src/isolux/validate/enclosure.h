#pragma once

#include "isolux/base/units.h"

/// Closed rooms of one reflectance, whatever their shape and furniture.
namespace isolux {

/// Furnace: every surface emits the exitance `exitance` (lm/m2) and reflects `reflectance`;
/// then every point and every orientation receives M/(1 - rho).
/// @pre 0 <= reflectance < 1
[[nodiscard]] constexpr Lux furnace_illuminance(double exitance, double reflectance) noexcept {
    return Lux(exitance / (1.0 - reflectance));
}

/// Mean illuminance over all surfaces: flux/(A (1 - rho)), exactly. `area` is all that
/// reflects, both sides of sheets. @pre 0 <= reflectance < 1
[[nodiscard]] constexpr Lux
closed_room_mean(Lumen flux, SquareMetre area, double reflectance) noexcept {
    return (flux / area) / (1.0 - reflectance);
}

/// Mean of the reflected light alone: rho flux/(A (1 - rho)).
[[nodiscard]] constexpr Lux
closed_room_mean_indirect(Lumen flux, SquareMetre area, double reflectance) noexcept {
    return reflectance * closed_room_mean(flux, area, reflectance);
}

} // namespace isolux
