#pragma once

#include "isolux/scene/mesh.h"

namespace isolux {

/// Simple bodies in their own frame, standing on z = 0 with the middle of their base at the
/// origin, fronts outwards. All lengths in metres and above zero.

/// `size` along x, y and z.
[[nodiscard]] SurfaceMesh make_box(const Vector3& size);

/// An upright round cylinder as a prism of `segments` (at least 3) sides whose base has the
/// circle's area.
[[nodiscard]] SurfaceMesh make_cylinder(double diameter, double height, int segments = 32);

/// An upright sheet without thickness, width along x, height along z, its front towards -y.
[[nodiscard]] SurfaceMesh make_panel(double width, double height);

} // namespace isolux
