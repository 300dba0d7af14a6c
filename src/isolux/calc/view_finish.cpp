#include "isolux/calc/view_finish.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "isolux/base/parallel.h"
#include "isolux/calc/view_sums.h"
#include "isolux/filter/axis_aligned.h"

namespace isolux {

namespace {

constexpr std::size_t grain = 4096; ///< pixels

} // namespace

void filter_along_surfaces(const PixelBuffers& buffers, ViewPicture& picture) {
    const std::size_t n = picture.size.pixels();
    double passes = 0.0;
    for (const float s : picture.samples)
        passes += static_cast<double>(s);
    const double samples = std::max(1.0, passes / static_cast<double>(n));
    FilterSettings settings = picture.is_preview ? preview_filter(samples) : picture_filter();
    settings.samples = samples;
    FilteredPicture filtered = filter_picture(buffers, settings);
    picture.filtered = std::move(filtered.colour);
    picture.filtered_error = std::move(filtered.standard_error);
    picture.filter_width = std::move(filtered.width_indirect);
    picture.filter = "axis-aligned";
    // What reaches the eye over what the surface reflects of it.
    const PixelGeometry& g = buffers.geometry;
    picture.filtered_illuminance.assign(n, 0.0F);
    for_each_index(n, grain, [&](std::size_t i) {
        const Rgb reflected = g.first.reflected_a.colour(i) + g.first.reflected_b.colour(i)
                              + g.second.reflected_a.colour(i) + g.second.reflected_b.colour(i);
        const double share = 0.5 * luminance_sum(reflected);
        if (share > 0.0)
            picture.filtered_illuminance[i] = static_cast<float>(
                luminance_sum(filtered.direct.colour(i) + filtered.indirect.colour(i)) / share);
    });
}

void take_geometry(const Scene& scene, PixelBuffers& buffers, ViewPicture& picture) {
    PixelGeometry& g = buffers.geometry;
    picture.normal = std::move(g.first.normal);
    picture.position = std::move(g.position);
    picture.depth = std::move(g.depth);
    picture.object = std::move(g.first.object);
    for_each_index(picture.size.pixels(), grain, [&](std::size_t i) {
        if (picture.object[i] == 0)
            return;
        picture.position.x[i] += static_cast<float>(g.origin.x);
        picture.position.y[i] += static_cast<float>(g.origin.y);
        picture.position.z[i] += static_cast<float>(g.origin.z);
    });
    for (const Surface& s : scene.surfaces)
        picture.object_names.push_back(s.name);
}

std::size_t bytes_held(const PixelBuffers& buffers) noexcept {
    constexpr std::size_t sums = 4 * 3 + 1 + picture_replicates; // floats
    constexpr std::size_t results = 3 + 1 + 1 + 3 + 3;           // indirect, ..., filtered
    return bytes_a_pixel(buffers) + (sums + results) * sizeof(float) + sizeof(std::uint16_t)
           + sizeof(std::uint32_t) + 1 + sizeof(float) + 3; // the plan of samples
}

} // namespace isolux
