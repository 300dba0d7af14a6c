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
struct SurfaceSummary {
    Estimate mean;
    Estimate minimum;
    Estimate maximum;
    Estimate uniformity;          ///< U0
    Estimate diversity;           ///< Ud
    double plug_in_minimum = 0.0; ///< smallest of the point means; biased low by noise
    double plug_in_maximum = 0.0; ///< largest of the point means; biased high by noise
};

/// Mean over the points per replicate, then METHODS eq. (15); minimum and maximum by sample
/// splitting; U0 and Ud with the delete-one jackknife over replicates (METHODS "Grid
/// statistics"). With one replicate (deterministic values) standard errors are 0.
[[nodiscard]] SurfaceSummary summarise(const ReplicateTable& table);

/// Delete-one jackknife over replicates of any functional of the point means.
[[nodiscard]] Estimate
jackknife(const ReplicateTable& table,
          const std::function<double(std::span<const double>)>& functional);

} // namespace isolux
