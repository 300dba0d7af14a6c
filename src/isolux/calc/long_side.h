#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/scene/luminaire_body.h"

namespace isolux {

/// Which way the long side of a luminaire type lies in the room, for people: "long side 1.2 m
/// along world y", "long side 1.2 m along world x (12), world y (4)", "no long side". LM-63 and
/// EULUMDAT lay the same luminaire down differently (METHODS "Luminaires"), so it is shown.
[[nodiscard]] std::string describe_long_side(const LuminaireType& type,
                                             std::span<const Frame> world_from_luminaire);
[[nodiscard]] std::string describe_long_side(const std::optional<LongSide>& long_side,
                                             std::span<const Frame> world_from_luminaire);

/// One line a type that is hung: number, flux, size and long side.
[[nodiscard]] std::vector<std::string>
describe_luminaires(std::span<const LuminaireType> types,
                    std::span<const LuminairePlacement> placements);

} // namespace isolux
