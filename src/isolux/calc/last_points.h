#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace isolux {

/// How far an estimator has come with the indirect light of a point.
struct Advance {
    std::size_t units = 0; ///< of work behind it
    double excess = 0.0;   ///< its variance over the one the point may have
};

/// A point that the units so far have not brought within the tolerance.
struct OpenPoint {
    std::size_t receiver = 0;
    bool refines_indirect = true; ///< false: only its direct light needs more
    double indirect = 0.0;        ///< its present indirect light, lx
    double allowed = 0.0;         ///< variance that this may have, lx2
    Advance current;              ///< of the estimator that serves it now
    Advance parked;               ///< of the one that did before
};

/// What it takes to finish an open point in one way or the other.
struct Finish {
    double units = 0.0;     ///< LE-MIS: more of them
    double unit_cost = 0.0; ///< of one at this point alone, all replicates, ns
    double traced = 0.0;    ///< path tracing: cost, all replicates, ns
};

/// What happens before the next look at the open points.
struct NextLook {
    std::size_t units = 1;            ///< of work
    std::vector<std::size_t> changed; ///< receivers whose indirect light another estimator
                                      ///< takes over
};

/// What an estimator still needs over what it has had: METHODS eq. (124).
[[nodiscard]] double share_missing(const Advance& a) noexcept;

/// The same in units.
[[nodiscard]] double units_missing(const Advance& a) noexcept;

/// How many times as much a single unit should hold to bring twice what four fifths of some
/// points are missing, at least 1. @param units  that each is missing, as units were
[[nodiscard]] double growth_for(std::vector<double> units);

/// Which points path tracing finishes for less: the light paths of LE-MIS cost the same however
/// few points are left to share them. METHODS eq. (124).
///
/// @param paths_cost  of the light paths of one unit, all replicates, ns
/// @return            numbers into `points`, ascending
[[nodiscard]] std::vector<std::size_t> choose_traced(std::span<const Finish> points,
                                                     double paths_cost);

} // namespace isolux
