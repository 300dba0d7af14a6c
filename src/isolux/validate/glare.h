#pragma once

#include <span>

#include "isolux/base/angle.h"
#include "isolux/base/units.h"
#include "isolux/base/vec.h"

/// The unified glare rating of CIE 117 as a formula on given numbers.
namespace isolux {

/// A small flat source as an observer sees it.
struct GlareSource {
    double distance = 0.0; ///< m, from the eye to the centre
    Angle from_sight;      ///< sigma, between line of sight and source
    Angle from_vertical;   ///< tau, of the plane that holds both, 0 upwards
    Steradian solid_angle; ///< A cos(gamma)/r2
    CandelaPerSquareMetre luminance;
};

/// What an eye at `eye` looking along `sight` makes of a flat source at `centre` that faces
/// along `facing`. `up` is the observer's upward direction.
/// @pre sight is perpendicular to up
[[nodiscard]] GlareSource see_glare_source(const Point3& eye,
                                           const UnitVector3& sight,
                                           const UnitVector3& up,
                                           const Point3& centre,
                                           const UnitVector3& facing,
                                           SquareMetre area,
                                           CandelaPerSquareMetre luminance) noexcept;

/// Guth's position index, with angles in degrees:
/// exp[(35.2 - 0.31889 tau - 1.22 e^(-2 tau/9)) 1e-3 sigma
///     + (21 + 0.26667 tau - 0.002963 tau^2) 1e-5 sigma^2].
[[nodiscard]] double guth_index(Angle from_sight, Angle from_vertical) noexcept;

/// 8 log10[(0.25/Lb) sum L^2 w/p^2] over all sources in front of the eye. @pre background > 0
[[nodiscard]] double exact_ugr(std::span<const GlareSource> sources,
                               CandelaPerSquareMetre background) noexcept;

} // namespace isolux
