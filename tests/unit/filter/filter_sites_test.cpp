#include <algorithm>

#include <gtest/gtest.h>

#include "isolux/filter/filter_sites.h"
#include "isolux/filter/gaussian_filter.h"

#include "support/filter_scene.h"

namespace isolux::test {
namespace {

/// One pixel in the middle of a fully lit floor looks dark by chance.
PixelBuffers floor_with_a_speck() {
    PixelBuffers buffers = make_floor_buffers({21, 21}, 0.01, {make_light(0.2, 2.0)});
    buffers.lights[0].visible_a[220] = -2.0F;
    return buffers;
}

double filtered_speck(const FilterSettings& settings) {
    const PixelBuffers buffers = floor_with_a_speck();
    const LightLayer& light = buffers.lights[0];
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, light, settings);
    return filter_halves(sites, {light.visible_a, light.visible_b}, 20).a[220];
}

TEST(FilterSites, CopyWhatIsFullyLitButInPreviews) {
    EXPECT_EQ(filtered_speck(picture_filter()), -2.0);
    // The middle of a Gaussian of 1.5 pixels weighs 1/(2 pi 1.5^2).
    EXPECT_NEAR(filtered_speck(preview_filter()), 1.0 - 3.0 * 0.0707, 0.01);
}

TEST(FilterSites, HaveFloorsThatGoDownWithTheNoise) {
    EXPECT_LT(filtered_speck(preview_filter(8.0)), filtered_speck(preview_filter(2.0)));
    EXPECT_DOUBLE_EQ(preview_filter(8.0).floor_pixels, 2.5);
    EXPECT_DOUBLE_EQ(preview_filter(200.0).floor_pixels, picture_filter().floor_pixels);
}

TEST(FilterSites, TakePixelsOfOneHalfInPreviewsOnly) {
    PixelBuffers buffers = make_floor_buffers({5, 5}, 0.01);
    buffers.geometry.samples_b[12] = 0.0F;
    const auto is_site = [&](const FilterSettings& settings) {
        return make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, settings)
                   .object[12]
               != 0;
    };
    EXPECT_FALSE(is_site(picture_filter()));
    EXPECT_TRUE(is_site(preview_filter()));
}

TEST(FilterSites, LookFartherForDistancesWhereThePilotLookedInFewPixels) {
    PixelBuffers buffers = make_floor_buffers({21, 1}, 0.001);
    std::fill(buffers.indirect.z_min.begin(), buffers.indirect.z_min.end(), 2.0F);
    buffers.indirect.z_min[10] = 0.5F;
    const auto width = [&](FilterSettings settings, std::size_t i) {
        settings.floor_pixels = 0.0;
        return make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, settings)
            .columns[i];
    };
    FilterSettings sparse = picture_filter();
    sparse.pilot_step = 2;
    EXPECT_LT(width(picture_filter(), 8), width(picture_filter(), 7));
    EXPECT_LT(width(sparse, 6), width(sparse, 5));
    EXPECT_EQ(width(sparse, 6), width(sparse, 10));
}

/// Along columns as along rows: a picture turned by a quarter is filtered to the turned
/// picture.
TEST(GaussianFilter, TreatsRowsAndColumnsAlike) {
    const PictureSize size{17, 17};
    FilterSites sites;
    sites.size = size;
    sites.position.assign(size.pixels(), 0.0F);
    sites.normal.assign(size.pixels(), 0.0F);
    sites.object.assign(size.pixels(), 1);
    sites.narrowness.assign(size.pixels(), 1.0F);
    sites.columns.assign(size.pixels(), 2.0F);
    sites.rows.assign(size.pixels(), 2.0F);
    Plane spot(size.pixels(), 0.0F);
    for (std::size_t i = 0; i < size.pixels(); ++i) {
        sites.position.x[i] = 0.5F * static_cast<float>(i % 17);
        sites.position.y[i] = 0.5F * static_cast<float>(i / 17);
        sites.normal.z[i] = 1.0F;
    }
    spot[3 + 17 * 1] = 1.0F; // next to the upper edge, so that the ends count
    const Plane out = filter_halves(sites, {spot, spot}, 20).a;
    Plane turned(size.pixels(), 0.0F);
    turned[1 + 17 * 3] = 1.0F;
    const Plane out_turned = filter_halves(sites, {turned, turned}, 20).a;
    for (std::size_t y = 0; y < 17; ++y)
        for (std::size_t x = 0; x < 17; ++x)
            ASSERT_NEAR(out[x + 17 * y], out_turned[y + 17 * x], 1e-6) << x << ' ' << y;
    EXPECT_GT(out[3 + 17 * 2], 0.01F);
    EXPECT_GT(out[4 + 17 * 1], 0.01F);
}

} // namespace
} // namespace isolux::test
