#pragma once

#include <cstdint>
#include <vector>

#include "isolux/filter/pixel_buffers.h"

namespace isolux {

/// Independent replicates of a picture; pass k belongs to replicate k mod 4. Even ones make
/// half A, odd ones half B.
inline constexpr std::uint32_t picture_replicates = 4;

/// Sums over the samples of a picture.
struct PictureSums {
    explicit PictureSums(std::size_t pixels);

    Planes3 raw, direct, emission, albedo;
    Plane illuminance;                 ///< lx, of samples on the majority surface
    std::vector<Plane> replicate;      ///< Y of each replicate
    std::vector<std::uint16_t> passes; ///< through the pixel so far

    /// Luminance of a pixel so far, cd/m2.
    [[nodiscard]] double mean(std::size_t pixel) const noexcept;

    /// Its standard error, METHODS eq. (90).
    [[nodiscard]] double standard_error(std::size_t pixel) const noexcept;

    /// Relative error of the whole, METHODS eq. (91).
    [[nodiscard]] double error() const;

    /// Sums become means, here and in the buffers; errors are to be asked for before.
    void divide(PixelBuffers& buffers);
};

/// What is left of `whole` without the two parts, never below 0.
[[nodiscard]] Planes3 subtract(Planes3 whole, const Planes3& first, const Planes3& second);

} // namespace isolux
