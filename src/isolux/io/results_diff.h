#pragma once

#include <string>
#include <vector>

#include "isolux/io/results_json.h"

namespace isolux {

/// A number that two results have, and how far it moved.
struct ValueChange {
    std::string where; ///< surface or observers
    std::string what;  ///< "Em", "U0", "UGR", "17 of 76 points"
    std::string unit;
    Estimate before;
    Estimate after;
};

struct VerdictChange {
    std::string where;
    std::string what;   ///< standard, row and symbol
    std::string before; ///< a word of Decision, or "-"
    std::string after;
};

/// What changed between two results.
struct ResultsDiff {
    std::vector<std::string> inputs; ///< files and settings, in words
    std::vector<ValueChange> values; ///< beyond both errors
    std::vector<VerdictChange> verdicts;
    std::vector<std::string> missing; ///< surfaces and observers of one only
    std::size_t compared = 0;         ///< numbers looked at

    /// Whether anything but the inputs differs.
    [[nodiscard]] bool has_changes() const noexcept {
        return !values.empty() || !verdicts.empty() || !missing.empty();
    }
};

/// Compares two results. A value has changed where the difference exceeds Student's quantile
/// times the root of both squared errors, at a level of (1 - confidence) for all values
/// together (METHODS eq. (114)). Exact values (no error on either side) have changed where they
/// differ by more than 1e-9 of themselves.
[[nodiscard]] ResultsDiff compare_results(const ResultsDocument& before,
                                          const ResultsDocument& after,
                                          double confidence = 0.95);

} // namespace isolux
