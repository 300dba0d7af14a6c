#include "isolux/filter/axis_aligned.h"

#include <array>
#include <cmath>

#include "isolux/base/parallel.h"
#include "isolux/filter/filter_sites.h"
#include "isolux/filter/gaussian_filter.h"
#include "isolux/filter/layer_filter.h"
#include "isolux/filter/lens_filter.h"
#include "isolux/filter/recompose.h"
#include "isolux/filter/verify.h"

namespace isolux {
namespace {

constexpr std::size_t grain = 2048;

void add(Planes3& planes, std::size_t i, const Rgb& c) noexcept {
    planes.x[i] += static_cast<float>(c.r);
    planes.y[i] += static_cast<float>(c.g);
    planes.z[i] += static_cast<float>(c.b);
}

float geometric_mean(float a, float b) noexcept { return std::sqrt(a * b); }

/// What both surfaces of a pixel make of a layer: final values, then raw and
/// filtered halves.
struct OnSurfaces {
    std::array<float, 7> first{};
    std::array<float, 7> second{};
};

/// @param with_second  the second surface shows something of the layer
OnSurfaces read_layer(const PixelBuffers& buffers,
                      std::size_t i,
                      bool with_second,
                      const std::array<const Plane*, 7>& planes) {
    OnSurfaces values;
    for (std::size_t c = 0; c < planes.size(); ++c)
        values.first[c] = (*planes[c])[i];
    values.second = values.first;
    if (with_second && buffers.geometry.second.object[i] != 0)
        read_second_surface(buffers.geometry, buffers.size, i, planes, values.second);
    return values;
}

/// Adds a layer to a picture and to the luminances by which the filter is
/// verified.
/// @param final      three channels
/// @param unshadowed lx on first and second surface; null: the layer holds
/// illuminances
void recompose(const PixelBuffers& buffers,
               const std::array<const Plane*, 3>& final,
               const Halves& raw,
               const Halves& fixed,
               const LightLayer* light,
               Planes3& picture,
               VerifiedHalves& halves) {
    const std::array<const Plane*, 7> planes{
        final[0], final[1], final[2], &raw.a, &raw.b, &fixed.a, &fixed.b};
    const PixelGeometry& g = buffers.geometry;
    for_each_index(buffers.size.pixels(), grain, [&](std::size_t i) {
        if (g.first.object[i] == 0 && g.second.object[i] == 0)
            return;
        const double e1 = light != nullptr ? light->unshadowed_first[i] : 1.0;
        const double e2 = light != nullptr ? light->unshadowed_second[i] : 1.0;
        if (e1 == 0.0 && e2 == 0.0)
            return;
        const Rgb tint = light != nullptr ? light->colour : Rgb::grey(1.0);
        const auto pair = [&](const PixelSurface& surface, double e) {
            return std::array{e * (tint * surface.reflected_a.colour(i)),
                              e * (tint * surface.reflected_b.colour(i))};
        };
        const auto k1 = pair(g.first, e1);
        const auto k2 = pair(g.second, e2);
        const bool with_second = luminance_sum(k2[0]) + luminance_sum(k2[1]) > 0.0;
        const OnSurfaces v = read_layer(buffers, i, with_second, planes);
        add(picture,
            i,
            0.5
                * ((k1[0] + k1[1]) * Rgb{v.first[0], v.first[1], v.first[2]}
                   + (k2[0] + k2[1]) * Rgb{v.second[0], v.second[1], v.second[2]}));
        const auto luminance = [&](std::size_t half, std::size_t c) {
            return static_cast<float>(luminance_sum(k1[half]) * v.first[c]
                                      + luminance_sum(k2[half]) * v.second[c]);
        };
        halves.raw.a[i] += luminance(0, 3);
        halves.raw.b[i] += luminance(1, 4);
        halves.filtered.a[i] += luminance(0, 5);
        halves.filtered.b[i] += luminance(1, 6);
    });
}

void add_light(const PixelBuffers& buffers,
               const LightLayer& light,
               const FilterSettings& settings,
               FilteredPicture& picture,
               VerifiedHalves& halves,
               Plane& strongest) {
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, light, settings);
    const Halves raw{light.visible_a, light.visible_b};
    const FilteredLayer layer = filter_layer(sites, raw, settings, false);
    recompose(buffers,
              {&layer.mean, &layer.mean, &layer.mean},
              raw,
              layer.fixed,
              &light,
              picture.direct,
              halves);
    for_each_index(buffers.size.pixels(), grain, [&](std::size_t i) {
        if (light.unshadowed_first[i] <= strongest[i])
            return;
        strongest[i] = light.unshadowed_first[i];
        picture.width_shadow[i] =
            layer.scale[i] * geometric_mean(sites.columns[i], sites.rows[i]);
    });
}

void add_indirect(const PixelBuffers& buffers,
                  const FilterSettings& settings,
                  FilteredPicture& picture,
                  VerifiedHalves& halves) {
    const FilterSites sites =
        make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, settings);
    const FilteredIndirect layer = filter_indirect(sites, buffers.indirect, settings);
    recompose(buffers,
              {&layer.colour.x, &layer.colour.y, &layer.colour.z},
              layer.raw,
              layer.fixed,
              nullptr,
              picture.indirect,
              halves);
    for_each_index(buffers.size.pixels(), grain, [&](std::size_t i) {
        picture.width_indirect[i] =
            layer.scale[i] * geometric_mean(sites.columns[i], sites.rows[i]);
    });
}

} // namespace

FilteredPicture filter_picture(const PixelBuffers& buffers, const FilterSettings& settings) {
    const std::size_t pixels = buffers.size.pixels();
    FilteredPicture picture;
    picture.size = buffers.size;
    picture.direct.assign(pixels, 0.0F);
    picture.indirect.assign(pixels, 0.0F);
    picture.width_indirect.assign(pixels, 0.0F);
    picture.width_shadow.assign(pixels, 0.0F);
    VerifiedHalves halves(pixels);
    Plane strongest(pixels, 0.0F);
    for (const LightLayer& light : buffers.lights)
        add_light(buffers, light, settings, picture, halves, strongest);
    add_indirect(buffers, settings, picture, halves);
    finish_picture(buffers, settings, halves, picture);
    return picture;
}

} // namespace isolux
