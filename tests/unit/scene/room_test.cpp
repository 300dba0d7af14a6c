#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "isolux/scene/room.h"
#include "isolux/scene/scene.h"

namespace isolux {
namespace {

Room make_test_room(std::vector<Point2> footprint, double height = 3.0, double level = 0.0) {
    Room room;
    room.name = "room";
    room.footprint = std::move(footprint);
    room.floor_level = level;
    room.height = height;
    room.floor = MaterialId(0);
    room.ceiling = MaterialId(1);
    room.walls.assign(room.footprint.size(), MaterialId(2));
    return room;
}

const std::vector<Point2> rectangle{{0, 0}, {6, 0}, {6, 4}, {0, 4}};
const std::vector<Point2> l_shape{{0, 0}, {12, 0}, {12, 8}, {10, 8}, {10, 2}, {0, 2}};
const std::vector<Point2> u_shape{
    {0, 0}, {9, 0}, {9, 6}, {7, 6}, {7, 2}, {2, 2}, {2, 6}, {0, 6}};
const std::vector<Point2> star{
    {3, 0}, {1, 1}, {0, 3}, {-1, 1}, {-3, 0}, {-1, -1}, {0, -3}, {1, -1}};

std::vector<Point2> moved(std::vector<Point2> polygon, double dx, double dy, double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    for (Point2& p : polygon)
        p = {c * p.x - s * p.y + dx, s * p.x + c * p.y + dy};
    return polygon;
}

std::vector<Point2> circle(double x, double y, double r, int n) {
    std::vector<Point2> polygon;
    for (int i = 0; i < n; ++i) {
        const double a = 2.0 * std::numbers::pi * i / n;
        polygon.push_back({x + r * std::cos(a), y + r * std::sin(a)});
    }
    return polygon;
}

double perimeter(const std::vector<Point2>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        sum += std::hypot(b.x - a.x, b.y - a.y);
    }
    return sum;
}

double area(const MeshTriangle& t) {
    return 0.5 * length(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
}

std::map<std::string, double> area_by_slot(const Object& shell) {
    std::map<std::string, double> sum;
    for (const MeshTriangle& t : shell.mesh.triangles())
        sum[shell.mesh.slots()[t.slot]] += area(t);
    return sum;
}

/// The findings that matter for a shell: it looks inwards on purpose.
std::vector<MeshFinding> gaps(const Object& shell) {
    auto findings = shell.mesh.inspect();
    std::erase_if(findings,
                  [](const auto& f) { return f.kind == MeshFinding::Kind::inside_out; });
    return findings;
}

/// V - E + F of the triangles, and six times the volume they enclose.
struct Solid {
    long euler = 0;
    double volume = 0.0;
};

Solid measure(const Object& shell) {
    const auto key = [](const Point3& p) { return std::array{p.x, p.y, p.z}; };
    std::set<std::array<double, 3>> vertices;
    std::set<std::set<std::array<double, 3>>> edges;
    Solid solid;
    const auto triangles = shell.mesh.triangles();
    const Point3 o = triangles[0].corner[0];
    for (const MeshTriangle& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            vertices.insert(key(t.corner[i]));
            edges.insert({key(t.corner[i]), key(t.corner[(i + 1) % 3])});
        }
        solid.volume -= dot(t.corner[0] - o, cross(t.corner[1] - o, t.corner[2] - o)) / 6.0;
    }
    solid.euler = static_cast<long>(vertices.size()) - static_cast<long>(edges.size())
                  + static_cast<long>(triangles.size());
    return solid;
}

// Polygons.

TEST(Polygon, SignedAreaTellsTheSense) {
    EXPECT_DOUBLE_EQ(signed_area(rectangle), 24.0);
    EXPECT_DOUBLE_EQ(signed_area(l_shape), 36.0);
    EXPECT_DOUBLE_EQ(signed_area({{0, 0}, {0, 4}, {6, 4}, {6, 0}}), -24.0);
}

TEST(Polygon, SimpleOnesAreAccepted) {
    for (const auto& p : {rectangle, l_shape, u_shape, star, circle(0, 0, 2, 64)}) {
        EXPECT_TRUE(is_simple(p));
        EXPECT_TRUE(is_simple(moved(p, 4e5, -7e5, 0.7)));
    }
    EXPECT_TRUE(is_simple({{0, 0}, {3, 0}, {6, 0}, {6, 4}, {0, 4}})); // a corner of 180 degrees
}

TEST(Polygon, OthersAreNot) {
    EXPECT_FALSE(is_simple({}));
    EXPECT_FALSE(is_simple({{0, 0}, {1, 0}}));
    EXPECT_FALSE(is_simple({{0, 0}, {4, 4}, {4, 0}, {0, 4}}));         // crosses itself
    EXPECT_FALSE(is_simple({{0, 0}, {0, 0}, {4, 0}, {4, 4}}));         // repeats a corner
    EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {2, 0}, {2, 3}}));         // turns back
    EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}})); // touches an edge
    EXPECT_FALSE(is_simple({{0, 0}, {4, 0}, {8, 0}}));                 // no area
}

