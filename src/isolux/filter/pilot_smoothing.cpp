#include "isolux/filter/pilot_smoothing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "isolux/base/parallel.h"

namespace isolux {
namespace {

constexpr std::ptrdiff_t fill_radius = 5;
constexpr std::ptrdiff_t smooth_radius = 3; ///< of a Gaussian of 1 pixel
constexpr std::ptrdiff_t minimum_radius = 2;
constexpr float cos_ten_degrees = 0.984807753F;

/// A line of pixels: index of its first, step from one to the next, how many.
struct Line {
    std::size_t first = 0;
    std::size_t step = 1;
    std::ptrdiff_t count = 0;

    [[nodiscard]] std::size_t at(std::ptrdiff_t i) const noexcept {
        return first + static_cast<std::size_t>(i) * step;
    }
};

/// Calls f(line) for all rows, then for all columns.
template <class F> void along_rows_then_columns(PictureSize size, F&& f) {
    for_each_index(size.rows, 16, [&](std::size_t y) {
        f(Line{y * size.columns, 1, static_cast<std::ptrdiff_t>(size.columns)}, 0);
    });
    for_each_index(size.columns, 16, [&](std::size_t x) {
        f(Line{x, size.columns, static_cast<std::ptrdiff_t>(size.rows)}, 1);
    });
}

/// Calls f(neighbour, offset) for those of pixel i's line within `radius`.
template <class F>
void for_neighbours(const Line& line, std::ptrdiff_t i, std::ptrdiff_t radius, F&& f) {
    const auto begin = std::max<std::ptrdiff_t>(0, i - radius);
    const auto end = std::min(line.count - 1, i + radius);
    for (auto j = begin; j <= end; ++j)
        f(line.at(j), j - i);
}

} // namespace

void fill_slopes(PictureSize size,
                 const std::vector<std::uint32_t>& object,
                 Plane& slope_min,
                 Plane& slope_max) {
    const Plane original_min = slope_min;
    Plane low[2] = {slope_min, slope_min};
    Plane high[2] = {slope_max, slope_max};
    along_rows_then_columns(size, [&](const Line& line, int pass) {
        const Plane& from_low = pass == 0 ? slope_min : low[0];
        const Plane& from_high = pass == 0 ? slope_max : high[0];
        bool is_known = false;
        for (std::ptrdiff_t i = 0; i < line.count && !is_known; ++i)
            is_known = !(from_low[line.at(i)] < 0.0F);
        if (!is_known)
            return;
        for (std::ptrdiff_t i = 0; i < line.count; ++i) {
            const std::size_t p = line.at(i);
            for_neighbours(line, i, fill_radius, [&](std::size_t q, std::ptrdiff_t) {
                if (object[q] != object[p] || from_low[q] < 0.0F)
                    return;
                low[pass][p] =
                    low[pass][p] < 0.0F ? from_low[q] : std::min(low[pass][p], from_low[q]);
                high[pass][p] = std::max(high[pass][p], from_high[q]);
            });
        }
    });
    for (std::size_t p = 0; p < size.pixels(); ++p) {
        if (original_min[p] < 0.0F && object[p] != 0) {
            slope_min[p] = low[1][p];
            slope_max[p] = high[1][p];
        }
    }
}

void smooth_positive(PictureSize size,
                     const std::vector<std::uint32_t>& object,
                     Plane& values) {
    float weight[2 * smooth_radius + 1];
    for (std::ptrdiff_t r = -smooth_radius; r <= smooth_radius; ++r)
        weight[r + smooth_radius] = std::exp(-0.5F * static_cast<float>(r * r));
    Plane along_rows = values;
    Plane result = values;
    along_rows_then_columns(size, [&](const Line& line, int pass) {
        const Plane& from = pass == 0 ? values : along_rows;
        Plane& to = pass == 0 ? along_rows : result;
        for (std::ptrdiff_t i = 0; i < line.count; ++i) {
            const std::size_t p = line.at(i);
            if (!(from[p] > 0.0F))
                continue;
            float sum = 0.0F;
            float weights = 0.0F;
            for_neighbours(line, i, smooth_radius, [&](std::size_t q, std::ptrdiff_t r) {
                if (object[q] != object[p] || !(from[q] > 0.0F))
                    return;
                const float w = weight[r + smooth_radius];
                sum += w * from[q];
                weights += w;
            });
            to[p] = sum / weights;
        }
    });
    values = std::move(result);
}

Plane smallest_nearby(PictureSize size,
                      const std::vector<std::uint32_t>& object,
                      const Planes3& normal,
                      const Plane& values) {
    Plane along_rows = values;
    Plane result = values;
    along_rows_then_columns(size, [&](const Line& line, int pass) {
        const Plane& from = pass == 0 ? values : along_rows;
        Plane& to = pass == 0 ? along_rows : result;
        for (std::ptrdiff_t i = 0; i < line.count; ++i) {
            const std::size_t p = line.at(i);
            float smallest = from[p];
            for_neighbours(line, i, minimum_radius, [&](std::size_t q, std::ptrdiff_t) {
                const float cosine = normal.x[p] * normal.x[q] + normal.y[p] * normal.y[q]
                                     + normal.z[p] * normal.z[q];
                if (object[q] == object[p] && cosine >= cos_ten_degrees)
                    smallest = std::min(smallest, from[q]);
            });
            to[p] = smallest;
        }
    });
    return result;
}

} // namespace isolux
