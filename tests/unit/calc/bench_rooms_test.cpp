#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "isolux/calc/bench_rooms.h"
#include "isolux/calc/calculate.h"
#include "isolux/calc/engine.h"

namespace isolux {
namespace {

std::size_t points_of(const BenchRoom& room) {
    std::size_t points = 0;
    for (const CalculationSurface& s : room.surfaces)
        points += s.receivers.size();
    return points;
}

TEST(BenchRooms, HaveThePointsAndLuminairesTheyPromise) {
    struct Size {
        std::size_t points, luminaires;
    };

    const std::map<std::string_view, Size> promised{{"empty-room", {96, 4}},
                                                    {"corridor", {140, 1}},
                                                    {"large-office", {2330, 24}},
                                                    {"many-points", {24000, 4}},
                                                    {"many-luminaires", {96, 200}},
                                                    {"plain-office", {300, 12}},
                                                    {"furnished-office", {300, 6}},
                                                    {"near-walls", {40, 6}},
                                                    {"doorway", {100, 2}}};
    ASSERT_EQ(bench_room_names().size(), promised.size());
    for (const std::string_view name : bench_room_names()) {
        const BenchRoom room = make_bench_room(name);
        EXPECT_EQ(points_of(room), promised.at(name).points) << name;
        EXPECT_EQ(room.scene.luminaires.size(), promised.at(name).luminaires) << name;
    }
}

TEST(BenchRooms, HaveNothingToComplainAboutInTheirScenes) {
    for (const std::string_view name : bench_room_names()) {
        const auto findings = inspect_scene(make_bench_room(name).scene);
        EXPECT_TRUE(findings.empty())
            << name << ": " << (findings.empty() ? "" : findings.front().what);
    }
}

TEST(BenchRooms, PutTheirPointsInFreeAir) {
    for (const std::string_view name : bench_room_names()) {
        BenchRoom room = make_bench_room(name);
        const std::vector<Room> shells = room.scene.rooms;
        const Scene scene = build_scene(std::move(room.scene));
        for (const CalculationSurface& s : room.surfaces)
            for (const Receiver& r : s.receivers) {
                EXPECT_TRUE(std::any_of(shells.begin(), shells.end(), [&](const Room& shell) {
                    return contains(shell, r.point);
                })) << name;
                ASSERT_GT(scene.caster.find_nearest_surfaces(r.point, 1.0).nearest, 1e-3)
                    << name;
            }
    }
}

TEST(BenchRooms, TheLargeOfficeHasItsBoxes) {
    EXPECT_EQ(make_bench_room("large-office").scene.objects.size(), 113U);
}

TEST(BenchRooms, AnEmptyRoomGrowsWithItsPanels) {
    const BenchRoom room = make_empty_bench_room(10, 10, 60, 50);
    EXPECT_EQ(points_of(room), 100U);
    EXPECT_EQ(room.scene.luminaires.size(), 3000U);
    EXPECT_EQ(room.scene.luminaire_types.size(), 1U);
    EXPECT_EQ(room.scene.rooms.front().footprint[2], (Point2{180.0, 150.0}));
}

TEST(BenchRooms, AHallStaysAsItIsUnderAnyNumberOfPanels) {
    const BenchRoom few = make_hall_bench_room(12, 8, 6, 5);
    const BenchRoom many = make_hall_bench_room(12, 8, 60, 50);
    EXPECT_EQ(few.scene.luminaires.size(), 30U);
    EXPECT_EQ(many.scene.luminaires.size(), 3000U);
    EXPECT_EQ(few.scene.rooms.front().footprint, many.scene.rooms.front().footprint);
    ASSERT_EQ(points_of(few), points_of(many));
    EXPECT_EQ(few.surfaces.front().receivers.front().point,
              many.surfaces.front().receivers.front().point);
}

/// Light paths that no point takes only tell where the flux goes: 2048 of each replicate,
/// however many would be worth it if points took them. In a large hall with few points none
/// does.
TEST(BenchRooms, TracedPointsCostFewLightPaths) {
    BenchRoom room = make_empty_bench_room(6, 4, 33, 31);
    const Scene scene = build_scene(std::move(room.scene));
    Settings settings;
    settings.tolerance = 0.02;
    const Results results = calculate(scene, room.surfaces, settings);
    ASSERT_NE(results.estimator.find("path tracing (24 points)"), std::string::npos)
        << results.estimator;
    EXPECT_EQ(results.paths, 16U * 2048U);
    const FluxBalance& flux = results.flux_balance;
    EXPECT_GT(flux.absorbed.standard_error, 0.0);
    EXPECT_LT(std::abs(flux.absorbed.mean + flux.escaped.mean - flux.emitted.mean),
              7.0 * flux.absorbed.standard_error);
    settings.estimator = Estimator::local_estimation_mis;
    EXPECT_GT(calculate(scene, room.surfaces, settings).paths, 16U * 2048U);
}

/// What the engine says about a task of a fixed number of units.
std::string plan_of(std::string_view name) {
    BenchRoom room = make_bench_room(name);
    const Scene scene = build_scene(std::move(room.scene));
    Settings settings;
    settings.fixed_units = 1;
    Engine engine(scene, settings);
    std::vector<Receiver> receivers;
    for (const CalculationSurface& s : room.surfaces)
        receivers.insert(receivers.end(), s.receivers.begin(), s.receivers.end());
    engine.prepare(receivers, {});
    return engine.describe();
}

TEST(BenchRooms, ShareATreeOfVerticesWhereTheyHaveVeryManyPoints) {
    EXPECT_NE(plan_of("many-points").find("(in a tree)"), std::string::npos);
    EXPECT_EQ(plan_of("furnished-office").find("(in a tree)"), std::string::npos);
}

} // namespace
} // namespace isolux
