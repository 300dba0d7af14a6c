#include "isolux/filter/gaussian_row.h"

#include <algorithm>
#include <cmath>

#include "isolux/base/wide_vectors.h"

namespace isolux {
namespace {

constexpr std::ptrdiff_t tile = 32;
constexpr float cos_ten_degrees = 0.984807753F;
constexpr float cut = 9.0F;               ///< weights end at three standard deviations
constexpr float narrowest_pixels = 0.35F; ///< below: the pixel is copied
constexpr float off_plane = 1e-5F;        ///< m, what rounding alone may do

/// Squared distance of sites i and j in standard deviations; above every cut if
/// j is rejected.
template <bool central>
ISOLUX_INLINE float
squared_distance(const SiteRow& s, std::ptrdiff_t i, std::ptrdiff_t j) noexcept {
    const float dx = s.x[j] - s.x[i];
    const float dy = s.y[j] - s.y[i];
    const float dz = s.z[j] - s.z[i];
    const float h = s.nx[i] * dx + s.ny[i] * dy + s.nz[i] * dz;
    const float cosine = s.nx[i] * s.nx[j] + s.ny[i] * s.ny[j] + s.nz[i] * s.nz[j];
    const float narrow = s.narrowness[i];
    const float other = s.narrowness[j];
    float d2 = 0.0F;
    if constexpr (central) {
        const float q = s.z[i] / s.z[j];
        const float tilt = std::abs(1.0F - q);
        const float a =
            (std::abs(s.x[j] * q - s.x[i]) + tilt * s.half_side_x) * s.inverse_scale_x;
        const float b =
            (std::abs(s.y[j] * q - s.y[i]) + tilt * s.half_side_y) * s.inverse_scale_y;
        d2 = a * a + b * b;
    } else {
        d2 = std::max(0.0F, dx * dx + dy * dy + dz * dz - h * h);
    }
    const bool accepted = (s.object[j] == s.object[i]) & (cosine >= cos_ten_degrees)
                          & ((std::abs(h) - off_plane) * narrow <= s.plane_tolerance)
                          & (other >= 0.5F * narrow) & (other <= 2.0F * narrow);
    constexpr float rejected = 1e30F;
    return accepted ? d2 * narrow * narrow : rejected;
}

/// How far a tile has to look, pixels; radius[i] for each of its pixels.
template <int widths>
std::ptrdiff_t radii(const SiteRow& s, std::ptrdiff_t t0, std::ptrdiff_t n, float* radius) {
    std::ptrdiff_t largest = 0;
    for (std::ptrdiff_t l = 0; l < n; ++l) {
        const std::ptrdiff_t i = t0 + l;
        const float scale = widths > 1 ? width_factors.back() : s.scale ? s.scale[i] : 1.0F;
        const float width = s.width[i] * scale;
        radius[l] = 0.0F;
        if (s.object[i] == 0 || !(s.narrowness[i] > 0.0F) || width < narrowest_pixels)
            continue;
        const float wanted = std::ceil(std::sqrt(cut) * width);
        radius[l] = std::min(wanted, static_cast<float>(s.largest_radius));
        largest = std::max(largest, static_cast<std::ptrdiff_t>(radius[l]));
    }
    return largest;
}

/// Nothing is shaded as far as a tile looks: whatever the weights, the mean of ones is one.
template <int channels>
bool is_all_one(const SiteRow& s,
                std::ptrdiff_t t0,
                std::ptrdiff_t n,
                std::ptrdiff_t reach,
                const float* const* in) {
    const bool is_along = s.step == 1;
    const std::ptrdiff_t begin = is_along ? std::max<std::ptrdiff_t>(0, t0 - reach) : t0;
    const std::ptrdiff_t end = is_along ? std::min(s.count, t0 + n + reach) : t0 + n;
    const std::ptrdiff_t above = is_along ? 0 : std::min(reach, s.above);
    const std::ptrdiff_t below = is_along ? 0 : std::min(reach, s.below);
    for (int c = 0; c < channels; ++c)
        for (std::ptrdiff_t r = -above; r <= below; ++r) {
            int others = 0;
            for (std::ptrdiff_t j = begin; j < end; ++j)
                others += static_cast<int>(in[c][j + r * s.step] != 1.0F);
            if (others != 0)
                return false;
        }
    return true;
}

/// The weights of one neighbour for all widths.
template <int widths> ISOLUX_INLINE void weigh(float d2, float* w) noexcept {
    if constexpr (widths == 1) {
        // a product, not a choice: the compiler must not jump
        w[0] = exp_of_negative(-0.5F * d2) * static_cast<float>(d2 <= cut);
    } else {
        const float e = exp_of_negative(d2 * -0.03125F); // four times as wide
        const float e4 = (e * e) * (e * e);
        const float e16 = (e4 * e4) * (e4 * e4);
        const float e64 = (e16 * e16) * (e16 * e16);
        w[3] = d2 <= 16.0F * cut ? e : 0.0F;
        w[2] = d2 <= 4.0F * cut ? e4 : 0.0F;
        w[1] = d2 <= cut ? e16 : 0.0F;
        w[0] = 4.0F * d2 <= cut ? e64 : 0.0F;
    }
}

template <int channels, int widths, bool central>
ISOLUX_INLINE void filter_tile(const SiteRow& s,
                               std::ptrdiff_t t0,
                               std::ptrdiff_t n,
                               const std::array<const float*, channels * widths>& in,
                               const std::array<float*, channels * widths>& out) {
    float radius[tile];
    float sharper[tile];
    float weights[widths][tile] = {};
    float sums[channels * widths][tile] = {};
    const std::ptrdiff_t reach = radii<widths>(s, t0, n, radius);
    if (reach == 0 || is_all_one<channels * widths>(s, t0, n, reach, in.data())) {
        for (int c = 0; c < channels * widths; ++c)
            std::copy_n(in[c] + t0, n, out[c] + t0);
        return;
    }
    for (std::ptrdiff_t l = 0; l < n; ++l)
        sharper[l] = widths == 1 && s.scale ? 1.0F / (s.scale[t0 + l] * s.scale[t0 + l]) : 1.0F;
    const bool is_along = s.step == 1;
    const std::ptrdiff_t first = is_along ? -reach : -std::min(reach, s.above);
    const std::ptrdiff_t last = is_along ? reach : std::min(reach, s.below);
    for (std::ptrdiff_t r = first; r <= last; ++r) {
        const std::ptrdiff_t begin = is_along ? std::max<std::ptrdiff_t>(0, -(t0 + r)) : 0;
        const std::ptrdiff_t end = is_along ? std::min(n, s.count - (t0 + r)) : n;
        const std::ptrdiff_t away = r * s.step;
        const auto steps = static_cast<float>(std::abs(r));
        for (std::ptrdiff_t l = begin; l < end; ++l) {
            const std::ptrdiff_t i = t0 + l;
            const std::ptrdiff_t j = i + away;
            const float d2 = squared_distance<central>(s, i, j) * sharper[l];
            float w[widths];
            weigh<widths>(steps <= radius[l] ? d2 : 1e30F, w);
            for (int k = 0; k < widths; ++k) {
                weights[k][l] += w[k];
                for (int c = 0; c < channels; ++c)
                    sums[k * channels + c][l] += w[k] * in[k * channels + c][j];
            }
        }
    }
    for (int k = 0; k < widths; ++k)
        for (int c = 0; c < channels; ++c)
            for (std::ptrdiff_t l = 0; l < n; ++l)
                out[k * channels + c][t0 + l] = radius[l] > 0.0F
                                                    ? sums[k * channels + c][l] / weights[k][l]
                                                    : in[k * channels + c][t0 + l];
}

template <int channels, int widths>
ISOLUX_INLINE void filter_row(const SiteRow& s,
                              const std::array<const float*, channels * widths>& in,
                              const std::array<float*, channels * widths>& out) {
    for (std::ptrdiff_t t0 = 0; t0 < s.count; t0 += tile) {
        const std::ptrdiff_t n = std::min(tile, s.count - t0);
        if (s.central)
            filter_tile<channels, widths, true>(s, t0, n, in, out);
        else
            filter_tile<channels, widths, false>(s, t0, n, in, out);
    }
}

} // namespace

ISOLUX_WIDE_VECTORS
void filter_row_3(const SiteRow& row,
                  const std::array<const float*, 3>& in,
                  const std::array<float*, 3>& out) {
    filter_row<3, 1>(row, in, out);
}

ISOLUX_WIDE_VECTORS
void filter_row_2(const SiteRow& row,
                  const std::array<const float*, 2>& in,
                  const std::array<float*, 2>& out) {
    filter_row<2, 1>(row, in, out);
}

ISOLUX_WIDE_VECTORS
void filter_row_ladder(const SiteRow& row,
                       const std::array<const float*, 8>& in,
                       const std::array<float*, 8>& out) {
    filter_row<2, 4>(row, in, out);
}

} // namespace isolux
