#pragma once

#include "isolux/base/receiver.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/point_randomness.h"

#include <cstdint>
#include <span>

namespace isolux {

/// Light straight from the luminaires (and by imaged mirrors), METHODS "Direct illuminance".
///
/// A far or point-like luminaire is one exact term. For a luminous opening a few points of it are
/// looked at; a control variate (METHODS eq. (13)) makes a wholly visible one noise-free where its
/// unshadowed light is known in closed form, and nearly so elsewhere. Its coefficient is the visible
/// share found by pilot rays of their own, so that the estimate stays unbiased.
class DirectLight {
public:
    DirectLight(const Scene& scene, const Emission& emission, const MirrorImages& images);

    /// Illuminance of unit `unit` for replicates [0, result.size()), lx per channel.
    void estimate(const Receiver& receiver,
                  std::uint64_t receiver_index,
                  std::uint64_t seed,
                  std::uint32_t unit,
                  std::span<Rgb> result,
                  std::uint64_t& rays) const;

private:
    /// What one luminaire (or its image) sends unshadowed from one point of its opening.
    struct Term {
        double value = 0.0; ///< lx over density
        Point3 departure;
    };

    struct Randomness;

    [[nodiscard]] Term unshadowed(const Receiver& receiver,
                                  const Point3& at,
                                  std::size_t luminaire,
                                  double u,
                                  double v) const noexcept;
    [[nodiscard]] bool is_point_like(std::size_t luminaire, const Point3& at) const noexcept;
    void add_opening(const Receiver& receiver,
                     const Point3& clear,
                     std::size_t luminaire,
                     const Randomness& randomness,
                     std::span<Rgb> result,
                     std::uint64_t& rays) const;
    void add_images(const Receiver& receiver,
                    const Point3& at,
                    const Randomness& randomness,
                    std::span<Rgb> result,
                    std::uint64_t& rays) const;

    const Scene* scene_;
    const Emission* emission_;
    const MirrorImages* images_;
};

} // namespace isolux
