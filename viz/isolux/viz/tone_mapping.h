#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isolux/calc/picture.h"
#include "isolux/viz/drawing.h"

namespace isolux {

/// How a luminance becomes a shade, METHODS eq. (92): the photographic operator of Reinhard,
/// Stark, Shirley and Ferwerda, SIGGRAPH 2002, doi:10.1145/566570.566575, its global form.
struct Exposure {
    double middle = 1.0; ///< cd/m2 that is shown as a middle grey of 18 %
    double white = 1.0;  ///< cd/m2, the smallest luminance that is shown white
};

/// An exposure for the picture: the middle is the logarithmic mean of what is not a luminaire,
/// white lies above all surfaces. The same for the raw and the filtered picture of one view.
[[nodiscard]] Exposure choose_exposure(const ViewPicture& picture);

/// "EV 6.3 (middle grey 39 cd/m2, white from 410 cd/m2)". The exposure value is that of ISO
/// 100, by ISO 2720: 2^EV = L 100 / 12.5.
[[nodiscard]] std::string describe(const Exposure& exposure);

/// sRGB shades of the picture, row by row, three bytes a pixel.
[[nodiscard]] std::vector<std::uint8_t> tone_map(const Planes3& colours,
                                                 const Exposure& exposure);

} // namespace isolux
