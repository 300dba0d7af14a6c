#include "isolux/calc/view_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "isolux/base/parallel.h"

namespace isolux {

namespace {

constexpr std::size_t grain = 4096; ///< pixels

/// Samples of one replicate through a pixel after `passes` passes.
std::size_t samples_of(std::size_t replicate, std::size_t passes) noexcept {
    return passes > replicate ? (passes - replicate - 1) / picture_replicates + 1 : 0;
}

void scale(Planes3& p, std::size_t i, float factor) noexcept {
    p.x[i] *= factor;
    p.y[i] *= factor;
    p.z[i] *= factor;
}

float inverse_of(float count) noexcept { return count > 0.0F ? 1.0F / count : 0.0F; }

/// A half without a sample on the majority surface takes the other's value there: its own sums
/// say nothing, not that it is dark.
void copy_half(PixelBuffers& buffers, std::size_t i, bool from_a) noexcept {
    const auto copy = [&](Plane& a, Plane& b) { (from_a ? b : a)[i] = (from_a ? a : b)[i]; };
    copy(buffers.indirect.a.x, buffers.indirect.b.x);
    copy(buffers.indirect.a.y, buffers.indirect.b.y);
    copy(buffers.indirect.a.z, buffers.indirect.b.z);
    for (LightLayer& layer : buffers.lights)
        copy(layer.visible_a, layer.visible_b);
}

/// @param passes  through the pixel
void divide_pixel(PixelBuffers& buffers, std::size_t i, std::size_t passes) noexcept {
    PixelGeometry& g = buffers.geometry;
    const auto of_a = static_cast<float>(samples_of(0, passes) + samples_of(2, passes));
    const auto of_b = static_cast<float>(samples_of(1, passes) + samples_of(3, passes));
    for (PixelSurface* s : {&g.first, &g.second}) {
        scale(s->reflected_a, i, inverse_of(of_a));
        scale(s->reflected_b, i, inverse_of(of_b));
    }
    scale(buffers.remainder_a, i, inverse_of(of_a));
    scale(buffers.remainder_b, i, inverse_of(of_b));
    scale(buffers.indirect.a, i, inverse_of(g.samples_a[i]));
    scale(buffers.indirect.b, i, inverse_of(g.samples_b[i]));
    for (LightLayer& layer : buffers.lights) {
        const bool is_lit = layer.unshadowed_first[i] > 0.0F;
        const auto mean_of = [&](float sum, float samples) {
            return is_lit && samples > 0.0F ? sum / samples : 1.0F;
        };
        layer.visible_a[i] = mean_of(layer.visible_a[i], g.samples_a[i]);
        layer.visible_b[i] = mean_of(layer.visible_b[i], g.samples_b[i]);
    }
    if ((g.samples_a[i] > 0.0F) != (g.samples_b[i] > 0.0F))
        copy_half(buffers, i, g.samples_a[i] > 0.0F);
}

} // namespace

PictureSums::PictureSums(std::size_t pixels) {
    for (Planes3* p : {&raw, &direct, &emission, &albedo})
        p->assign(pixels, 0.0F);
    illuminance.assign(pixels, 0.0F);
    replicate.assign(picture_replicates, Plane(pixels, 0.0F));
    passes.assign(pixels, 0);
}

double PictureSums::mean(std::size_t pixel) const noexcept {
    double total = 0.0;
    for (const Plane& p : replicate)
        total += static_cast<double>(p[pixel]);
    return total / std::max<double>(1.0, passes[pixel]);
}

double PictureSums::standard_error(std::size_t pixel) const noexcept {
    const std::size_t taken = passes[pixel];
    if (taken < 2)
        return 0.0;
    const double y = mean(pixel);
    double spread = 0.0;
    std::size_t groups = 0;
    for (std::size_t r = 0; r < picture_replicates; ++r) {
        const double n = static_cast<double>(samples_of(r, taken));
        if (n == 0.0)
            continue;
        ++groups;
        const double d = static_cast<double>(replicate[r][pixel]) / n - y;
        spread += n * d * d;
    }
    return std::sqrt(spread / static_cast<double>(groups - 1) / static_cast<double>(taken));
}

double PictureSums::error() const {
    const std::size_t n = passes.size();
    // Ranges of their own are summed in order: the same for any number of threads.
    const auto mean_over_pixels = [n](auto&& value) {
        std::vector<double> parts((n + grain - 1) / grain, 0.0);
        for_each_range(n, grain, [&](std::size_t begin, std::size_t end) {
            double part = 0.0;
            for (std::size_t i = begin; i < end; ++i)
                part += value(i);
            parts[begin / grain] = part;
        });
        return std::accumulate(parts.begin(), parts.end(), 0.0) / static_cast<double>(n);
    };
    const double m = mean_over_pixels([&](std::size_t i) { return mean(i); });
    if (!(m > 0.0))
        return 0.0;
    return std::sqrt(mean_over_pixels([&](std::size_t i) {
        const double e = standard_error(i);
        const double y = mean(i);
        return e * e / (y * y + 0.01 * m * m);
    }));
}

void PictureSums::divide(PixelBuffers& buffers) {
    for_each_index(passes.size(), grain, [&](std::size_t i) {
        divide_pixel(buffers, i, passes[i]);
        const float inverse = 1.0F / static_cast<float>(std::max<std::uint16_t>(1, passes[i]));
        for (Planes3* p : {&raw, &direct, &emission, &albedo})
            scale(*p, i, inverse);
        const PixelGeometry& g = buffers.geometry;
        illuminance[i] *= inverse_of(g.samples_a[i] + g.samples_b[i]);
    });
}

Planes3 subtract(Planes3 whole, const Planes3& first, const Planes3& second) {
    for (auto plane : {&Planes3::x, &Planes3::y, &Planes3::z})
        for_each_index((whole.*plane).size(), grain, [&](std::size_t i) {
            (whole.*plane)[i] =
                std::max(0.0F, (whole.*plane)[i] - (first.*plane)[i] - (second.*plane)[i]);
        });
    return whole;
}

} // namespace isolux
