#pragma once

#include <optional>

#include "isolux/base/receiver.h"
#include "isolux/transport/emission.h"
#include "isolux/transport/opening_rules.h"

namespace isolux {

/// One point of an opening looked at from a receiver.
struct Look {
    EmissionPoint from;
    UnitVector3 w;         ///< from the opening to the receiver
    double response = 0.0; ///< R(w) / d2; 0 where the receiver looks away
    Point3 departure;      ///< where a shadow ray ends
};

/// A receiver and a luminaire: the integrand of METHODS eq. (3), its samples, and its value
/// without shadows.
class OpeningLight {
public:
    /// @param clear  where rays of the receiver start
    OpeningLight(const Scene& scene,
                 const Emission& emission,
                 const Receiver& receiver,
                 const Point3& clear,
                 std::size_t luminaire);

    [[nodiscard]] Look look(double u, double v) const noexcept;

    /// Unshadowed illuminance of the look over its density, lx.
    [[nodiscard]] double value(const Look& look) const noexcept;

    /// The illuminance without shadows, lx, where it is known: (12) for a Lambertian panel on a
    /// plane, otherwise by rules that agree (METHODS "Openings with a photometric table").
    /// Nothing very near an opening.
    /// @param negligible  two rules agree if they differ by less than this, lx, or by 2e-5
    /// Infinite: a rough value, and what it may be wrong by.
    [[nodiscard]] std::optional<RuleValue> unshadowed(double negligible = 0.0) const;

private:
    [[nodiscard]] std::optional<RuleValue> integrate(std::size_t facet,
                                                     double negligible) const;

    const Scene* scene_;
    const Emission* emission_;
    const Receiver* receiver_;
    std::size_t luminaire_;
    Point3 at_; ///< where the light is evaluated
    OpeningView view_;
};

/// Where the light of a luminaire is evaluated: at the receiver itself; within a millimetre of
/// an opening's plane or of a point source at `clear`, because in the plane itself the formulas
/// have no side.
[[nodiscard]] Point3
evaluation_point(const Luminaire& luminaire, const Receiver& receiver, const Point3& clear);

} // namespace isolux
