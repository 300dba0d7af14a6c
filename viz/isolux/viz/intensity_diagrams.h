#pragma once

#include "isolux/scene/intensity_curve.h"
#include "isolux/viz/drawing_parts.h"

namespace isolux {

/// Polar diagram: gamma 0 down, C0 and C90 at the right, C180 and C270 at the left; the plane
/// C0-C180 solid, C90-C270 dashed. Where one half of space is dark only the other is drawn.
void draw_polar(Drawing& page,
                const Box& box,
                const PolarCurves& curves,
                const IntensityScale& scale);

/// The same curves over gamma; C180 and C270 count from the axis to the left.
void draw_cartesian(Drawing& page,
                    const Box& box,
                    const PolarCurves& curves,
                    const IntensityScale& scale);

/// Polar diagram on a page of its own, `size` mm high and wide, without words around it.
[[nodiscard]] Drawing
make_polar_picture(const PolarCurves& curves, const std::string& title, double size);

} // namespace isolux
