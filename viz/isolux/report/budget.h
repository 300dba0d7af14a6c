#pragma once

#include "isolux/calc/results.h"

namespace isolux::report {

/// What is assumed, not measured: relative half widths at about 95 % coverage.
struct Assumptions {
    double photometry = 0.05;      ///< of measured luminous intensities
    double flux = 0.10;            ///< of a luminaire's flux against its rating
    double reflected_light = 0.10; ///< of reflected light, for reflectances unlike those given
    double maintenance = 0.10;     ///< of the maintenance factor
};

/// Relative uncertainties of a surface's mean, METHODS eq. (121).
struct Budget {
    double monte_carlo = 0.0;
    double photometry = 0.0;
    double flux = 0.0;
    double reflectance = 0.0; ///< the assumption times the share of reflected light
    double maintenance = 0.0;
    double combined = 0.0;

    /// A component's part of the sum of squares, 0..1.
    [[nodiscard]] double share(double component) const noexcept;
};

[[nodiscard]] Budget
make_budget(const SurfaceResult& surface, double confidence, const Assumptions& assumptions);

} // namespace isolux::report
