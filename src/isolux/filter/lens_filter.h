#pragma once

#include "isolux/filter/axis_aligned.h"
#include "isolux/filter/gaussian_filter.h"

namespace isolux {

/// Luminances of both halves, unfiltered and filtered with the rule's widths,
/// cd/m2, without the remainder.
struct VerifiedHalves {
    explicit VerifiedHalves(std::size_t pixels)
        : raw{Plane(pixels, 0.0F), Plane(pixels, 0.0F)}, filtered(raw) {}

    Halves raw;
    Halves filtered;
};

/// Adds the remainder, filters by the lens where the picture is out of focus
/// and the halves say that it helps (METHODS eq. (96), (100)), and measures the
/// errors.
void finish_picture(const PixelBuffers& buffers,
                    const FilterSettings& settings,
                    VerifiedHalves& halves,
                    FilteredPicture& picture);

} // namespace isolux
