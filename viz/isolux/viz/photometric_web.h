#pragma once

#include "isolux/scene/luminaire.h"
#include "isolux/viz/drawing_parts.h"
#include "isolux/viz/space_view.h"

namespace isolux {

/// The photometric solid in space: the distance from the centre is the intensity towards there.
/// In it the luminaire's body (not to the same scale) with its long axis and an arrow towards
/// C0, as they lie before the luminaire is turned in a room; the horizontal plane with C0, C90,
/// C180 and C270.
void draw_web(Drawing& page,
              const Box& box,
              const LuminaireType& type,
              const ViewAngles& angles = {});

} // namespace isolux
