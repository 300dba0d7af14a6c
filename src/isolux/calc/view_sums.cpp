#include "isolux/calc/view_sums.h"

#include <algorithm>
#include <cmath>

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
        layer.visible_a[i] = g.samples_a[i] > 0.0F ? layer.visible_a[i] / g.samples_a[i] : 1.0F;
        layer.visible_b[i] = g.samples_b[i] > 0.0F ? layer.visible_b[i] / g.samples_b[i] : 1.0F;
    }
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
    double m = 0.0;
    for (std::size_t i = 0; i < n; ++i)
        m += mean(i) / static_cast<double>(n);
    if (!(m > 0.0))
        return 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const double e = standard_error(i);
        const double y = mean(i);
        sum += e * e / (y * y + 0.01 * m * m);
    }
    return std::sqrt(sum / static_cast<double>(n));
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
        for (std::size_t i = 0; i < (whole.*plane).size(); ++i)
            (whole.*plane)[i] =
                std::max(0.0F, (whole.*plane)[i] - (first.*plane)[i] - (second.*plane)[i]);
    return whole;
}

} // namespace isolux
