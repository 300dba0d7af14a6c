#pragma once

#include <cstddef>

#include "isolux/calc/picture.h"
#include "isolux/filter/pixel_buffers.h"
#include "isolux/scene/scene.h"

/// From what a renderer gathered to the picture that it hands out.
namespace isolux {

/// Adds the filtered planes. @pre sums are means, picture.samples and is_preview are set
void filter_along_surfaces(const PixelBuffers& buffers, ViewPicture& picture);

/// Moves the planes of geometry out of the buffers, positions to the world's origin.
void take_geometry(const Scene& scene, PixelBuffers& buffers, ViewPicture& picture);

/// Memory held while rendering, bytes a pixel: buffers, sums, results and the plan of samples.
[[nodiscard]] std::size_t bytes_held(const PixelBuffers& buffers) noexcept;

} // namespace isolux
