#pragma once

#include <optional>

#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// A surface that cached vertices light, seen from the gather ray that met it.
struct LitPlace {
    Point3 at;
    UnitVector3 normal;
    /// n1/n2 of METHODS eq. (10) over p2, without h of (144), m2: what light paths do beside
    /// the gather ray.
    double rival = 0.0;
    double nearest = 0.0; ///< vertices nearer than this do not count, m
    /// EffectiveCounts::area
    double area = 0.0;
};

/// One vertex of a cache and how many times its light counts.
struct ChosenVertex {
    std::size_t vertex = 0;
    double share = 0.0; ///< W/M of METHODS eq. (139)
};

/// Brings the hand near in good time. @param u  as in choose_vertex
void fetch_hand(const VertexCache& cache, double u) noexcept;

/// Of a hand of vertices drawn evenly one by what it would add at a place if nothing stood in
/// the way, METHODS eq. (139). The mean over many choices of `share` times the light of the
/// vertex is that of all vertices, whatever stands in the way.
/// @param u, v  in [0, 1): for the hand and for the choice
/// @return      nothing where none of them would add light
[[nodiscard]] std::optional<ChosenVertex>
choose_vertex(const VertexCache& cache, const LitPlace& place, double u, double v) noexcept;

} // namespace isolux
