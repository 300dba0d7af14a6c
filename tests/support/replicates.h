#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/calc/calculate.h"

/// Statistical protocol of METHODS "Verification": 64 independent replicates (4 seeds of 16)
/// behind every z; |z| < 7 with 63 degrees of freedom is a two-sided false alarm of 2e-9.
namespace isolux::test {

inline constexpr double z_limit = 7.0;

struct Sample {
    std::size_t points = 0;
    std::vector<std::vector<double>> rows; ///< one a replicate

    [[nodiscard]] Estimate point(std::size_t p) const {
        std::vector<double> values;
        for (const auto& row : rows)
            values.push_back(row[p]);
        return estimate_from_replicates(values);
    }

    [[nodiscard]] Estimate mean() const {
        std::vector<double> values;
        for (const auto& row : rows) {
            double sum = 0.0;
            for (const double v : row)
                sum += v;
            values.push_back(sum / static_cast<double>(row.size()));
        }
        return estimate_from_replicates(values);
    }

    /// Fixed +-1 combinations over the points, each one quantity: points share paths, so their
    /// own z values are correlated.
    [[nodiscard]] Estimate projection(std::uint32_t which) const {
        std::vector<double> values;
        for (const auto& row : rows) {
            double sum = 0.0;
            std::uint32_t state = 0x9e3779b9U * (which + 1U);
            for (const double v : row) {
                state = state * 1664525U + 1013904223U;
                sum += which == 0 || (state >> 31U) != 0 ? v : -v;
            }
            values.push_back(sum);
        }
        return estimate_from_replicates(values);
    }
};

/// The replicate values of calculations with `seeds` seeds from `first_seed` on.
inline Sample sample(const Scene& scene,
                     std::span<const Receiver> receivers,
                     Settings settings,
                     std::uint64_t first_seed = 1,
                     std::size_t seeds = 4) {
    CalculationSurface surface;
    surface.name = "points";
    surface.receivers.assign(receivers.begin(), receivers.end());
    const std::vector<CalculationSurface> surfaces{surface};
    Sample result;
    result.points = receivers.size();
    for (std::uint64_t s = 0; s < seeds; ++s) {
        settings.seed = first_seed + s;
        const Results r = calculate(scene, surfaces, settings);
        const ReplicateTable& t = r.surfaces.front().replicates;
        for (std::size_t i = 0; i < t.replicates; ++i)
            result.rows.emplace_back(t.row(i).begin(), t.row(i).end());
    }
    return result;
}

/// The same with a fixed number of units of work each.
inline Sample sample(const Scene& scene,
                     std::span<const Receiver> receivers,
                     Estimator estimator,
                     std::size_t units,
                     std::uint64_t first_seed = 1,
                     std::size_t seeds = 4) {
    Settings settings;
    settings.fixed_units = units;
    settings.estimator = estimator;
    return sample(scene, receivers, settings, first_seed, seeds);
}

inline double z_score(const Estimate& e, double exact) {
    if (e.standard_error == 0.0)
        return e.mean == exact ? 0.0 : (e.mean - exact) / (1e-9 * exact);
    return (e.mean - exact) / e.standard_error;
}

inline double z_score(const Estimate& a, const Estimate& b) {
    return (a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

} // namespace isolux::test
