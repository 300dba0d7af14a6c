#pragma once

#include <optional>

#include "isolux/scene/luminaire.h"

namespace isolux {

/// What is seen of a luminaire: its housing; the opening where the file tells of no housing,
/// where there is no file, or where the project replaces the file's opening.
[[nodiscard]] LuminousOpening visible_body(const LuminaireType& type);

/// Which way a luminaire is long, in its own frame before it is turned in a room.
struct LongSide {
    bool is_along_y = false; ///< along C90-C270; else along C0-C180
    double length = 0.0;     ///< m
};

/// The longer horizontal side of the luminous opening; of the body, where the opening has none
/// (its sides differ by less than a twentieth). Nothing where neither has.
/// LM-63 lays the length along C0-C180, EULUMDAT along C90-C270 (METHODS "Luminaires").
[[nodiscard]] std::optional<LongSide> find_long_side(const LuminaireType& type);

} // namespace isolux
