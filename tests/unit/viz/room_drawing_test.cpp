#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/viz/room_drawing.h"

#include "unit/viz/example_results.h"

namespace isolux {
namespace {

/// An L, its longest side in two pieces, as triangulated floors have it.
PlanOutline make_l() {
    const Polyline l{{0, 0}, {4, 0}, {10, 0}, {10, 8}, {8, 8}, {8, 2}, {0, 2}};
    PlanOutline room = examples::make_block("corridor", l, 0, 2.6);
    room.faces = {{{0, 0}, {10, 0}, {10, 2}, {0, 2}}, {{8, 2}, {10, 2}, {10, 8}, {8, 8}}};
    return room;
}

TEST(Walls, JoinWhatLiesInOneLine) {
    std::multiset<long> lengths;
    for (const WallLine& w : find_walls(make_l()))
        lengths.insert(std::lround(100.0 * w.length()));
    EXPECT_EQ(lengths, (std::multiset<long>{200, 200, 600, 800, 800, 1000}));
}

TEST(Walls, KnowWhichSideIsOutside) {
    for (const WallLine& w : find_walls(make_l())) {
        const Point2 middle{0.5 * (w.from.x + w.to.x), 0.5 * (w.from.y + w.to.y)};
        const Point2 beside{middle.x + 0.1 * w.outside.x, middle.y + 0.1 * w.outside.y};
        const bool is_in_l = beside.x > 0 && beside.x < 10 && beside.y > 0 && beside.y < 8
                             && (beside.y < 2 || beside.x > 8);
        EXPECT_FALSE(is_in_l) << middle.x << ' ' << middle.y;
    }
}

TEST(Area, IsThatOfTheFaces) { EXPECT_DOUBLE_EQ(area_of(make_l()), 20.0 + 12.0); }

TEST(RoomDrawing, WritesTheLengthOfEveryWallAndNumbersTheLuminaires) {
    auto [result, plan] = examples::l_corridor();
    const PlanOutline room = make_l();
    plan.rooms = {room};
    plan.luminaires.push_back({"next door", 0, {30, 1, 2.5}});
    const std::vector<CalculationSurface> surfaces{result.surface};
    const Drawing d = draw_room(room, plan, surfaces, "project");
    std::multiset<std::string> texts;
    for (const auto& item : d.items)
        if (const auto* t = std::get_if<Text>(&item))
            texts.insert(t->text);
    for (const char* length : {"10.00", "6.00"})
        EXPECT_EQ(texts.count(length), 1u) << length;
    EXPECT_EQ(texts.count("8.00"), 2u);
    EXPECT_EQ(texts.count("2.00"), 2u);
    EXPECT_EQ(texts.count("32.00 m², 2.60 m high, 4 luminaires"), 1u);
}

std::vector<Text> texts_of(const Drawing& d, const std::string& text) {
    std::vector<Text> found;
    for (const auto& item : d.items)
        if (const auto* t = std::get_if<Text>(&item); t != nullptr && t->text == text)
            found.push_back(*t);
    return found;
}

/// A wall of the corridor, seen edge-on in plan: x = 10, facing -x.
CalculationSurface make_wall(const std::string& name) {
    CalculationSurface wall;
    wall.name = name;
    wall.outline = {{10, 1, 0}, {10, 7, 0}, {10, 7, 2.6}, {10, 1, 2.6}};
    wall.receivers = {{{10, 3, 1}, UnitVector3(Vector3{-1, 0, 0})}};
    return wall;
}

TEST(RoomDrawing, WritesTheNameOfAWallOnceAlongItsFront) {
    Plan plan;
    const PlanOutline room = make_l();
    plan.rooms = {room};
    const std::vector<CalculationSurface> surfaces{make_wall("east"), make_wall("east")};
    const std::vector<Text> names =
        texts_of(draw_room(room, plan, surfaces, "project"), "east");
    ASSERT_EQ(names.size(), 1u);
    EXPECT_NEAR(std::abs(names[0].turn), 90.0, 1e-9);
    const std::vector<Text> length = texts_of(draw_room(room, plan, surfaces, ""), "8.00");
    ASSERT_EQ(length.size(), 2u); // the dimension of the same wall stands outside
    EXPECT_LT(names[0].at.x, std::max(length[0].at.x, length[1].at.x));
}

TEST(RoomDrawing, KeepsNamesInsideWhatTheyName) {
    Plan plan;
    const PlanOutline room = make_l(); // its extent's upper left corner lies outside
    plan.rooms = {room};
    const Drawing d = draw_room(room, plan, {}, "project");
    const std::vector<Text> lengths = texts_of(d, "6.00"); // the wall x = 8, drawn left of it
    ASSERT_EQ(lengths.size(), 1u);
    for (const Text& t : texts_of(d, "corridor")) {
        const bool is_title = t.size > 3.0;
        EXPECT_TRUE(is_title || t.at.x > lengths[0].at.x || t.at.y > lengths[0].at.y);
    }
}

TEST(RoomDrawing, DrawsWhatTheLegendNames) {
    Plan plan;
    const PlanOutline room = make_l();
    plan.rooms = {room};
    plan.openings = {{room.name, "w", {1, 0}, {2, 0}, 0.9, 1.2, OpeningState::glazed},
                     {room.name, "d", {3, 0}, {4, 0}, 0.0, 2.1, OpeningState::closed},
                     {room.name, "o", {5, 0}, {6, 0}, 0.0, 2.1, OpeningState::open}};
    const std::vector<CalculationSurface> surfaces{make_wall("east")};
    const Drawing d = draw_room(room, plan, surfaces, "project");
    for (const char* words :
         {"window", "closed door", "opening", "room", "calculation surface"}) {
        const std::vector<Text> entry = texts_of(d, words);
        ASSERT_EQ(entry.size(), 1u) << words;
        const auto is_beside = [&](const auto& item) {
            const auto* s = std::get_if<Shape>(&item);
            return s != nullptr && !s->lines.empty()
                   && std::abs(s->lines[0].front().y - entry[0].at.y) < 3.0
                   && s->lines[0].front().x < entry[0].at.x
                   && s->lines[0].front().x > entry[0].at.x - 12.0;
        };
        EXPECT_TRUE(std::any_of(d.items.begin(), d.items.end(), is_beside)) << words;
    }
}

} // namespace
} // namespace isolux
