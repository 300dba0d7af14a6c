#pragma once

#include <cstddef>
#include <vector>

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

/// The photometric solid as a lattice in the luminaire's own frame, its largest radius 1.
struct WebMesh {
    std::size_t sectors = 0;     ///< C planes, evenly spread from C0
    std::size_t rings = 0;       ///< gammas from nadir to zenith, denser where the solid bends
    std::vector<Point3> points;  ///< ring after ring
    std::vector<double> candela; ///< of every point
};

[[nodiscard]] WebMesh make_web_mesh(const LuminaireType& type);

} // namespace isolux
