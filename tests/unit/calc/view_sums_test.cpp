#include <gtest/gtest.h>

#include "isolux/calc/view_sums.h"

namespace isolux::test {
namespace {

/// One pixel after two passes: one sample of half A on the majority surface, one of half B
/// somewhere else.
PixelBuffers half_a_pixel() {
    PixelBuffers buffers = make_pixel_buffers({1, 1}, std::vector<LightLayer>(1));
    buffers.geometry.first.object[0] = 1;
    buffers.geometry.samples_a[0] = 1.0F;
    buffers.geometry.first.reflected_a.set(0, Rgb::grey(0.2));
    buffers.indirect.a.set(0, Rgb{100.0, 200.0, 300.0});
    buffers.lights[0].unshadowed_first[0] = 50.0F;
    buffers.lights[0].visible_a[0] = 0.25F;
    buffers.lights[0].visible_b[0] = 0.0F;
    return buffers;
}

PictureSums two_passes() {
    PictureSums sums(1);
    sums.passes[0] = 2;
    return sums;
}

TEST(PictureSums, LetAHalfWithoutASampleTakeTheOthersValues) {
    PixelBuffers buffers = half_a_pixel();
    two_passes().divide(buffers);
    EXPECT_EQ(buffers.indirect.b.y[0], 200.0F);
    EXPECT_EQ(buffers.lights[0].visible_b[0], 0.25F);
    // Its share of the pixel stays none: what the surface reflects is no noisy quantity.
    EXPECT_EQ(buffers.geometry.first.reflected_b.x[0], 0.0F);
    EXPECT_EQ(buffers.geometry.samples_b[0], 0.0F);
}

TEST(PictureSums, CallALightFullyVisibleThatSendsNothing) {
    PixelBuffers buffers = half_a_pixel();
    buffers.lights[0].unshadowed_first[0] = 0.0F;
    two_passes().divide(buffers);
    EXPECT_EQ(buffers.lights[0].visible_a[0], 1.0F);
    EXPECT_EQ(buffers.lights[0].visible_b[0], 1.0F);
}

TEST(PictureSums, KeepBothHalvesWhereBothHaveSamples) {
    PixelBuffers buffers = half_a_pixel();
    buffers.geometry.samples_b[0] = 1.0F;
    buffers.indirect.b.set(0, Rgb::grey(50.0));
    two_passes().divide(buffers);
    EXPECT_EQ(buffers.indirect.a.y[0], 200.0F);
    EXPECT_EQ(buffers.indirect.b.y[0], 50.0F);
    EXPECT_EQ(buffers.lights[0].visible_b[0], 0.0F);
}

} // namespace
} // namespace isolux::test
