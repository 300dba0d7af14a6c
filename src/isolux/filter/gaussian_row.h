#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

/// The inner loop of the filter: one row's part of a pass along rows or along
/// columns, METHODS eq. (97). Written so that the compiler turns it into vector
/// code: a tile of pixels of the row meets its neighbours one distance after the
/// other, and what is rejected gets the weight 0.
namespace isolux {

/// Widths tried besides "unfiltered", as factors of the rule's, METHODS
/// "Filter, then verify".
inline constexpr std::array<float, 4> width_factors{0.5F, 1.0F, 2.0F, 4.0F};

/// One row of sites; see FilterSites.
struct SiteRow {
    const float* x = nullptr;
    const float* y = nullptr;
    const float* z = nullptr;
    const float* nx = nullptr;
    const float* ny = nullptr;
    const float* nz = nullptr;
    const std::uint32_t* object = nullptr;
    const float* narrowness = nullptr;
    const float* width = nullptr; ///< standard deviation, pixels along the pass
    const float* scale = nullptr; ///< factor of the width; null: 1
    std::ptrdiff_t count = 0;
    std::ptrdiff_t step =
        1; ///< from a pixel to its neighbour: 1 along rows, else a row's length
    std::ptrdiff_t above = 0; ///< rows over this one; along columns only
    std::ptrdiff_t below = 0; ///< rows under it
    std::ptrdiff_t largest_radius = 0;
    bool central = false;
    float inverse_scale_x = 1.0F;
    float inverse_scale_y = 1.0F;
    float half_side_x = 0.0F;
    float half_side_y = 0.0F;
    float plane_tolerance = 0.0F; ///< distance from the tangent plane, times the narrowness
};

/// e^x for x <= 0 to 2e-7, without a branch or a call.
inline float exp_of_negative(float x) noexcept {
    constexpr float log2_e = 1.44269504F;
    constexpr float lowest = -125.0F;
    float t = x * log2_e;
    t = t > lowest ? t : lowest;
    const auto whole = static_cast<std::int32_t>(t - 0.5F); // towards zero: t is negative
    const float f = t - static_cast<float>(whole);          // -0.5 .. 0.5
    constexpr float c1 = 0.693147181F;
    constexpr float c2 = 0.240226507F;
    constexpr float c3 = 0.0555041087F;
    constexpr float c4 = 0.00961812911F;
    constexpr float c5 = 0.00133335581F;
    constexpr float c6 = 0.000154035304F;
    const float p = 1.0F + f * (c1 + f * (c2 + f * (c3 + f * (c4 + f * (c5 + f * c6)))));
    return p * std::bit_cast<float>((whole + 127) << 23);
}

/// One width, three channels: `out[c][i] = sum w in[c][j] / sum w`. `in` and
/// `out` point at the row.
void filter_row_3(const SiteRow& row,
                  const std::array<const float*, 3>& in,
                  const std::array<float*, 3>& out);

/// One width, two channels.
void filter_row_2(const SiteRow& row,
                  const std::array<const float*, 2>& in,
                  const std::array<float*, 2>& out);

/// All widths of width_factors, two channels: [2 * width + channel].
void filter_row_ladder(const SiteRow& row,
                       const std::array<const float*, 8>& in,
                       const std::array<float*, 8>& out);

} // namespace isolux
