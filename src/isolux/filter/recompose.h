#pragma once

#include <cstddef>
#include <span>

#include "isolux/filter/gaussian_filter.h"

/// From filtered quantities back to luminance, surface by surface, METHODS eq.
/// (99).
namespace isolux {

/// Value of a plane on the second surface of pixel i: Gaussian mean of 1 pixel
/// over the pixels within 5 whose majority surface it is; nothing if there is
/// none. Several planes at once.
/// @param values  one result for each plane
/// @return  false if no pixel shows that surface; values are then untouched
bool read_second_surface(const PixelGeometry& geometry,
                         PictureSize size,
                         std::size_t i,
                         std::span<const Plane* const> planes,
                         std::span<float> values);

/// <k E> = <k><E> + cov(k, E) with the covariance kept, METHODS eq. (98): exact
/// but for the filter of <E>, and as noisy as E times the contrast of k.
/// @param k  mean factor a pixel (lens-filtered), @param E filtered mean,
/// @param covariance raw
[[nodiscard]] Plane
recompose_with_covariance(const Plane& k, const Plane& E, const Plane& covariance);

} // namespace isolux
