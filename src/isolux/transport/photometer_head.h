#pragma once

#include <vector>

#include "isolux/base/receiver.h"
#include "isolux/transport/point_randomness.h"
#include "isolux/transport/vertex_cache.h"

/// Local estimation at a photometer's head: a small disc instead of a point, METHODS
/// "Photometer head". What it gives is the mean over the disc; for the value at the point that
/// is a bias, and the results say so.
namespace isolux {

class MirrorImages;

/// The disc as a polygon, cut where the surface it lies on ends or another begins.
struct PhotometerHead {
    std::vector<Point3> outline;
    double area = 0.0;  ///< m2
    double reach = 0.0; ///< m; vertices nearer than this see the disc, others its middle
    bool is_cut = false;
};

/// @param radius  of the head, m
/// @pre receiver.kind is planar
[[nodiscard]] PhotometerHead
make_photometer_head(const Scene& scene, const Receiver& receiver, double radius);

/// Mean illuminance over the head that is not direct, lx per channel. Near vertices count by
/// the form factor of the polygon, METHODS eq. (77), which is bounded: no bursts. Visibility
/// is looked at from a random place of the head.
[[nodiscard]] Rgb estimate_at_head(const Scene& scene,
                                   const VertexCache& cache,
                                   const Receiver& receiver,
                                   const PhotometerHead& head,
                                   std::size_t draws,
                                   double offset,
                                   std::uint32_t first,
                                   const PointRandomness& random);

} // namespace isolux