TEST(Room, ContainsWhatIsInsideAndOnItsBorder) {
    Room room = make_test_room(l_shape, 2.8, 1.0);
    room.columns.push_back({{{1, 0.5}, {2, 0.5}, {2, 1.5}, {1, 1.5}}, MaterialId(3)});
    EXPECT_TRUE(contains(room, {5, 1, 2}));
    EXPECT_TRUE(contains(room, {11, 7, 2}));
    EXPECT_FALSE(contains(room, {5, 5, 2}));   // in the notch
    EXPECT_TRUE(contains(room, {0, 0, 1}));    // a corner
    EXPECT_TRUE(contains(room, {10, 5, 3.8})); // wall and ceiling
    EXPECT_FALSE(contains(room, {5, 1, 0.9}));
    EXPECT_FALSE(contains(room, {5, 1, 3.9}));
    EXPECT_FALSE(contains(room, {1.5, 1, 2})); // in the column
    EXPECT_TRUE(contains(room, {1, 1, 2}));    // on the column
}

// Shells.

TEST(RoomShell, IsClosedAndLooksInwardsForEveryFootprint) {
    for (const auto& footprint : {rectangle, l_shape, u_shape, star, circle(1, 2, 3, 40)})
        for (const double turn : {0.0, 0.3, 2.1})
            for (const double far : {0.0, 5.5e5}) {
                const Room room = make_test_room(moved(footprint, far, -far, turn), 2.7, 0.4);
                const Object shell = make_room_shell(room, {});
                EXPECT_TRUE(gaps(shell).empty());
                const Solid solid = measure(shell);
                EXPECT_EQ(solid.euler, 2); // a ball
                const double exact = signed_area(footprint);
                // coordinates far out are themselves rounded, to 2^-53 of their size
                const double tolerance = 1e-12 + far * 1e-15;
                EXPECT_NEAR(solid.volume, exact * 2.7, exact * 2.7 * tolerance);
                auto areas = area_by_slot(shell);
                EXPECT_NEAR(areas["floor"], exact, exact * tolerance);
                EXPECT_NEAR(areas["ceiling"], exact, exact * tolerance);
                double walls = 0.0;
                for (std::size_t k = 0; k < footprint.size(); ++k)
                    walls += areas["wall " + std::to_string(k + 1)];
                EXPECT_NEAR(walls, perimeter(footprint) * 2.7, walls * tolerance);
            }
}

TEST(RoomShell, EveryColumnAddsAHandle) {
    Room room = make_test_room(rectangle, 3.0);
    double columns_area = 0.0, columns_perimeter = 0.0;
    const std::vector<std::vector<Point2>> outlines{
        {{1, 1}, {1.4, 1}, {1.4, 1.4}, {1, 1.4}},
        {{3, 1}, {3, 1.4}, {3.4, 1.4}, {3.4, 1}}, // clockwise is welcome, too
        circle(4.5, 2.5, 0.3, 24),
        {{1, 3}, {1.4, 3}, {1.4, 3.4}, {1, 3.4}}, // in line with the first
    };
    for (const auto& outline : outlines) {
        room.columns.push_back({outline, MaterialId(3)});
        columns_area += std::abs(signed_area(outline));
        columns_perimeter += perimeter(outline);
    }
    const Object shell = make_room_shell(room, {});
    EXPECT_TRUE(gaps(shell).empty());
    const Solid solid = measure(shell);
    EXPECT_EQ(solid.euler, 2 - 2 * 4);
    EXPECT_NEAR(solid.volume, (24.0 - columns_area) * 3.0, 1e-12 * 72);
    auto areas = area_by_slot(shell);
    EXPECT_NEAR(areas["floor"], 24.0 - columns_area, 1e-11);
    double sides = 0.0;
    for (int i = 1; i <= 4; ++i)
        sides += areas["column " + std::to_string(i)];
    EXPECT_NEAR(sides, columns_perimeter * 3.0, 1e-11);
}

TEST(RoomShell, ManyColumnsInAGridAreAllBridged) {
    Room room = make_test_room({{0, 0}, {30, 0}, {30, 30}, {0, 30}}, 4.0);
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j) {
            const double x = 3.0 + 4.0 * i, y = 3.0 + 4.0 * j;
            room.columns.push_back(
                {{{x, y}, {x + 0.5, y}, {x + 0.5, y + 0.5}, {x, y + 0.5}}, MaterialId(3)});
        }
    const Object shell = make_room_shell(room, {});
    EXPECT_TRUE(gaps(shell).empty());
    const Solid solid = measure(shell);
    EXPECT_EQ(solid.euler, 2 - 2 * 49);
    EXPECT_NEAR(solid.volume, (900.0 - 49 * 0.25) * 4.0, 1e-12 * 3600);
}

