#include "isolux/scene/intensity_curve.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

UnitVector3 towards(Angle plane, double gamma) noexcept {
    const double s = std::sin(gamma);
    return UnitVector3::from_unit(
        {s * std::cos(plane.in_radians()), s * std::sin(plane.in_radians()), -std::cos(gamma)});
}

} // namespace

IntensityCurve sample_curve(const LuminaireType& type, Angle plane) {
    IntensityCurve curve;
    for (int g = 0; g <= 180; ++g)
        curve.gamma.push_back(g);
    const auto* photometry = std::get_if<LuminairePhotometry>(&type.source);
    if (photometry != nullptr && photometry->distribution.pole() == TablePole::nadir)
        for (const Angle g : photometry->distribution.gammas())
            curve.gamma.push_back(g.in_degrees());
    std::sort(curve.gamma.begin(), curve.gamma.end());
    constexpr double same = 1e-9;
    curve.gamma.erase(std::unique(curve.gamma.begin(),
                                  curve.gamma.end(),
                                  [](double a, double b) { return b - a < same; }),
                      curve.gamma.end());
    for (const double g : curve.gamma)
        curve.candela.push_back(
            luminous_intensity(type, towards(plane, degrees(g).in_radians())).value());
    return curve;
}

PolarCurves sample_polar_curves(const LuminaireType& type) {
    return {sample_curve(type, degrees(0)),
            sample_curve(type, degrees(90)),
            sample_curve(type, degrees(180)),
            sample_curve(type, degrees(270))};
}

double reference_flux(const LuminaireType& type) {
    if (const auto* photometry = std::get_if<LuminairePhotometry>(&type.source))
        if (const auto lamps = rated_lamp_flux(*photometry))
            return in_lumen(*lamps) * type.flux_scale;
    return in_lumen(luminous_flux(type));
}

} // namespace isolux
