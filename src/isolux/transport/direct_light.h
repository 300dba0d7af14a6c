#pragma once

#include <cstdint>
#include <span>

#include "isolux/base/receiver.h"
#include "isolux/transport/mirror_images.h"
#include "isolux/transport/point_randomness.h"

namespace isolux {

/// Light straight from the luminaires (and by imaged mirrors), METHODS "Direct illuminance".
///
/// A far or point-like luminaire is one exact term. For a luminous opening a few points of it
/// are looked at; a control variate (METHODS eq. (13)) makes a wholly visible one noise-free
/// where its unshadowed light is known in closed form, and nearly so elsewhere. Its coefficient
/// is the visible share found by pilot rays of their own, so that the estimate stays unbiased.
class DirectLight {
public:
    DirectLight(const Scene& scene, const Emission& emission, const MirrorImages& images);

    /// Illuminance of unit `unit` for replicates [first_replicate, first_replicate +
    /// result.size()), lx per channel.
    void estimate(const Receiver& receiver,
                  std::uint64_t receiver_index,
                  std::uint64_t seed,
                  std::uint32_t unit,
                  std::uint32_t first_replicate,
                  std::span<Rgb> result,
                  std::uint64_t& rays) const;

private:
    struct Randomness;

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
