#pragma once

#include <vector>

#include "isolux/viz/map_page.h"
#include "isolux/viz/map_scale.h"
#include "isolux/viz/surface_view.h"

namespace isolux {

/// One isolux value's lines on the page, mm.
struct IsoluxLine {
    double level = 0.0;
    std::vector<Polyline> lines;
};

/// What the bands leave for the labels.
struct PaintedBands {
    std::vector<Polyline> border; ///< of the surface on the page: its outline, else its cells
    std::vector<IsoluxLine> lines;
};

/// Paints a grid's false colours, each band over the darker ones, isolux lines and border.
/// @pre result.surface.grid
PaintedBands paint_bands(MapPage& page,
                         const SurfaceResult& result,
                         const SurfaceView& view,
                         const MapScale& scale);

} // namespace isolux
