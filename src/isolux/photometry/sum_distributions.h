#pragma once

#include <span>

#include "isolux/photometry/intensity_distribution.h"

namespace isolux {

/// The light of several tables with one photometric centre and frame, added up. The sum has
/// every plane and gamma of all, so it is exact everywhere. Tables that are not of type C are
/// resampled first (resample of stored_table.h).
/// @pre at least one
[[nodiscard]] IntensityDistribution
sum_distributions(std::span<const IntensityDistribution> distributions);

} // namespace isolux
