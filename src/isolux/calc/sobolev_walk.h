#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/validate/sobolev.h"

/// Light paths between two infinite planes without any geometry: a cosine step is a horizontal
/// length H sqrt(u/(1-u)) in a random direction (METHODS "The Sobolev problem"). Shares no code
/// with the ray tracer and nothing with the planes' closed answer.
namespace isolux {

/// A circular ring around the foot of the source; a disc if `inner` is 0.
struct Ring {
    double inner = 0.0; ///< m
    double outer = 0.0; ///< m

    [[nodiscard]] double area() const noexcept;
};

/// The ring of a given width whose middle is `radius`; what would lie beyond the foot is cut
/// off.
[[nodiscard]] Ring ring_around(double radius, double width) noexcept;

/// Values of one replicate, lx: plane one at every radius, then plane two.
struct PlaneValues {
    std::vector<double> total;
    std::vector<double> reflected; ///< without the light that comes straight from the source
};

/// Direct simulation: the flux of every path is counted on the ring it lands on, over the
/// ring's area. Its expectation is the mean of E over the ring, not E at its middle.
/// @param paths  light paths of this replicate
[[nodiscard]] PlaneValues count_on_rings(const SobolevProblem& problem,
                                         std::span<const Ring> rings,
                                         std::size_t paths,
                                         std::uint64_t seed,
                                         std::uint32_t replicate);

/// Local estimation of the same paths at the points themselves, METHODS eq. (6); the light
/// straight from the source is its closed formula.
[[nodiscard]] PlaneValues estimate_between_planes(const SobolevProblem& problem,
                                                  std::span<const double> radii,
                                                  std::size_t paths,
                                                  std::uint64_t seed,
                                                  std::uint32_t replicate);

} // namespace isolux
