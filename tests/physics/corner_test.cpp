#include <cmath>

#include <gtest/gtest.h>

#include "isolux/calc/bench_rooms.h"
#include "isolux/calc/calculate.h"

/// METHODS "Edges": points a few centimetres from walls, where the pilot and eq. (33) choose
/// the estimator, against path tracing alone.
namespace isolux {
namespace {

constexpr double z_limit = 7.0; // METHODS 7.1

Results run(const Scene& scene, const BenchRoom& room, Estimator estimator, std::size_t units) {
    Settings settings;
    settings.estimator = estimator;
    settings.fixed_units = units;
    settings.seed = 11;
    return calculate(scene, room.surfaces, settings);
}

TEST(Corners, MeanNextToAWallIsThatOfPathTracing) {
    BenchRoom room = make_bench_room("near-walls");
    // In the corner of wall and floor, 5 mm above it.
    for (Receiver& r : room.surfaces[0].receivers)
        r.point.z = 0.005;
    const Scene scene = build_scene(std::move(room.scene));
    const Results corners = run(scene, room, Estimator::automatic, 8);
    const Estimate mixed = corners.surfaces[0].summary.mean;
    // or the test would compare path tracing with itself
    EXPECT_NE(corners.estimator.find("path tracing (0 points)"), std::string::npos)
        << corners.estimator;
    const Estimate traced =
        run(scene, room, Estimator::path_tracing, 16).surfaces[0].summary.mean;
    const double error = std::hypot(mixed.standard_error, traced.standard_error);
    EXPECT_LT(std::abs(mixed.mean - traced.mean), z_limit * error);
    EXPECT_LT(error, 0.005 * traced.mean); // or the test could not see a bias
}

} // namespace
} // namespace isolux
