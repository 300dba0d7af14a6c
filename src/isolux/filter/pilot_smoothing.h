#pragma once

#include <cstdint>
#include <vector>

#include "isolux/filter/pixel_buffers.h"

/// What a handful of pilot rays a pixel leave open, neighbours fill in.
namespace isolux {

/// Pixels without a value (< 0) take the smallest of the pixels of the same
/// object within 5 pixels, along rows, then along columns.
void fill_slopes(PictureSize size, const std::vector<std::uint32_t>& object, Plane& slope_min);

/// Gaussian of 1 pixel among the pixels of the same object whose value is above
/// 0; others stay.
void smooth_positive(PictureSize size, const std::vector<std::uint32_t>& object, Plane& values);

/// Smallest value within `radius` pixels on the same surface (object, and normals
/// within 10 degrees).
[[nodiscard]] Plane smallest_nearby(PictureSize size,
                                    const std::vector<std::uint32_t>& object,
                                    const Planes3& normal,
                                    const Plane& values,
                                    std::size_t radius);

} // namespace isolux