Room room_with_openings() {
    Room room = make_test_room(l_shape, 2.8);
    room.openings = {
        {"door", 0, 1.0, 0.0, 0.9, 2.1, OpeningState::closed, MaterialId(4)},
        {"window", 0, 4.0, 0.9, 3.0, 1.5, OpeningState::glazed, MaterialId(5)},
        {"", 1, 0.0, 1.0, 8.0, 1.0, OpeningState::open, MaterialId()}, // from corner to corner
        {"gate", 5, 0.5, 0.0, 1.0, 2.8, OpeningState::open, MaterialId()}, // floor to ceiling
    };
    return room;
}

TEST(RoomShell, OpeningsAreCutToTheirArea) {
    const Room room = room_with_openings();
    const Object shell = make_room_shell(room, {});
    auto areas = area_by_slot(shell);
    EXPECT_NEAR(areas["opening door"], 0.9 * 2.1, 1e-12);
    EXPECT_NEAR(areas["opening window"], 4.5, 1e-12);
    EXPECT_NEAR(areas["wall 1"], 12 * 2.8 - 0.9 * 2.1 - 4.5, 1e-12);
    EXPECT_NEAR(areas["wall 2"], 8 * 2.8 - 8.0, 1e-12);
    EXPECT_NEAR(areas["wall 6"], 2 * 2.8 - 2.8, 1e-12);
    EXPECT_EQ(areas.count("opening 3"), 0U);
    EXPECT_EQ(shell.mesh.slots().size(), shell.material_of_slot.size());
    for (std::size_t i = 0; i < shell.mesh.slots().size(); ++i)
        if (shell.mesh.slots()[i] == "opening window") {
            EXPECT_EQ(shell.material_of_slot[i], MaterialId(5));
        }
}

TEST(RoomShell, OnlyOpenOpeningsLeaveABorder) {
    const auto findings = gaps(make_room_shell(room_with_openings(), {}));
    ASSERT_EQ(findings.size(), 2U);
    for (const auto& f : findings)
        EXPECT_EQ(f.kind, MeshFinding::Kind::open_edge);
    // 2 x (8 + 1) m around the one, 2 x (1 + 2.8) m around the other
    EXPECT_NE((findings[0].text + findings[1].text).find("18 m"), std::string::npos);
    EXPECT_NE((findings[0].text + findings[1].text).find("7.6 m"), std::string::npos);
}

TEST(RoomShell, ClosedOpeningsKeepTheShellClosed) {
    Room room = room_with_openings();
    for (auto& o : room.openings)
        o.state = OpeningState::closed;
    const Object shell = make_room_shell(room, {});
    EXPECT_TRUE(gaps(shell).empty());
    EXPECT_EQ(measure(shell).euler, 2);
    EXPECT_NEAR(measure(shell).volume, 36.0 * 2.8, 1e-12 * 100);
    EXPECT_NEAR(area_by_slot(shell)["opening 3"], 8.0, 1e-12);
}

TEST(RoomShell, OpeningsLargerThanTheWallStayWithinIt) {
    Room room = make_test_room(rectangle);
    room.openings = {{"all", 1, -1.0, -1.0, 10.0, 10.0, OpeningState::closed, MaterialId(4)}};
    const Object shell = make_room_shell(room, {});
    EXPECT_TRUE(gaps(shell).empty());
    EXPECT_NEAR(area_by_slot(shell)["opening all"], 12.0, 1e-12);
    EXPECT_EQ(area_by_slot(shell).count("wall 2"), 0U);
}

TEST(RoomShell, NeighbourGivesWayToHolesAndPanesButNotToLeaves) {
    for (const auto state : {OpeningState::open, OpeningState::glazed, OpeningState::closed}) {
        Room left = make_test_room({{0, 0}, {4, 0}, {4, 3}, {0, 3}}, 2.7, 0.0);
        left.openings = {{"door", 1, 1.0, 0.0, 0.9, 2.1, state, MaterialId(4)}};
        // Starts elsewhere, higher floor: 1.6 m of the door's height lie on its wall.
        const Room right = make_test_room({{4, -1}, {8, -1}, {8, 5}, {4, 5}}, 2.7, 0.5);
        const std::vector<Room> rooms{left, right};
        auto areas = area_by_slot(make_room_shell(rooms[1], rooms));
        const double hole = state == OpeningState::closed ? 0.0 : 0.9 * 1.6;
        EXPECT_NEAR(areas["wall 4"], 6 * 2.7 - hole, 1e-12);
        EXPECT_EQ(areas.count("opening door"), 0U);
        auto own = area_by_slot(make_room_shell(rooms[0], rooms));
        EXPECT_NEAR(own["wall 2"], 3 * 2.7 - 0.9 * 2.1, 1e-12);
    }
}

TEST(RoomShell, RoomsBesideEachOtherButNotTouchingKeepTheirWalls) {
    Room left = make_test_room({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
    left.openings = {{"door", 1, 1.0, 0.0, 0.9, 2.1, OpeningState::open, MaterialId()}};
    const Room right = make_test_room({{4.2, 0}, {8, 0}, {8, 3}, {4.2, 3}});
    const std::vector<Room> rooms{left, right};
    EXPECT_NEAR(area_by_slot(make_room_shell(rooms[1], rooms))["wall 4"], 9.0, 1e-12);
}

} // namespace
} // namespace isolux
