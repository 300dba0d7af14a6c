#pragma once

#include "isolux/transport/emission.h"

namespace isolux {

/// Light that a luminaire sends straight to a place on a surface, so far as if nothing stood in
/// the way.
struct NextEvent {
    Rgb illuminance;           ///< lx at the place, divided by the density of the sample
    double path_density = 0.0; ///< METHODS eq. (11), k = 2: of a light path doing the same, per
                               ///< this sample's density, 1/m2
    SightSegment sight;        ///< from the luminaire to the place
    std::uint32_t luminaire = 0;
};

/// Next-event estimation with one sample of the luminaires; whoever takes it looks along
/// `sight` and dims both values. Nothing (no illuminance) where no light can come.
/// @param at      the place, moved off its surface
/// @param normal  of the lit side
[[nodiscard]] inline NextEvent sample_next_event(const Emission& emission,
                                                 const Point3& at,
                                                 const UnitVector3& normal,
                                                 double u_luminaire,
                                                 double u,
                                                 double v) noexcept {
    const TowardsSample sample = emission.sample_towards(at, u_luminaire, u, v);
    if (!(sample.density > 0.0))
        return {};
    const Vector3 d = at - sample.from.position;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return {};
    const UnitVector3 w(d);
    const double cosine = -dot(normal, w);
    if (cosine <= 0.0)
        return {};
    const double strength = emission.evaluate(sample.from, w);
    if (!(strength > 0.0))
        return {};
    const double density = strength * cosine / (d2 * sample.density);
    return {density * emission.colour(sample.from.luminaire),
            density / emission.total_flux(),
            {emission.departure(sample.from, w), at},
            static_cast<std::uint32_t>(sample.from.luminaire)};
}

/// The same, looked at at once.
[[nodiscard]] inline NextEvent estimate_next_event(const Scene& scene,
                                                   const Emission& emission,
                                                   const Point3& at,
                                                   const UnitVector3& normal,
                                                   double u_luminaire,
                                                   double u,
                                                   double v) noexcept {
    NextEvent event = sample_next_event(emission, at, normal, u_luminaire, u, v);
    if (max_channel(event.illuminance) <= 0.0)
        return {};
    const double passed = scene.caster.transmittance(event.sight.a, event.sight.b);
    event.illuminance = passed * event.illuminance;
    event.path_density *= passed;
    return event;
}

} // namespace isolux
