#include "isolux/scene/luminaire.h"

#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

namespace isolux {
namespace {

template <class... F> struct Overloaded : F... { using F::operator()...; };

/// Towards where a luminaire without a table shines: down, or +x for an upright opening.
UnitVector3 front_of(const LuminousOpening& opening) noexcept {
    return opening.shape == OpeningShape::vertical_ellipse ? UnitVector3::from_unit({1, 0, 0})
                                                           : UnitVector3::from_unit({0, 0, -1});
}

} // namespace

Lumen luminous_flux(const LuminaireType& type) noexcept {
    return type.flux_scale
           * std::visit(
               Overloaded{[](const LuminairePhotometry& p) { return p.distribution.flux(); },
                          [](const auto& source) { return source.flux; }},
               type.source);
}

Candela luminous_intensity(const LuminaireType& type, const UnitVector3& local) noexcept {
    const auto evaluate =
        Overloaded{[&](const LuminairePhotometry& p) { return p.distribution.evaluate(local); },
                   [&](const LambertianSource& s) {
                       const double cosine = std::max(0.0, dot(front_of(type.opening), local));
                       return Candela(in_lumen(s.flux) / std::numbers::pi * cosine);
                   },
                   [](const IsotropicSource& s) {
                       return Candela(in_lumen(s.flux) / (4.0 * std::numbers::pi));
                   }};
    return type.flux_scale * std::visit(evaluate, type.source);
}

Opening to_world(const Opening& local, const Frame& world_from_luminaire) {
    Opening world = local;
    for (Facet& facet : world.facets) {
        for (Point3& p : facet.vertices)
            p = world_from_luminaire.point_from_local(p - Point3{});
        facet.normal = UnitVector3(world_from_luminaire.vector_from_local(facet.normal));
    }
    return world;
}

Frame make_aimed_frame(const Point3& position, const Point3& aim, Angle spin) {
    ISOLUX_EXPECT(!(position == aim));
    const UnitVector3 up(position - aim);
    // C0 is what is left of +x beside the nadir. Looking along x nothing is left: there C0 goes
    // where tipping the nadir about y takes it.
    const Vector3 rest = Vector3{1, 0, 0} - up.x() * Vector3(up);
    const UnitVector3 x = length(rest) > 1e-9
                              ? UnitVector3(rest)
                              : UnitVector3::from_unit({0, 0, up.x() > 0.0 ? -1.0 : 1.0});
    return rotate(Frame{position, x, UnitVector3(cross(up, x)), up}, up, spin);
}

Frame make_tilted_frame(const Point3& position, Angle rotation, Angle tilt, Angle azimuth) {
    const auto y = UnitVector3::from_unit({0, 1, 0});
    const auto z = UnitVector3::from_unit({0, 0, 1});
    const Frame turned = rotate(Frame{position}, z, rotation);
    return rotate(rotate(turned, y, -1.0 * tilt), z, azimuth);
}

} // namespace isolux
