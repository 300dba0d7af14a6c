#include "isolux/filter/pixel_buffers.h"

#include <limits>
#include <utility>

#include "isolux/base/parallel.h"

namespace isolux {
namespace {

void allocate(PixelSurface& surface, std::size_t pixels) {
    surface.object.assign(pixels, 0);
    surface.normal.assign(pixels, 0.0F);
    surface.reflected_a.assign(pixels, 0.0F);
    surface.reflected_b.assign(pixels, 0.0F);
}

void allocate(PixelGeometry& geometry, std::size_t pixels) {
    allocate(geometry.first, pixels);
    allocate(geometry.second, pixels);
    for (Planes3* planes : {&geometry.position, &geometry.column_step, &geometry.row_step})
        planes->assign(pixels, 0.0F);
    for (Plane* plane : {&geometry.depth,
                         &geometry.coverage,
                         &geometry.lens_shift_min,
                         &geometry.samples_a,
                         &geometry.samples_b})
        plane->assign(pixels, 0.0F);
}

void allocate(LightLayer& light, std::size_t pixels) {
    light.slope_min.assign(pixels, -1.0F);
    light.occluded.assign(pixels, 0.0F);
    if (light.merged)
        light.merged_width.assign(pixels, 0.0F);
    light.unshadowed_first.assign(pixels, 0.0F);
    light.unshadowed_second.assign(pixels, 0.0F);
    light.visible_a.assign(pixels, 1.0F);
    light.visible_b.assign(pixels, 1.0F);
}

void allocate(IndirectLayer& indirect, std::size_t pixels) {
    indirect.a.assign(pixels, 0.0F);
    indirect.b.assign(pixels, 0.0F);
    indirect.z_min.assign(pixels, std::numeric_limits<float>::infinity());
    indirect.variance.assign(pixels, -1.0F);
}

} // namespace

PixelBuffers make_pixel_buffers(PictureSize size, std::vector<LightLayer> lights) {
    PixelBuffers buffers;
    buffers.size = size;
    buffers.lights = std::move(lights);
    allocate(buffers.geometry, size.pixels());
    for_each_index(buffers.lights.size(), 1, [&](std::size_t k) {
        allocate(buffers.lights[k], size.pixels());
    });
    allocate(buffers.indirect, size.pixels());
    buffers.remainder_a.assign(size.pixels(), 0.0F);
    buffers.remainder_b.assign(size.pixels(), 0.0F);
    return buffers;
}

std::size_t bytes_a_pixel(const PixelBuffers& buffers) noexcept {
    constexpr std::size_t surface = 1 + 3 + 2 * 3;
    constexpr std::size_t geometry = 2 * surface + 3 * 3 + 5;
    constexpr std::size_t indirect = 2 * 3 + 2;
    constexpr std::size_t remainder = 2 * 3;
    std::size_t floats = geometry + indirect + remainder;
    for (const LightLayer& light : buffers.lights)
        floats += light.merged ? 7 : 6;
    return floats * sizeof(float);
}

} // namespace isolux
