#pragma once

#include <string>

#include "isolux/photometry/ies.h"

namespace isolux {

struct IesTable {
    IntensityDistribution distribution;
    std::string symmetry; ///< in words
};

/// The candela table of a LM-63 file on our grid. Type C keeps its angles. Type A (planes of
/// constant H about the vertical axis, H clockwise) is type C with C = -H, gamma = V + 90. Type
/// B (planes of constant V about the horizontal y axis) is the transposed table on lateral
/// poles, C = V, gamma = H + 90. What the file does not cover is dark.
/// @param factor  multiplies every value
/// @throws InputError  angles that fit no symmetry, overflow
[[nodiscard]] IesTable
make_table(const IesDocument& document, double factor, Findings& findings);

} // namespace isolux
