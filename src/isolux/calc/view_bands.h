#pragma once

#include <cstddef>
#include <vector>

#include "isolux/calc/render.h"

/// Large pictures in bands of rows: what is held while rendering is held for one band at a
/// time.
namespace isolux {

/// Some rows of a view's picture.
struct PictureRows {
    std::size_t first = 0; ///< a multiple of the side of a tile
    std::size_t count = 0;
};

/// A band: the rows that it gives to the picture, and those that are rendered for it. The
/// filter looks beyond its edges.
struct PictureBand {
    PictureRows kept;
    PictureRows rendered;
};

/// One band, or as few as hold no more than about settings.pixels_at_once each. What is
/// denoised or filtered through a lens is one.
[[nodiscard]] std::vector<PictureBand> bands_of(const Camera& camera,
                                                const RenderSettings& settings);

/// Renders some rows: a picture of their size.
[[nodiscard]] ViewPicture render_rows(const Scene& scene,
                                      const View& view,
                                      const RenderSettings& settings,
                                      const Control& control,
                                      const PictureRows& rows);

} // namespace isolux
