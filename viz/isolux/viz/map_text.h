#pragma once

#include <string>

#include "isolux/viz/map.h"
#include "isolux/viz/map_page.h"

namespace isolux {

/// Title and figures of a map: Em, U0, Emin, Emax with their intervals, how far every point is
/// trusted.
[[nodiscard]] PageText describe_result(const SurfaceResult& result, const MapNotes& notes);

/// Largest half width of an interval over the value, in units of the tolerance's rule: values
/// below absolute_tolerance / tolerance count as that.
[[nodiscard]] double worst_relative_error(const SurfaceResult& result, const MapNotes& notes);

/// Median half width of the points' intervals, lx.
[[nodiscard]] double typical_half_width(const SurfaceResult& result, double confidence);

} // namespace isolux
