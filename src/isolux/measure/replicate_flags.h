#pragma once

#include <span>

namespace isolux {

/// Why the error bar of a replicate estimate deserves less trust (METHODS 3.5).
struct ReplicateFlags {
    bool suspicious_replicate = false; ///< largest |Y_r - mean| above 3.5 s
    bool heavy_tail = false;           ///< sample kurtosis m4/m2^2 above 6; a normal one has 3
};

/// Looks at the replicate values of one quantity. Values that differ by rounding only (1e-12 of
/// their mean) raise no flag, and neither do fewer than four.
[[nodiscard]] ReplicateFlags flag_replicates(std::span<const double> replicates) noexcept;

} // namespace isolux
