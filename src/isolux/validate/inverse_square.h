#pragma once

#include <optional>

#include "isolux/base/receiver.h"
#include "isolux/base/units.h"
#include "isolux/base/vec.h"

/// A point source in empty space: inverse-square and cosine law.
namespace isolux {

/// Isotropic, or with the intensity I0 cos^n of the angle from its axis (0 behind).
struct IdealPointSource {
    Point3 position;
    Lumen flux;
    UnitVector3 axis = UnitVector3::from_unit({0, 0, -1});
    std::optional<double> exponent; ///< n >= 0; absent: isotropic
};

/// flux/(4 pi), or I0 cos^n with I0 = flux (n + 1)/(2 pi).
[[nodiscard]] Candela point_source_intensity(const IdealPointSource& source,
                                             const UnitVector3& direction) noexcept;

/// The direct illuminance of any kind (CIE S 017). With g the angle between the receiver's axis
/// and the source, a the azimuth between the source and the receiver's reference direction, d
/// the distance: planar I cos g/d2 (0 behind), cylindrical I sin g/(pi d2), semi-cylindrical
/// I sin g (1 + cos a)/(pi d2), hemispherical I (1 + cos g)/(4 d2), mean spherical I/(4 d2).
/// @pre the receiver is not at the source
[[nodiscard]] Lux point_source_illuminance(const IdealPointSource& source,
                                           const Receiver& receiver) noexcept;

} // namespace isolux
