#include <cmath>

#include <gtest/gtest.h>

#include "isolux/filter/pixel_buffers.h"

namespace isolux {
namespace {

std::size_t floats(const Planes3& p) { return p.x.size() + p.y.size() + p.z.size(); }

std::size_t floats(const PixelSurface& s) {
    return s.object.size() + floats(s.normal) + floats(s.reflected_a) + floats(s.reflected_b);
}

std::size_t floats(const PixelGeometry& g) {
    return floats(g.first) + floats(g.second) + floats(g.position) + floats(g.column_step)
           + floats(g.row_step) + g.depth.size() + g.coverage.size() + g.lens_shift_min.size()
           + g.samples_a.size() + g.samples_b.size();
}

std::size_t floats(const LightLayer& l) {
    return l.slope_min.size() + l.occluded.size() + l.merged_width.size()
           + l.unshadowed_first.size() + l.unshadowed_second.size() + l.visible_a.size()
           + l.visible_b.size();
}

std::size_t floats(const PixelBuffers& b) {
    std::size_t sum = floats(b.geometry) + floats(b.indirect.a) + floats(b.indirect.b)
                      + b.indirect.z_min.size() + b.indirect.variance.size()
                      + floats(b.remainder_a) + floats(b.remainder_b);
    for (const LightLayer& light : b.lights)
        sum += floats(light);
    return sum;
}

TEST(PixelBuffers, TakeAsManyBytesAPixelAsTheySay) {
    std::vector<LightLayer> lights(3);
    lights[2].merged = true;
    const PixelBuffers buffers = make_pixel_buffers({7, 5}, std::move(lights));
    EXPECT_EQ(bytes_a_pixel(buffers) * 35, 4 * floats(buffers));
    EXPECT_EQ(bytes_a_pixel(buffers), 192U + 24U + 24U + 28U);
}

TEST(PixelBuffers, StartWithNothingSeenAndNothingShaded) {
    const PixelBuffers buffers = make_pixel_buffers({2, 1}, std::vector<LightLayer>(1));
    EXPECT_EQ(buffers.geometry.first.object[1], 0U);
    EXPECT_LT(buffers.lights[0].slope_min[1], 0.0F);
    EXPECT_EQ(buffers.lights[0].visible_b[1], 1.0F);
    EXPECT_TRUE(std::isinf(buffers.indirect.z_min[0]));
}

} // namespace
} // namespace isolux
