#pragma once

#include "isolux/base/receiver.h"
#include "isolux/transport/point_randomness.h"
#include "isolux/transport/vertex_cache.h"

/// Local estimation with a bounded kernel and what the bound cuts off gathered by rays: METHODS
/// "Bounded kernel", eq. (75), (76). Unbiased for every bound. Shares neither kernel nor
/// weights with local_estimator.h: a second implementation to compare with.
namespace isolux {

class MirrorImages;

/// A bound that about one vertex in 200 of a pilot exceeds from the receiver, 1/m2. It must
/// come from other paths than those it will be used with, or it would bias them.
[[nodiscard]] double
choose_bound(const VertexCache& pilot, const Receiver& receiver, const Point3& at);

/// The local part, METHODS eq. (75), lx per channel.
/// @param bound   of R cos/d2, 1/m2, above 0; infinity: plain local estimation
/// @param draws   shadow rays
/// @param offset  number in [0, 1): the one random offset of the systematic draw
[[nodiscard]] Rgb estimate_below_bound(const Scene& scene,
                                       const VertexCache& cache,
                                       const Receiver& receiver,
                                       double bound,
                                       std::size_t draws,
                                       double offset);

/// What the bound cuts off, METHODS eq. (76), and whatever the receiver sees in mirrors, lx per
/// channel. With an infinite bound the mirrors alone.
/// @param directions  gather rays, numbered from `first` on
/// @param rays        counts the rays traced
[[nodiscard]] Rgb gather_above_bound(const Scene& scene,
                                     const Emission& emission,
                                     const MirrorImages& images,
                                     const Receiver& receiver,
                                     double bound,
                                     std::size_t directions,
                                     std::uint32_t first,
                                     const PointRandomness& random,
                                     std::uint64_t& rays);

} // namespace isolux
