#pragma once

#include <array>
#include <cstddef>

#include "isolux/filter/filter_sites.h"

/// The Gaussian of METHODS eq. (97), one pass along rows and one along columns
/// of its result. The same bits for any number of threads.
namespace isolux {

/// Three planes smoothed with the sites' widths, or with `scale` times the
/// widths where given. Pixels that are no site, or narrower than 0.35 pixels,
/// are copied.
[[nodiscard]] Planes3 filter_colours(const FilterSites& sites,
                                     const Planes3& planes,
                                     std::size_t radius,
                                     const Plane* scale = nullptr);

/// Two halves of one quantity.
struct Halves {
    Plane a;
    Plane b;
};

[[nodiscard]] Halves
filter_halves(const FilterSites& sites, const Halves& halves, std::size_t radius);

/// The halves smoothed with 1/2, 1, 2 and 4 times the sites' widths, in one go.
[[nodiscard]] std::array<Halves, 4>
filter_ladder(const FilterSites& sites, const Halves& halves, std::size_t radius);

/// A Gaussian in pixels that mixes everything, as a lens does, METHODS eq.
/// (96).
[[nodiscard]] Planes3 filter_lens(PictureSize size, const Plane& width, const Planes3& planes);

} // namespace isolux
