#pragma once

#include <cstdint>
#include <vector>

#include "isolux/transport/mirror_images.h"
#include "isolux/transport/point_randomness.h"

/// Light of luminaires that reaches a place by mirrors, found by the image of the place.
namespace isolux {

/// Light of one emission point that reaches a place over a chain of mirrors.
struct ImageLight {
    UnitVector3 arrival; ///< from the place towards where the light comes from
    double strength =
        0.0; ///< intensity per area of opening times reflectances over squared path length
    TowardsSample sample;
};

/// The place as the luminaires see it in the mirrors of `chain` (nearest to the place first).
[[nodiscard]] Point3 image_of(const MirrorImages& images,
                              const std::vector<std::uint32_t>& chain,
                              const Point3& place) noexcept;

/// Follows the light of an emission point to a place over a chain of mirrors; every segment is
/// traced, panes that only pass the light dim it.
/// @param sample  drawn for image_of(place)
[[nodiscard]] ImageLight trace_image(const Scene& scene,
                                     const Emission& emission,
                                     const MirrorImages& images,
                                     const std::vector<std::uint32_t>& chain,
                                     const Point3& place,
                                     const TowardsSample& sample,
                                     std::uint64_t& rays) noexcept;

/// Light of one luminaire on a surface over one chain of imaged mirrors.
struct ImageEvent {
    Rgb illuminance; ///< lx, over the probability of all that was drawn
    std::size_t luminaire = 0;
};

/// Of a hand of chains and places on luminaires one, drawn in proportion to what it would add
/// if nothing stood in the way, METHODS eq. (146). Its mean is the light over all imaged
/// chains.
/// @param at      the place, moved off its surface
/// @param normal  of the lit side
/// @pre images.chains() not empty
[[nodiscard]] ImageEvent sample_image_event(const Scene& scene,
                                            const Emission& emission,
                                            const MirrorImages& images,
                                            const Point3& at,
                                            const UnitVector3& normal,
                                            NumberSequence& numbers,
                                            std::uint64_t& rays) noexcept;

} // namespace isolux
