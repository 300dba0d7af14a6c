#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "isolux/base/estimate.h"

namespace isolux {

/// Values of one surface: replicate r, point p at [r * points + p].
struct ReplicateTable {
    std::size_t replicates = 0;
    std::size_t points = 0;
    std::vector<double> values;

    [[nodiscard]] std::span<const double> row(std::size_t r) const noexcept {
        return {values.data() + r * points, points};
    }
};

/// Statistics of a calculation surface, EN 12464-1: Em, Emin, Emax, U0 = Emin/Em, Ud =
/// Emin/Emax.
///
/// Minimum, maximum and their ratios come from sample splitting and are free of the selection
/// of noise. On a flat field they may therefore lie on the wrong side of the mean by their own
/// error: U0 = 1.001 +- 0.002 is an honest answer there.
struct SurfaceSummary {
    Estimate mean;
    Estimate minimum;
    Estimate maximum;
    Estimate uniformity;          ///< U0; 0 for a surface that is dark throughout
    Estimate diversity;           ///< Ud; 0 for a surface that is dark throughout
    double plug_in_minimum = 0.0; ///< smallest of the point means; biased low by noise
    double plug_in_maximum = 0.0; ///< largest of the point means; biased high by noise
};

/// Mean over the points per replicate, then METHODS eq. (15); minimum, maximum, U0 and Ud by
/// sample splitting: the even replicates choose the point, the odd ones give its value, and the
/// reverse; the two are averaged. Ratios use the delete-one jackknife inside each half (METHODS
/// "Grid statistics"). What the plug-in values differ by counts as an error beside the others.
/// With fewer than four replicates there is nothing to split and the
/// plug-in values stand, with jackknife errors; with one replicate (deterministic values)
/// standard errors are 0.
[[nodiscard]] SurfaceSummary summarise(const ReplicateTable& table);

/// Delete-one jackknife over replicates of any smooth functional T of the point means:
/// SE^2 = (R-1)/R sum (T_(-r) - mean)^2, value R T - (R-1) mean T_(-r), free of the bias of
/// order 1/R. Source: Miller, "The jackknife - a review", Biometrika 61, 1974.
/// @pre functional is defined for `points` values
[[nodiscard]] Estimate
jackknife(const ReplicateTable& table,
          const std::function<double(std::span<const double>)>& functional);

} // namespace isolux
