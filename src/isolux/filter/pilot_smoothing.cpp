#include "isolux/filter/pilot_smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "isolux/base/parallel.h"

namespace isolux {
namespace {

constexpr std::ptrdiff_t fill_radius = 5;
constexpr std::ptrdiff_t smooth_radius = 3; ///< of a Gaussian of 1 pixel
constexpr float cos_ten_degrees = 0.984807753F;

/// Calls f(pass, y) for every row y of the picture: first all of pass 0, which looks along
/// rows, then all of pass 1, which looks along columns.
template <class F> void in_two_passes(PictureSize size, F&& f) {
    for (const int pass : {0, 1})
        for_each_index(size.rows, 8, [&](std::size_t y) { f(pass, y); });
}

/// A row's neighbours `r` steps away along rows or along columns.
struct Shift {
    std::ptrdiff_t away = 0;  ///< from a pixel to its neighbour in the picture
    std::ptrdiff_t begin = 0; ///< pixels [begin, end) of the row have one
    std::ptrdiff_t end = 0;
};

Shift shift_of(PictureSize size, std::size_t y, int pass, std::ptrdiff_t r) noexcept {
    const auto columns = static_cast<std::ptrdiff_t>(size.columns);
    if (pass == 0)
        return {r, std::max<std::ptrdiff_t>(0, -r), std::min(columns, columns - r)};
    const auto v = static_cast<std::ptrdiff_t>(y) + r;
    const bool is_inside = v >= 0 && v < static_cast<std::ptrdiff_t>(size.rows);
    return {is_inside ? r * columns : 0, 0, is_inside ? columns : 0};
}

} // namespace

void fill_slopes(PictureSize size, const std::vector<std::uint32_t>& object, Plane& slope_min) {
    Plane along_rows = slope_min;
    Plane result = slope_min;
    // Most rows of most lights know nothing.
    std::vector<std::uint8_t> is_known(size.rows, 0);
    for_each_index(size.rows, 8, [&](std::size_t y) {
        const float* const row = slope_min.data() + y * size.columns;
        float largest = -1.0F;
        for (std::size_t x = 0; x < size.columns; ++x)
            largest = std::max(largest, row[x]);
        is_known[y] = largest >= 0.0F ? 1 : 0;
    });
    in_two_passes(size, [&](int pass, std::size_t y) {
        const float* const from =
            (pass == 0 ? slope_min : along_rows).data() + y * size.columns;
        float* const to = (pass == 0 ? along_rows : result).data() + y * size.columns;
        const std::uint32_t* const id = object.data() + y * size.columns;
        std::copy_n(from, size.columns, to);
        for (std::ptrdiff_t r = -fill_radius; r <= fill_radius; ++r) {
            const Shift s = shift_of(size, y, pass, r);
            const std::size_t v = y + static_cast<std::size_t>(pass == 0 ? 0 : r);
            if (s.begin >= s.end || is_known[v] == 0)
                continue;
            const float* const other = from + s.away;
            for (std::ptrdiff_t i = s.begin; i < s.end; ++i) {
                const bool counts = id[i + s.away] == id[i] && !(other[i] < 0.0F);
                const float smallest = to[i] < 0.0F ? other[i] : std::min(to[i], other[i]);
                to[i] = counts ? smallest : to[i];
            }
        }
    });
    for_each_index(size.pixels(), 4096, [&](std::size_t p) {
        if (slope_min[p] < 0.0F && object[p] != 0)
            slope_min[p] = result[p];
    });
}

void smooth_positive(PictureSize size,
                     const std::vector<std::uint32_t>& object,
                     Plane& values) {
    float weight[2 * smooth_radius + 1];
    for (std::ptrdiff_t r = -smooth_radius; r <= smooth_radius; ++r)
        weight[r + smooth_radius] = std::exp(-0.5F * static_cast<float>(r * r));
    Plane along_rows = values;
    Plane result = values;
    in_two_passes(size, [&](int pass, std::size_t y) {
        const float* const from = (pass == 0 ? values : along_rows).data() + y * size.columns;
        float* const to = (pass == 0 ? along_rows : result).data() + y * size.columns;
        const std::uint32_t* const id = object.data() + y * size.columns;
        if (std::none_of(from, from + size.columns, [](float v) { return v > 0.0F; }))
            return;
        std::vector<float> sum(size.columns, 0.0F);
        std::vector<float> weights(size.columns, 0.0F);
        for (std::ptrdiff_t r = -smooth_radius; r <= smooth_radius; ++r) {
            const Shift s = shift_of(size, y, pass, r);
            const float w = weight[r + smooth_radius];
            for (std::ptrdiff_t i = s.begin; i < s.end; ++i) {
                const bool counts = id[i + s.away] == id[i] && from[i + s.away] > 0.0F;
                const float part = counts ? w : 0.0F;
                sum[static_cast<std::size_t>(i)] += part * from[i + s.away];
                weights[static_cast<std::size_t>(i)] += part;
            }
        }
        for (std::size_t i = 0; i < size.columns; ++i)
            if (from[i] > 0.0F)
                to[i] = sum[i] / weights[i];
    });
    values = std::move(result);
}

Plane smallest_nearby(PictureSize size,
                      const std::vector<std::uint32_t>& object,
                      const Planes3& normal,
                      const Plane& values,
                      std::size_t radius) {
    const auto reach = static_cast<std::ptrdiff_t>(radius);
    Plane along_rows = values;
    Plane result = values;
    in_two_passes(size, [&](int pass, std::size_t y) {
        const std::size_t first = y * size.columns;
        const float* const from = (pass == 0 ? values : along_rows).data() + first;
        float* const to = (pass == 0 ? along_rows : result).data() + first;
        const std::uint32_t* const id = object.data() + first;
        const float* const nx = normal.x.data() + first;
        const float* const ny = normal.y.data() + first;
        const float* const nz = normal.z.data() + first;
        std::copy_n(from, size.columns, to);
        for (std::ptrdiff_t r = -reach; r <= reach; ++r) {
            const Shift s = shift_of(size, y, pass, r);
            for (std::ptrdiff_t i = s.begin; i < s.end; ++i) {
                const std::ptrdiff_t j = i + s.away;
                const float cosine = nx[i] * nx[j] + ny[i] * ny[j] + nz[i] * nz[j];
                const bool counts = id[j] == id[i] && cosine >= cos_ten_degrees;
                to[i] = counts ? std::min(to[i], from[j]) : to[i];
            }
        }
    });
    return result;
}

} // namespace isolux
