#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isolux/filter/filter_sites.h"

/// How many samples a pixel needs, from the pilot alone, METHODS
/// "Sample counts".
namespace isolux {

/// Share of the variance that the filter leaves: min(1, 1/(4 pi b_x b_y)).
[[nodiscard]] double variance_left(double columns, double rows) noexcept;

/// What a pixel's noise asks for.
struct SampleNeed {
    Plane variance;            ///< of one sample of the quantity, after averaging over
                               ///< neighbours, lx^2
    Plane left;                ///< variance_left of the pixel
    std::vector<bool> settled; ///< fully lit: the least number is enough
    std::vector<bool> edge;    ///< on or next to an edge of surfaces
};

/// Of shadow rays to one light: E_u^2 p(1-p), p averaged over 3 x 3 pixels of
/// the surface.
[[nodiscard]] SampleNeed
shadow_need(const PixelGeometry& geometry, const LightLayer& light, const FilterSites& sites);

/// Of reflected light: the pilot's variance averaged over 9 x 9 pixels.
[[nodiscard]] SampleNeed indirect_need(const PixelGeometry& geometry,
                                       const IndirectLayer& indirect,
                                       const FilterSites& sites);

/// Adds a layer to what others of the picture need: the variances that the
/// filter leaves add up, settled is what nobody needs.
/// @param total  empty, or what this function made
void add_need(SampleNeed& total, const SampleNeed& layer);

/// Counts for a wanted standard deviation of the filtered value.
/// @param wanted  lx, > 0
[[nodiscard]] std::vector<std::uint16_t> counts_for_error(const SampleNeed& need,
                                                          double wanted,
                                                          std::uint16_t least,
                                                          std::uint16_t most);

/// Counts that add up to about `mean` a pixel and make the relative error of
/// the picture small.
/// @param value  what the picture shows, pilot's, in the unit whose square the
/// variances have; a tenth of its mean keeps dark pixels from taking all
/// @param step  counts are multiples of it, as are least and most
[[nodiscard]] std::vector<std::uint16_t> counts_for_budget(const SampleNeed& need,
                                                           const Plane& value,
                                                           double mean,
                                                           std::uint16_t least = 2,
                                                           std::uint16_t most = 4096,
                                                           std::uint16_t step = 2);

} // namespace isolux
