#pragma once

#include <string>

#include "isolux/base/angle.h"
#include "isolux/base/units.h"
#include "isolux/photometry/luminaire_photometry.h"

/// Backlight, uplight and glare of outdoor luminaires, ANSI/IES TM-15-11 with addendum A.
namespace isolux {

/// Flux of the ten secondary solid angles. Front is the half towards the street.
struct BugZones {
    Lumen front_low;       ///< FL, 0 to 30 degrees
    Lumen front_mid;       ///< FM, 30 to 60
    Lumen front_high;      ///< FH, 60 to 80
    Lumen front_very_high; ///< FVH, 80 to 90
    Lumen back_low;        ///< BL
    Lumen back_mid;        ///< BM
    Lumen back_high;       ///< BH
    Lumen back_very_high;  ///< BVH
    Lumen up_low;          ///< UL, 90 to 100
    Lumen up_high;         ///< UH, 100 to 180
};

/// 0 (least) to 5.
struct BugRating {
    int backlight = 0;
    int uplight = 0;
    int glare = 0;

    friend bool operator==(const BugRating&, const BugRating&) = default;
};

/// Which of TM-15's two glare tables holds.
enum class LateralType {
    asymmetric, ///< types I to IV
    symmetric   ///< types V and V square: backlight is glare, too
};

/// Where the street is by the format's convention: C90 in EULUMDAT, C0 in LM-63.
[[nodiscard]] Angle street_side_by_convention(PhotometricFormat format) noexcept;

/// Rule T. @param street_side  azimuth of the middle of the front half
[[nodiscard]] BugZones bug_zones(const IntensityDistribution& distribution, Angle street_side);

[[nodiscard]] BugRating rate(const BugZones& zones, LateralType type) noexcept;

/// "B1 U0 G2"
[[nodiscard]] std::string to_string(const BugRating& rating);

} // namespace isolux
