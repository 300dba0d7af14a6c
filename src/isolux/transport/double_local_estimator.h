#pragma once

#include <cstdint>
#include <vector>

#include "isolux/transport/direct_light.h"
#include "isolux/transport/eye_path.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/vertex_cache.h"

/// Luminance of a place in a direction: an eye's ray, the surface it shows, and on that the
/// estimators of illuminance. Two scattering functions appear, hence "double" local estimation,
/// METHODS eq. (88).
namespace isolux {

/// How the light reflected onto a seen surface is found.
enum class ReflectedBy : std::uint8_t {
    local,       ///< local estimates alone (and gather rays for what comes by mirrors)
    mis,         ///< local estimates and gather rays
    path_tracing ///< next to edges
};

/// Work at one seen surface.
struct SeenEffort {
    std::size_t draws = 16;     ///< shadow rays to light vertices
    std::size_t directions = 4; ///< gather rays
    std::size_t samples = 32;   ///< traced paths, next to edges
};

/// Which numbers belong to one estimate: a pure function of these.
struct SeenKey {
    std::uint64_t seed = 1;
    std::uint32_t replicate = 0;
    std::uint32_t unit = 0;
    std::uint64_t place = 0; ///< number of the pixel or of the ray
};

/// Reflected illuminance on surfaces that eyes see. Refers to its arguments.
class DoubleLocalEstimator {
public:
    DoubleLocalEstimator(const Scene& scene,
                         const Emission& emission,
                         const MirrorImages& images)
        : scene_(&scene), emission_(&emission), images_(&images) {}

    /// Next to an edge (nearer than `edge`, m, to a second surface) a place is traced instead;
    /// a matter of geometry only, METHODS 11.2.
    [[nodiscard]] ReflectedBy choose(const SeenSurface& seen, double edge) const noexcept;

    /// Illuminance on the surface by light that was reflected at least once, lx by channel;
    /// light that comes by the mirrors of `images` straight from a luminaire is not included.
    /// @param cache  light vertices of this replicate and unit, weighed with `counts`
    [[nodiscard]] Rgb reflected(const SeenSurface& seen,
                                ReflectedBy by,
                                const VertexCache& cache,
                                const EffectiveCounts& counts,
                                const SeenEffort& effort,
                                const SeenKey& key,
                                std::uint64_t& rays) const;

private:
    const Scene* scene_;
    const Emission* emission_;
    const MirrorImages* images_;
};

/// Luminance that a Lambertian surface sends to the eye under illuminance `e`, cd/m2, METHODS
/// eq. (88).
[[nodiscard]] inline Rgb luminance_of(const SeenSurface& seen, const Rgb& e) noexcept {
    constexpr double inverse_pi = 0.318309886183790671538;
    return (seen.throughput * inverse_pi) * (e * seen.diffuse);
}

/// The place as a receiver of illuminance.
[[nodiscard]] inline Receiver receiver_at(const SeenSurface& seen) noexcept {
    return {seen.at, seen.normal, IlluminanceKind::planar, {}};
}

} // namespace isolux
