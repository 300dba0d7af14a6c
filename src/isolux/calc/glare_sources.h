#pragma once

#include <vector>

#include "isolux/measure/glare.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// One luminaire as an eye sees it.
struct SeenLuminaire {
    std::size_t luminaire = 0;
    std::vector<GlareSourcePart> parts; ///< luminous, with something of it visible
    double illuminance = 0.0; ///< direct, at the eye, at right angles to the way to it, lx
    UnitVector3 towards;      ///< its photometric centre
    bool is_point = false;    ///< no opening: it has an intensity but no luminance
};

/// All luminaires that shine at an eye, METHODS eq. (110): what hides them is looked for by
/// shadow rays to each part; panes dim them. An opening larger than a third of its distance is
/// divided until its parts are not.
[[nodiscard]] std::vector<SeenLuminaire> see_luminaires(const Scene& scene, const Point3& eye);

} // namespace isolux
