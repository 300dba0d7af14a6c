#pragma once

#include "isolux/base/receiver.h"
#include "isolux/transport/follow.h"

namespace isolux {

/// Illuminance at the receiver that is not direct, by path tracing from the receiver with
/// next-event estimation: the independent second opinion.
///
/// @param first   number of the first sample of this replicate (grows from unit to unit)
/// @param rays    counts the rays traced
/// @return        lx per channel, mean over `samples` paths; light straight from luminaires, or
/// by
///                the mirrors that `images` covers, is not included
[[nodiscard]] Rgb trace_indirect(const Scene& scene,
                                 const Emission& emission,
                                 const MirrorImages& images,
                                 const Receiver& receiver,
                                 std::size_t samples,
                                 std::uint32_t first,
                                 const PointRandomness& random,
                                 std::uint64_t& rays);

/// Luminance that the diffuse surface at `y` sends back along the ray that met it, from one
/// random path, times the ray's throughput.
[[nodiscard]] Rgb trace_reflected(const Scene& scene,
                                  const Emission& emission,
                                  const MirrorImages& images,
                                  const Meeting& y,
                                  NumberSequence& numbers,
                                  std::uint64_t& rays);

} // namespace isolux
