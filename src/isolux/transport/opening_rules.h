#pragma once

#include <functional>
#include <optional>
#include <span>

#include "isolux/base/vec.h"

namespace isolux {

/// What a place of a polygon adds, per area.
using PlaceDensity = std::function<double(const Point3&)>;

struct RuleValue {
    double value = 0.0;
    double doubt = 0.0; ///< what the last rule changed

    RuleValue& operator+=(const RuleValue& other) noexcept {
        value += other.value;
        doubt += other.doubt;
        return *this;
    }
};

/// Integral of `density` over a planar convex polygon, by Gauss-Legendre rules of growing order
/// that agree; where they do not, over its halves: METHODS "Openings with a photometric table".
/// Nothing where halving has no end in sight.
/// @param eye         from where the polygon is seen: rules have as many points as it looks
/// large
/// @param negligible  two rules agree if they differ by less than this, or by 2e-5; infinite: a
///                    rough value will do
[[nodiscard]] std::optional<RuleValue> integrate_polygon(std::span<const Point3> polygon,
                                                         const Point3& eye,
                                                         double negligible,
                                                         const PlaceDensity& density);

} // namespace isolux
