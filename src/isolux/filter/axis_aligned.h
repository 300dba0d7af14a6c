#pragma once

#include "isolux/filter/filter_settings.h"
#include "isolux/filter/pixel_buffers.h"

/// The axis-aligned filter: from the noisy buffers of a renderer to a smooth
/// picture in true luminance, and how wrong it may be. METHODS 12.
namespace isolux {

struct FilteredPicture {
    PictureSize size;
    Planes3 colour;   ///< cd/m2 by channel: direct + indirect + remainder
    Planes3 direct;   ///< light straight from the luminaires
    Planes3 indirect; ///< reflected light
    /// Root of bias^2 + variance of the luminance, cd/m2, mean over a window,
    /// METHODS eq. (100): of the rule's width where `choose_width` is on (the
    /// chosen one is mostly better).
    Plane standard_error;
    Plane raw_error;      ///< the same had nothing been filtered
    Plane width_indirect; ///< standard deviation in pixels, geometric mean of
                          ///< both axes
    Plane width_shadow;   ///< of the luminaire that sends most; 0: nothing filtered
};

/// Filters the picture. The same bits for any number of threads.
/// @pre every plane of `buffers` has buffers.size.pixels() values
[[nodiscard]] FilteredPicture filter_picture(const PixelBuffers& buffers,
                                             const FilterSettings& settings);

} // namespace isolux
