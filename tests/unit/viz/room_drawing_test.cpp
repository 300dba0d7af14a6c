#include <cmath>
#include <set>
#include <string>

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

} // namespace
} // namespace isolux
