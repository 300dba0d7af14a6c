#pragma once

#include <cstdint>
#include <vector>

#include "isolux/filter/filter_settings.h"
#include "isolux/filter/pixel_buffers.h"

namespace isolux {

/// The pixels of one layer as its filter sees them: where each stands, how wide
/// it is smoothed.
///
/// A light's sites are given in the light's own frame: x and y along the
/// opening's sides from its centre, z the distance d1 along its normal. Sites
/// of reflected light are in world axes.
struct FilterSites {
    PictureSize size;
    Planes3 position;                  ///< m
    Planes3 normal;                    ///< of length 1
    std::vector<std::uint32_t> object; ///< 0: no site; neither filtered nor a source
    /// Narrowness: the Gaussian along axis a has standard deviation
    /// scale_a/narrowness. 0: the pixel is copied as it is, and is a source for
    /// nobody who has a width.
    Plane narrowness;
    Plane columns; ///< standard deviation in pixels along the row
    Plane rows;    ///< standard deviation in pixels along the column

    bool central = false; ///< a light: project through its centre, METHODS eq. (97)
    float scale_x = 1.0F; ///< central only: sigma of the side along x, m
    float scale_y = 1.0F;
    float half_side_x = 0.0F; ///< central only: m
    float half_side_y = 0.0F;

    [[nodiscard]] float largest_scale() const noexcept {
        return central ? (scale_x > scale_y ? scale_x : scale_y) : 1.0F;
    }
};

/// Widths of a shadow, METHODS eq. (94): from the pilot's slopes, gaps filled
/// from neighbours of the same object, smoothed.
[[nodiscard]] FilterSites make_shadow_sites(const PixelGeometry& geometry,
                                            PictureSize size,
                                            const LightLayer& light,
                                            const FilterSettings& settings);

/// Widths of reflected light, METHODS eq. (95).
[[nodiscard]] FilterSites make_indirect_sites(const PixelGeometry& geometry,
                                              PictureSize size,
                                              const IndirectLayer& indirect,
                                              const FilterSettings& settings);

/// Standard deviation of the lens's filter, pixels, METHODS eq. (96); 0 where
/// sharp.
[[nodiscard]] Plane make_lens_width(const PixelGeometry& geometry,
                                    const FilterSettings& settings);

} // namespace isolux
