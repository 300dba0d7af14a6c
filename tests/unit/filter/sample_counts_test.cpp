#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "isolux/filter/pilot_smoothing.h"
#include "isolux/filter/sample_counts.h"

#include "support/filter_scene.h"

namespace isolux::test {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Left third lit, right third penumbra of half visibility, in between shadow.
PixelBuffers three_strips() {
    PixelBuffers buffers = make_floor_buffers({60, 30}, 0.01, {make_light(0.2, 2.0)});
    LightLayer& light = buffers.lights[0];
    for (std::size_t i = 0; i < buffers.size.pixels(); ++i) {
        const std::size_t x = i % 60;
        light.unshadowed_first[i] = 100.0F;
        light.occluded[i] = x < 20 ? 0.1F : x < 40 ? 0.9F : 0.5F;
        light.slope_min[i] = x < 20 ? -1.0F : 1.0F;
    }
    return buffers;
}

std::vector<std::uint16_t> error_counts(const PixelBuffers& buffers, double wanted) {
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, buffers.lights[0], picture_filter());
    return counts_for_error(
        shadow_need(buffers.geometry, buffers.lights[0], sites), wanted, 2, 1000);
}

TEST(SampleCounts, LeaveTheFilterItsShareOfTheNoise) {
    EXPECT_DOUBLE_EQ(variance_left(2.0, 3.0), 1.0 / (24.0 * pi));
    EXPECT_EQ(variance_left(0.1, 0.1), 1.0);
}

TEST(SampleCounts, FollowTheVarianceOfThePilot) {
    const PixelBuffers buffers = three_strips();
    const auto counts = error_counts(buffers, 1.0);
    const std::size_t row = 15 * 60;
    EXPECT_EQ(counts[row + 5], 2) << "fully lit";
    const double beta = 0.2 / 6.0 / 0.01; // pixels
    const double left = 1.0 / (4.0 * pi * beta * beta);
    EXPECT_NEAR(counts[row + 50], 1e4 * 0.25 * left, 1.0);
    EXPECT_NEAR(counts[row + 33], 1e4 * 0.09 * left, 1.0);
    EXPECT_EQ(counts[row + 50] % 2, 0) << "two halves";
    EXPECT_EQ(error_counts(buffers, 1e-3)[row + 50], 1000);
}

TEST(SampleCounts, KeepToTheirBudget) {
    const PixelBuffers buffers = three_strips();
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, buffers.lights[0], picture_filter());
    const Plane e(buffers.size.pixels(), 50.0F);
    const auto counts =
        counts_for_budget(shadow_need(buffers.geometry, buffers.lights[0], sites), e, 16.0);
    const double mean =
        std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
    EXPECT_NEAR(mean, 16.0, 0.5);
    EXPECT_EQ(*std::min_element(counts.begin(), counts.end()), 2);
    EXPECT_GT(counts[15 * 60 + 50], counts[15 * 60 + 33]);
}

TEST(SampleCounts, DoNotForgetEdgesOfSurfaces) {
    PixelBuffers buffers = three_strips();
    buffers.geometry.coverage[15 * 60 + 8] = 0.7F;
    const FilterSites sites =
        make_shadow_sites(buffers.geometry, buffers.size, buffers.lights[0], picture_filter());
    const Plane e(buffers.size.pixels(), 50.0F);
    const auto counts =
        counts_for_budget(shadow_need(buffers.geometry, buffers.lights[0], sites), e, 16.0);
    EXPECT_GT(counts[15 * 60 + 8], 4);
    EXPECT_EQ(counts[15 * 60 + 12], 2);
}

