#include <cmath>

#include <gtest/gtest.h>

#include "isolux/calc/bench_rooms.h"
#include "isolux/calc/calculate.h"

#include "support/test_scene.h"

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

/// A gap of 6 cm between a bright wall and a pane of glass, over a floor that mirrors, and a
/// mirror beside it: flights of eq. (122) pass through panes, and those by way of a mirror are
/// not among them.
Scene gap_behind_glass() {
    test::Builder b;
    const MaterialId floor =
        b.add_material({"polished", Opaque{Rgb::grey(0.25), 0.5}, Sides::both});
    const MaterialId bright = b.add_diffuse(0.8);
    const MaterialId glass = b.add_material({"glass", ClearPane{}, Sides::both});
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.05), 0.85}, Sides::both});
    b.add_room({0, 0, 0}, {3, 2.5, 2.4}, floor, b.add_diffuse(0.7), bright);
    b.add_quad({0.5, 0.06, 0.0}, {1.5, 0, 0}, {0, 0, 1.2}, glass);
    b.add_quad({0.5, 0.0, 0.0}, {0, 0.06, 0}, {0, 0, 1.2}, mirror);
    b.add_panel({1.2, 1.0, 2.35}, {0, 0.6, 0}, {0.6, 0, 0}, 3000.0);
    return b.build();
}

TEST(Corners, WithPanesAndMirrorsAreThoseOfPathTracing) {
    const Scene scene = gap_behind_glass();
    BenchRoom room;
    room.surfaces.resize(1);
    for (const double x : {0.53, 0.7, 1.3, 1.97}) {
        auto& r = room.surfaces[0].receivers;
        r.push_back({{x, 0.03, 0.01}, UnitVector3({0, 0, 1})}); // in the gap, over the floor
        r.push_back({{x, 0.0, 0.02}, UnitVector3({0, 1, 0})});  // on the wall behind the glass
        r.push_back({{x, 0.09, 0.02}, UnitVector3({0, 0, 1})}); // before the glass
    }
    const Results corners = run(scene, room, Estimator::automatic, 16);
    EXPECT_NE(corners.estimator.find("path tracing (0 points)"), std::string::npos)
        << corners.estimator;
    const Results traced = run(scene, room, Estimator::path_tracing, 64);
    double shared = 0.0;
    for (std::size_t p = 0; p < room.surfaces[0].receivers.size(); ++p) {
        const Estimate& a = corners.surfaces[0].points[p].indirect;
        const Estimate& b = traced.surfaces[0].points[p].indirect;
        const double error = std::hypot(a.standard_error, b.standard_error);
        EXPECT_LT(std::abs(a.mean - b.mean), z_limit * error) << p;
        EXPECT_LT(error, 0.03 * b.mean) << p;
        shared += (a.mean - b.mean) / b.mean / 12.0;
    }
    EXPECT_LT(std::abs(shared), 0.01);
}

} // namespace
} // namespace isolux
