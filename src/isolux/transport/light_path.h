#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "isolux/transport/emission.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/path_importance.h"
#include "isolux/transport/path_randomness.h"

namespace isolux {

/// Where a light path met a diffuse surface: what METHODS "What a stored vertex contains"
/// lists.
struct PathVertex {
    Point3 position;    ///< already moved off the surface to the lit side
    UnitVector3 normal; ///< towards the incoming light
    Rgb radiant; ///< alpha rho / pi: the intensity per cosine the vertex shines with, lm/sr
    double density =
        0.0; ///< p1 of METHODS eq. (7), 1/m2; infinite behind a mirror or a pane's reflection
    /// How many chains go on diffusely from here, in the mean, times rarity(): METHODS eq.
    /// (136).
    double continuation = 0.0;
    double carried = 0.0;    ///< alpha that arrived, the Y-sum, lm
    std::uint32_t order = 1; ///< reflections up to and including this one
    std::uint32_t luminaire = 0;
    MaterialId material;
    /// How many vertices before this one the path was last reflected diffusely; 0: never.
    std::uint32_t back = 0;
    bool is_first = false; ///< lit straight by a luminaire: order 1 and no mirror on the way
    /// Whether the path began at a point source and over mirrors whose chain has no image: no
    /// ray from a surface finds its light.
    bool is_hidden = false;
};

inline constexpr double after_mirror = std::numeric_limits<double>::infinity();

/// Where the flux of a batch of paths went, lm (not yet divided by the number of paths).
struct FluxTally {
    double absorbed = 0.0;
    double escaped = 0.0;
    std::uint64_t rays = 0;
};

/// The bounds of a path's chance to go on, METHODS "Roulette". Any values leave the mean as it
/// is; they trade time for variance.
struct Roulette {
    double least = 0.05;
    double most = 0.999; ///< below 1: a path between perfect mirrors ends as well
};

/// Walks light path `path` of a replicate, METHODS "The Markov chain"; where places are
/// important it goes on as several. Vertices are appended to `vertices`, branch after branch.
/// @param images  which mirrors rays look into; null: none are told apart
/// @return where its flux went
FluxTally walk_light_path(const Scene& scene,
                          const Emission& emission,
                          const PathRandomness& random,
                          std::uint64_t path,
                          std::vector<PathVertex>& vertices,
                          const PathImportance& importance = {},
                          const Roulette& roulette = {},
                          const MirrorImages* images = nullptr);

} // namespace isolux
