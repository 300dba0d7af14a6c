#include "isolux/filter/recompose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace isolux {
namespace {

constexpr std::ptrdiff_t search_radius = 5;
constexpr float cos_ten_degrees = 0.984807753F;

bool shows(const PixelGeometry& g, std::size_t j, std::size_t i) {
    const PixelSurface& second = g.second;
    const PixelSurface& first = g.first;
    return first.object[j] == second.object[i] && g.samples_a[j] > 0.0F && g.samples_b[j] > 0.0F
           && first.normal.x[j] * second.normal.x[i] + first.normal.y[j] * second.normal.y[i]
                      + first.normal.z[j] * second.normal.z[i]
                  >= cos_ten_degrees;
}

} // namespace

bool read_second_surface(const PixelGeometry& geometry,
                         PictureSize size,
                         std::size_t i,
                         std::span<const Plane* const> planes,
                         std::span<float> values) {
    const auto x = static_cast<std::ptrdiff_t>(i % size.columns);
    const auto y = static_cast<std::ptrdiff_t>(i / size.columns);
    const auto columns = static_cast<std::ptrdiff_t>(size.columns);
    const auto rows = static_cast<std::ptrdiff_t>(size.rows);
    constexpr std::size_t most_planes = 16;
    std::array<float, most_planes> sums{};
    float weights = 0.0F;
    for (std::ptrdiff_t v = std::max<std::ptrdiff_t>(0, y - search_radius);
         v <= std::min(rows - 1, y + search_radius);
         ++v) {
        for (std::ptrdiff_t u = std::max<std::ptrdiff_t>(0, x - search_radius);
             u <= std::min(columns - 1, x + search_radius);
             ++u) {
            const auto j = static_cast<std::size_t>(v * columns + u);
            if (!shows(geometry, j, i))
                continue;
            const auto r2 = static_cast<float>((u - x) * (u - x) + (v - y) * (v - y));
            const float w = std::exp(-0.5F * r2);
            weights += w;
            for (std::size_t c = 0; c < planes.size(); ++c)
                sums[c] += w * (*planes[c])[j];
        }
    }
    if (!(weights > 0.0F))
        return false;
    for (std::size_t c = 0; c < planes.size(); ++c)
        values[c] = sums[c] / weights;
    return true;
}

Plane recompose_with_covariance(const Plane& k, const Plane& E, const Plane& covariance) {
    Plane out(k.size());
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = k[i] * E[i] + covariance[i];
    return out;
}

} // namespace isolux
