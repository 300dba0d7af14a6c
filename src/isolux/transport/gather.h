#pragma once

#include "isolux/base/receiver.h"
#include "isolux/transport/point_randomness.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

class MirrorImages;

/// What the gather rays are for.
enum class GatherPart {
    balanced,     ///< share all paths with the local estimate (METHODS eq. (10)):
                  ///< local_estimation_mis
    mirrors_only, ///< only what a local estimate alone cannot see: light that reaches the
                  ///< receiver by mirrors
};

/// The gather half of LE-MIS for one receiver, METHODS "LE-MIS" technique T2: `directions` rays
/// from the receiver; where they meet a diffuse surface, a luminaire sample and one cached
/// vertex light it. Rays go on through panes and mirrors. Emission of luminaires seen in
/// mirrors counts unless `images` does it.
///
/// @param first   number of the first gather sample of this replicate (grows from unit to unit)
/// @param rays    counts the rays traced
/// @return        lx per channel, mean over the directions; light straight from luminaires is
/// not included
[[nodiscard]] Rgb gather_indirect(const Scene& scene,
                                  const Emission& emission,
                                  const MirrorImages& images,
                                  const VertexCache& cache,
                                  const EffectiveCounts& counts,
                                  const Receiver& receiver,
                                  GatherPart part,
                                  std::size_t directions,
                                  std::uint32_t first,
                                  const PointRandomness& random,
                                  std::uint64_t& rays);

} // namespace isolux