TEST(SampleCounts, OfReflectedLightAverageThePilotOverNeighbours) {
    PixelBuffers buffers = make_floor_buffers({30, 30}, 0.01);
    std::fill(buffers.indirect.z_min.begin(), buffers.indirect.z_min.end(), 1.0F);
    std::fill(buffers.indirect.variance.begin(), buffers.indirect.variance.end(), 0.0F);
    buffers.indirect.variance[15 * 30 + 15] = 81.0F; // one rare bright sample
    const FilterSites sites =
        make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, picture_filter());
    const SampleNeed need = indirect_need(buffers.geometry, buffers.indirect, sites);
    EXPECT_FLOAT_EQ(need.variance[15 * 30 + 15], 1.0F);
    EXPECT_FLOAT_EQ(need.variance[11 * 30 + 19], 1.0F);
    EXPECT_EQ(need.variance[10 * 30 + 15], 0.0F);
}

TEST(SampleCounts, TakeTheMeanOfTheOthersWhereThePilotKnowsNothing) {
    PixelBuffers buffers = make_floor_buffers({30, 30}, 0.01);
    std::fill(buffers.indirect.z_min.begin(), buffers.indirect.z_min.end(), 1.0F);
    std::fill(buffers.indirect.variance.begin(), buffers.indirect.variance.end(), -1.0F);
    buffers.indirect.variance[3 * 30 + 3] = 2.0F;
    buffers.indirect.variance[3 * 30 + 20] = 4.0F;
    const FilterSites sites =
        make_indirect_sites(buffers.geometry, buffers.size, buffers.indirect, picture_filter());
    const SampleNeed need = indirect_need(buffers.geometry, buffers.indirect, sites);
    EXPECT_FLOAT_EQ(need.variance[3 * 30 + 5], 2.0F) << "its neighbour's alone";
    EXPECT_FLOAT_EQ(need.variance[3 * 30 + 20], 4.0F);
    EXPECT_NEAR(need.variance[25 * 30 + 10], 3.0, 0.3) << "no neighbour knows";
}

TEST(SampleCounts, OfSeveralLayersAddUpWhatTheFilterLeaves) {
    SampleNeed shadow{{4.0F, 9.0F}, {0.5F, 1.0F}, {false, true}, {false, false}};
    SampleNeed reflected{{1.0F, 2.0F}, {0.25F, 0.5F}, {false, true}, {true, false}};
    SampleNeed total;
    add_need(total, shadow);
    add_need(total, reflected);
    EXPECT_FLOAT_EQ(total.variance[0] * total.left[0], 2.25F);
    EXPECT_EQ(total.variance[1], 0.0F) << "settled in both";
    EXPECT_FALSE(total.settled[0]);
    EXPECT_TRUE(total.settled[1]);
    EXPECT_TRUE(total.edge[0]);
    EXPECT_FALSE(total.edge[1]);
}

TEST(SampleCounts, AreMultiplesOfTheReplicates) {
    SampleNeed need;
    for (int i = 0; i < 100; ++i)
        need.variance.push_back(static_cast<float>(i));
    need.left.assign(100, 1.0F);
    need.settled.assign(100, false);
    need.edge.assign(100, false);
    const auto counts = counts_for_budget(need, Plane(100, 10.0F), 16.0, 8, 32, 4);
    for (const std::uint16_t n : counts) {
        EXPECT_EQ(n % 4, 0);
        EXPECT_GE(n, 8);
        EXPECT_LE(n, 32);
    }
    EXPECT_LT(counts[1], counts[90]);
    const double mean = std::accumulate(counts.begin(), counts.end(), 0.0) / 100.0;
    EXPECT_LE(mean, 16.0);
    EXPECT_GT(mean, 14.0);
}

TEST(PilotSmoothing, FillsSlopesFromTheSameObjectWithinFivePixels) {
    const PictureSize size{12, 1};
    std::vector<std::uint32_t> object(12, 1);
    object[0] = 2;
    Plane low(12, -1.0F);
    low[1] = 0.5F;
    low[3] = 0.25F;
    fill_slopes(size, object, low);
    EXPECT_EQ(low[0], -1.0F) << "another object";
    EXPECT_EQ(low[1], 0.5F) << "what was measured stays";
    EXPECT_EQ(low[5], 0.25F);
    EXPECT_EQ(low[8], 0.25F);
    EXPECT_EQ(low[9], -1.0F);
}

} // namespace
} // namespace isolux::test
