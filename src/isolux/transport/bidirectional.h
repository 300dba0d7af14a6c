#pragma once

#include "isolux/base/receiver.h"
#include "isolux/transport/image_light.h"
#include "isolux/transport/point_randomness.h"

namespace isolux {

/// Light paths that are joined to the receiver for each one joined to the rest of a sensor
/// path.
inline constexpr std::size_t light_paths_per_sample = 4;

/// Illuminance that is not direct, by bidirectional path tracing with the balance heuristic
/// over all techniques: METHODS "Bidirectional path tracing". Walks light paths of its own;
/// shares neither cache nor weights with the other estimators.
///
/// @param first  number of the first sample of this replicate (grows from unit to unit)
/// @param rays   counts the rays traced
/// @return       lx per channel, mean over `samples` pairs of subpaths; light straight from
///               luminaires, or by the mirrors that `images` covers, is not included
[[nodiscard]] Rgb trace_bidirectional(const Scene& scene,
                                      const Emission& emission,
                                      const MirrorImages& images,
                                      const Receiver& receiver,
                                      std::size_t samples,
                                      std::uint32_t first,
                                      const PointRandomness& random,
                                      std::uint64_t& rays);

} // namespace isolux
