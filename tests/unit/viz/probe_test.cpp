#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/viz/probe.h"

#include "unit/viz/example_results.h"

namespace isolux {
namespace {

using namespace examples;
using testing::HasSubstr;

/// A floor of 2 x 1 points 1 m apart and a table above its first point.
Results floor_and_table() {
    Results r;
    r.confidence = 0.95;
    r.surfaces = {make_result("floor",
                              frame_at(0, 0, 0),
                              2,
                              1,
                              {2, 1},
                              [](double u, double) { return u < 1.0 ? 100.0 : 200.0; }),
                  make_result("table", frame_at(0, 0, 0.75), 1, 1, {1, 1}, [](double, double) {
                      return 512.3;
                  })};
    return r;
}

TEST(Probe, FindsTheNearestPointOfAllSurfaces) {
    const Results r = floor_and_table();
    const auto near_floor = find_nearest_point(r, {1.4, 0.5, 0.0});
    ASSERT_TRUE(near_floor.has_value());
    EXPECT_EQ(near_floor->surface, 0U);
    EXPECT_EQ(near_floor->point, 1U);
    EXPECT_NEAR(near_floor->distance, 0.1, 1e-12);
    const auto near_table = find_nearest_point(r, {0.5, 0.5, 0.7});
    ASSERT_TRUE(near_table.has_value());
    EXPECT_EQ(near_table->surface, 1U);
    EXPECT_EQ(near_table->point, 0U);
    EXPECT_NEAR(near_table->distance, 0.05, 1e-12);
}

TEST(Probe, StaysOnTheSurfaceThatIsAsked) {
    const auto probed = find_nearest_point(floor_and_table(), {0.5, 0.5, 0.75}, 0);
    ASSERT_TRUE(probed.has_value());
    EXPECT_EQ(probed->surface, 0U);
    EXPECT_EQ(probed->point, 0U);
    EXPECT_NEAR(probed->distance, 0.75, 1e-12);
}

TEST(Probe, TakesTheFirstOfEquallyNearPoints) {
    const auto probed = find_nearest_point(floor_and_table(), {1.0, 0.5, 0.0}, 0);
    ASSERT_TRUE(probed.has_value());
    EXPECT_EQ(probed->point, 0U);
}

TEST(Probe, FindsNothingWhereThereIsNoPoint) {
    EXPECT_FALSE(find_nearest_point(Results{}, {0, 0, 0}));
    EXPECT_FALSE(find_nearest_point(floor_and_table(), {0, 0, 0}, 2));
    Results empty = floor_and_table();
    empty.surfaces[0].surface.receivers.clear();
    EXPECT_FALSE(find_nearest_point(empty, {0, 0, 0}, 0));
    EXPECT_EQ(find_nearest_point(empty, {0, 0, 0})->surface, 1U);
}

TEST(Probe, DescribesPlaceValueIntervalAndParts) {
    const Results r = floor_and_table();
    const std::string text = describe_point(r, {0, 1, 0.1});
    // 200 +- 0.8 lx from 32 replicates: t(31, 95 %) = 2.0395, half width 1.63
    EXPECT_EQ(text,
              "floor: point 2 at (1.500, 0.500, 0.000) m, 0.100 m away\n"
              "E = 200 lx, 95 % interval [198, 202] lx\n"
              "direct 140 lx, indirect 60.0 lx\n");
}

TEST(Probe, TellsTheConfidenceOfTheResults) {
    Results r = floor_and_table();
    r.confidence = 0.999;
    EXPECT_THAT(describe_point(r, {1, 0, 0.0}), HasSubstr("E = 512 lx, 99.9 % interval ["));
}

} // namespace
} // namespace isolux
