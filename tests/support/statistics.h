#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include <boost/math/distributions/chi_squared.hpp>

#include "isolux/base/estimate.h"

/// Honest statistical tests (METHODS "Statistical protocol"): the seed is fixed, the false
/// alarm rate is stated, nothing is picked by eye.
namespace isolux::test {

/// Number of independent seeds behind a z-test, and the limit of |z|: the two-sided 2e-9
/// quantile of Student's distribution with 63 degrees of freedom.
inline constexpr std::size_t seeds = 64;
inline constexpr double z_limit = 7.0;

/// Distance of an estimate from the truth in standard errors. A deterministic estimate (no
/// spread at all) must hit the truth to 1e-12, else the distance is infinite.
inline double z_score(const Estimate& e, double truth) {
    const double difference = e.mean - truth;
    if (e.standard_error > 0.0)
        return difference / e.standard_error;
    return std::abs(difference) <= 1e-12 * (1.0 + std::abs(truth)) ? 0.0 : HUGE_VAL;
}

/// Mean and error of `f(seed)` over the standard number of seeds.
template <class F> Estimate over_seeds(F&& f) {
    double values[seeds];
    for (std::size_t s = 0; s < seeds; ++s)
        values[s] = f(s);
    return estimate_from_replicates(values);
}

/// Probability that counts of independent draws deviate as much or more from the expected
/// counts (Pearson). Every expected count should be 5 or more.
inline double chi_square_tail(std::span<const double> observed,
                              std::span<const double> expected) {
    double sum = 0.0;
    for (std::size_t i = 0; i < observed.size(); ++i)
        sum += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    const boost::math::chi_squared distribution(static_cast<double>(observed.size() - 1));
    return boost::math::cdf(boost::math::complement(distribution, sum));
}

inline constexpr double chi_square_false_alarm = 1e-8;

} // namespace isolux::test
