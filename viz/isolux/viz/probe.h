#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "isolux/calc/results.h"

namespace isolux {

/// The calculation point next to a place.
struct ProbedPoint {
    std::size_t surface = 0;
    std::size_t point = 0; ///< in the surface
    double distance = 0.0; ///< m
};

/// Among all surfaces, or in `surface` alone; the first of equally near ones. Nothing where
/// there is no point.
[[nodiscard]] std::optional<ProbedPoint>
find_nearest_point(const Results& results,
                   const Point3& place,
                   std::optional<std::size_t> surface = std::nullopt);

/// What was found there, for people, in a few lines: surface, place, illuminance in lx with its
/// interval, direct and indirect part.
[[nodiscard]] std::string describe_point(const Results& results, const ProbedPoint& probed);

} // namespace isolux
