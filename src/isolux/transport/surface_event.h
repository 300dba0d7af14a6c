#pragma once

#include "isolux/base/colour.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// Light reflected by an ideal mirror: the angle of incidence kept, the normal reversed.
[[nodiscard]] inline UnitVector3 reflect(const UnitVector3& w, const UnitVector3& n) noexcept {
    return UnitVector3(Vector3(w) - (2.0 * dot(w, n)) * Vector3(n));
}

/// What a surface does to light that meets it at a given angle: shares of the incident light.
struct SurfaceEvent {
    Rgb diffuse;           ///< leaves by Lambert's law, to the side it came from
    double mirror = 0.0;   ///< leaves like from an ideal mirror (panes included)
    double straight = 0.0; ///< passes a pane
    bool is_pane = false;
};

/// @param cos_theta  of the angle of incidence, >= 0
[[nodiscard]] inline SurfaceEvent
evaluate_surface(const Material& material, bool is_front, double cos_theta) noexcept {
    if (!is_front && material.sides == Sides::front)
        return {};
    if (const auto* opaque = std::get_if<Opaque>(&material.scattering))
        return {opaque->diffuse, opaque->mirror, 0.0, false};
    const SlabOptics slab = evaluate_slab(std::get<ClearPane>(material.scattering), cos_theta);
    return {{}, slab.reflectance, slab.transmittance, true};
}

} // namespace isolux
