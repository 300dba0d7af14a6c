#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"
#include "isolux/calc/bench_rooms.h"
#include "isolux/calc/calculate.h"
#include "isolux/io/csv.h"
#include "isolux/io/results_json.h"

#include "support/test_scene.h"

/// The same bits for any number of threads: what users get, results.json and CSV, compared as
/// text.
namespace isolux {
namespace {

/// A room with a panel, a point luminaire, a pane and a mirror: every kind of ray is traced.
Scene make_room() {
    test::Builder b;
    const MaterialId floor = b.add_diffuse(0.3);
    const MaterialId ceiling = b.add_diffuse(0.8);
    const MaterialId walls = b.add_material({"paint", Opaque{{0.6, 0.5, 0.4}}, Sides::both});
    const MaterialId glass = b.add_material({"glass", ClearPane{}, Sides::both});
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.05), 0.85}, Sides::both});
    b.add_room({0, 0, 0}, {5, 4, 3}, floor, ceiling, walls);
    b.add_quad({2.5, 0.5, 0.2}, {0, 2, 0}, {0, 0, 2}, glass);
    b.add_quad({0.5, 0.01, 0.5}, {2, 0, 0}, {0, 0, 1.5}, mirror);
    b.add_panel({1, 1, 2.9}, {0, 0.6, 0}, {1.2, 0, 0}, 2500.0);
    b.add_point({4, 3, 2.5}, b.add_isotropic_type(800.0));
    return b.build();
}

/// More points than a tile holds, near and far from surfaces.
std::vector<CalculationSurface> make_surfaces() {
    const auto grid = [](std::string name, const Frame& f, GridCounts n, IlluminanceKind kind) {
        return make_grid_surface(
            std::move(name), f, Metre(4.9), Metre(3.9), n, {}, kind, UnitVector3{});
    };
    return {grid("plane", Frame{{0.05, 0.05, 0.75}}, {12, 9}, IlluminanceKind::planar),
            grid("cylinders", Frame{{0.05, 0.05, 1.6}}, {5, 4}, IlluminanceKind::cylindrical)};
}

struct Output {
    std::string json; ///< without the times
    std::string csv;
};

Output run(std::size_t threads, std::uint64_t seed) {
    const ThreadLimit limit(threads);
    Settings settings;
    settings.seed = seed;
    settings.tolerance = 0.1;
    const Scene scene = make_room();
    const std::vector<CalculationSurface> surfaces = make_surfaces();
    Results results = calculate(scene, surfaces, settings);
    results.wall_seconds = 0.0;
    results.cpu_seconds = 0.0;
    Output output;
    for (const SurfaceResult& s : results.surfaces)
        output.csv += to_csv(s, results.confidence);
    output.json =
        to_results_json(make_results_document(Project{}, settings, std::move(results)));
    return output;
}

TEST(Threads, OneTwoAndSevenGiveTheSameBytes) {
    const Output one = run(1, 3);
    for (const std::size_t threads : {2, 7}) {
        const Output many = run(threads, 3);
        EXPECT_TRUE(many.json == one.json) << threads << " threads";
        EXPECT_TRUE(many.csv == one.csv) << threads << " threads";
    }
}

TEST(Threads, AnotherSeedGivesOtherBytes) { EXPECT_NE(run(2, 3).csv, run(2, 4).csv); }

TEST(Threads, GiveTheSameBytesWithATreeOfVertices) {
    BenchRoom room = make_empty_bench_room(120, 100, 8, 6);
    const Scene scene = build_scene(std::move(room.scene));
    std::string one;
    for (const std::size_t threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        Settings settings;
        settings.seed = 5;
        settings.fixed_units = 1;
        const Results results = calculate(scene, room.surfaces, settings);
        ASSERT_NE(results.estimator.find("(in a tree)"), std::string::npos)
            << results.estimator;
        const std::string csv = to_csv(results.surfaces[0], results.confidence);
        if (threads == 1)
            one = csv;
        EXPECT_TRUE(csv == one) << threads << " threads";
    }
}

} // namespace
} // namespace isolux
