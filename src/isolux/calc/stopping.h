#pragma once

#include <cstddef>

#include "isolux/base/estimate.h"

namespace isolux {

/// When a result is good enough: doubling with error spending, METHODS "Stopping". Check j
/// looks at an interval of miscoverage a_j = a 6 / (pi^2 (j+1)^2), so that however many checks
/// are made, a false success is no more likely than a.
class StoppingRule {
public:
    /// @param confidence  of the statement, e.g. 0.95
    /// @param values      how many values the statement is about at once (Bonferroni); 1: each
    /// by itself
    StoppingRule(double tolerance, double confidence, std::size_t values);

    /// Half width of the interval at check `check`, in units of the standard error.
    [[nodiscard]] double factor(std::size_t check, std::size_t replicates) const;

    /// Whether the interval at check `check` is within the tolerance of its value.
    /// @param floor  value below which the tolerance grows no smaller, same unit as the
    /// estimate
    [[nodiscard]] bool is_met(const Estimate& e, std::size_t check, double floor) const;

    [[nodiscard]] double tolerance() const noexcept { return tolerance_; }

private:
    double tolerance_;
    double miscoverage_;
};

} // namespace isolux
