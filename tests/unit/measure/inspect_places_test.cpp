#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/measure/inspect_places.h"
#include "isolux/scene/primitives.h"

namespace isolux::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// 6 x 4 x 3 m with a desk, 1.2 x 0.8 m and 0.76 m high, at (2, 1).
SceneDescription make_office(double desk_height = 0.76) {
    SceneDescription d;
    d.materials.push_back({"grey", Opaque{Rgb::grey(0.5), 0.0}, Sides::both});
    Room room;
    room.name = "office";
    room.footprint = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
    room.height = 3.0;
    room.floor = room.ceiling = MaterialId(0);
    room.walls.assign(4, MaterialId(0));
    d.rooms.push_back(room);
    d.objects.push_back(
        {"desk",
         make_box({1.2, 0.8, desk_height}).transformed({1, 1, 1}, Frame{{2, 1, 0}}),
         {MaterialId(0)}});
    return d;
}

CalculationSurface make_points(const std::vector<Point3>& points,
                               const Vector3& normal = {0, 0, 1}) {
    CalculationSurface s;
    s.name = "plane";
    for (const Point3& p : points)
        s.receivers.push_back({p, UnitVector3(normal), IlluminanceKind::planar});
    return s;
}

std::vector<std::string> inspect(const SceneDescription& d,
                                 const std::vector<CalculationSurface>& surfaces,
                                 const std::vector<ObserverGroup>& observers = {},
                                 const std::vector<View>& views = {}) {
    std::vector<std::string> texts;
    for (const Message& m : inspect_places(d, surfaces, observers, views))
        texts.push_back(to_string(m));
    return texts;
}

TEST(PlaceInspection, FindsNothingWhereLightComes) {
    const auto in_room = make_points({{1, 1, 0.75}, {2, 1, 0.8}, {0, 0, 0}, {6, 4, 2.9}});

    EXPECT_THAT(inspect(make_office(), {in_room}), IsEmpty());
    EXPECT_THAT(inspect(make_office(), {make_points({{0, 2, 1}, {0.01, 2, 2}}, {1, 0, 0})}),
                IsEmpty());
}

TEST(PlaceInspection, CountsPointsInsideObjects) {
    EXPECT_THAT(
        inspect(make_office(), {make_points({{1, 1, 0.75}, {2, 1, 0.75}, {2.3, 1, 0.75}})}),
        ElementsAre("surface 'plane': 2 of 3 points lie inside 'desk' (they get no "
                    "light). Raise the surface, or leave the object out?"));
}

TEST(PlaceInspection, NamesSomeOfManyObjects) {
    auto d = make_office();
    std::vector<Point3> points;
    for (int i = 0; i < 6; ++i) {
        d.objects.push_back(
            {"box " + std::to_string(i),
             make_box({0.2, 0.2, 1.0}).transformed({1, 1, 1}, Frame{{1.0 + 0.5 * i, 3, 0}}),
             {MaterialId(0)}});
        points.push_back({1.0 + 0.5 * i, 3, 0.75});
    }

    EXPECT_THAT(
        inspect(d, {make_points(points)}),
        ElementsAre("surface 'plane': all 6 points lie inside 'box 0', 'box 1', 'box 2' "
                    "and 3 more (they get no light). Raise the surface, or leave the "
                    "object out?"));
}

TEST(PlaceInspection, TakesPointsAtTheHeightOfTheTopForPointsOnIt) {
    const std::vector<Point3> on_top{{2, 1, 0.75}, {2.2, 0.9, 0.75}, {1.7, 1.1, 0.75}};
    EXPECT_THAT(inspect(make_office(0.75), {make_points(on_top)}), IsEmpty());
    EXPECT_THAT(inspect(make_office(0.45 + 0.3), {make_points(on_top)}), IsEmpty());
}

TEST(PlaceInspection, AgreesWithTheFormulaOfASlantedBoxAndACylinder) {
    auto d = make_office();
    const double turn = 0.4;
    const UnitVector3 x = UnitVector3::from_unit({std::cos(turn), std::sin(turn), 0.0});
    const UnitVector3 y = UnitVector3::from_unit({-std::sin(turn), std::cos(turn), 0.0});
    const Frame frame{{2, 2, 0.5}, x, y, UnitVector3::from_unit({0, 0, 1})};
    d.objects.clear();
    d.objects.push_back(
        {"box", make_box({1.0, 0.5, 0.8}).transformed({1, 1, 1}, frame), {MaterialId(0)}});
    d.objects.push_back({"drum",
                         make_cylinder(1.0, 1.5, 4000).transformed({1, 1, 1}, Frame{{4, 2, 0}}),
                         {MaterialId(0)}});
    const SceneSpace space(d);

    for (double px = 1.02; px < 5.0; px += 0.093)
        for (double py = 1.04; py < 3.0; py += 0.097)
            for (const double pz : {0.25, 0.7, 1.4}) {
                const Vector3 local = frame.point_to_local({px, py, pz});
                const bool in_box = std::abs(local.x) < 0.5 && std::abs(local.y) < 0.25
                                    && local.z > 0.0 && local.z < 0.8;
                const bool in_drum = std::hypot(px - 4.0, py - 2.0) < 0.5 && pz < 1.5;
                const auto found = space.object_around({px, py, pz});
                EXPECT_EQ(found.has_value(), in_box || in_drum) << px << " " << py << " " << pz;
                if (found) {
                    EXPECT_EQ(*found, in_box ? 0U : 1U);
                }
            }
}

TEST(PlaceInspection, LooksIntoOpenAndTransparentObjects) {
    auto glass = make_office();
    glass.materials.push_back({"glass", ClearPane{}, Sides::both});
    glass.objects[0].material_of_slot = {MaterialId(1)};
    EXPECT_THAT(inspect(glass, {make_points({{2, 1, 0.5}})}), IsEmpty());

    auto open = make_office();
    const std::vector<Point3> points{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}, {1, 1, 1}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    open.objects[0].mesh = SurfaceMesh(points, faces);
    EXPECT_THAT(inspect(open, {make_points({{1.2, 1.2, 0.2}})}), IsEmpty());
}

TEST(PlaceInspection, TakesObjectsWithALuminaireForRooms) {
    auto d = make_office();
    LuminairePlacement l;
    l.world_from_luminaire = Frame{{2, 1, 0.6}};
    d.luminaires.push_back(l);
    EXPECT_THAT(inspect(d, {make_points({{2, 1, 0.5}})}), IsEmpty());
}

TEST(PlaceInspection, LooksThroughOpenings) {
    auto d = make_office();
    d.rooms[0].openings.push_back(
        {"window", 0, 1.0, 0.9, 2.0, 1.2, OpeningState::glazed, MaterialId(0)});
    View in, past;
    in.name = "in";
    in.camera.position = {2, -3, 1.5};
    in.camera.target = {2, 2, 1.5};
    past = in;
    past.name = "past";
    past.camera.target = {5, 2, 1.5};

    EXPECT_THAT(inspect(d, {}, {}, {in, past}),
                ElementsAre("view 'past': its camera lies outside every room, at (2, -3, 1.5) "
                            "(only light through an opening gets there). Room \"office\" "
                            "reaches from (0, 0, 0) to (6, 4, 3)"));
    in.camera.target = {2, -6, 1.5};
    EXPECT_EQ(inspect(d, {}, {}, {in}).size(), 1U);
}

TEST(PlaceInspection, TellsPointsOutsideEveryRoom) {
    EXPECT_THAT(
        inspect(make_office(), {make_points({{1, 1, 1}, {-0.5, 2, 1}, {-0.5, 3, 1}})}),
        ElementsAre(
            "surface 'plane': 2 of 3 points lie outside every room, the first at "
            "(-0.5, 2, 1) (no light of a room gets there). Room \"office\" reaches from (0, "
            "0, 0) to (6, 4, 3)"));
    auto outdoors = make_office();
    outdoors.rooms.clear();
    EXPECT_THAT(inspect(outdoors, {make_points({{-0.5, 2, 1}})}), IsEmpty());
}

TEST(PlaceInspection, TellsSurfacesThatFaceTheWall) {
    const std::string hint =
        " (no light of the room reaches that side). Turn the normal round?";
    EXPECT_THAT(
        inspect(make_office(), {make_points({{0, 2, 1}, {0.01, 2, 2}}, {-1, 0, 0})}),
        ElementsAre("surface 'plane': all 2 points lie at the border of room \"office\" "
                    "and look out of it, the first at (0, 2, 1)"
                    + hint));
    EXPECT_THAT(inspect(make_office(), {make_points({{5, 3, 0}}, {0, 0, -1})}),
                ElementsAre("surface 'plane': its point lies at the border of room "
                            "\"office\" and looks out of it, at (5, 3, 0)"
                            + hint));
}

TEST(PlaceInspection, LetsRoomsLookIntoEachOther) {
    auto d = make_office();
    d.rooms.push_back(d.rooms[0]);
    d.rooms[1].name = "store";
    d.rooms[1].footprint = {{6, 0}, {9, 0}, {9, 4}, {6, 4}};
    EXPECT_THAT(inspect(d, {make_points({{6, 2, 1}}, {1, 0, 0})}), IsEmpty());
}

TEST(PlaceInspection, TellsObserversWithoutLight) {
    ObserverGroup group;
    group.name = "staff";
    const UnitVector3 x = UnitVector3::from_unit({1, 0, 0}),
                      y = UnitVector3::from_unit({0, 1, 0});
    for (const Point3& eye : {Point3{1, 1, 1.2}, Point3{2, 1, 0.5}, Point3{7, 1, 1.2}}) {
        group.sight_lines.push_back({eye, x});
        group.sight_lines.push_back({eye, y});
    }

    EXPECT_THAT(
        inspect(make_office(), {}, {group}),
        ElementsAre("observers 'staff': 1 of 3 eyes lies outside every room, at (7, 1, "
                    "1.2) (no light of a room gets there). Room \"office\" reaches "
                    "from (0, 0, 0) to (6, 4, 3)",
                    "observers 'staff': 1 of 3 eyes lies inside 'desk' (no light reaches "
                    "them). Move it out of the object?"));
    group.scale = GlareScale::outdoor;
    EXPECT_EQ(inspect(make_office(), {}, {group}).size(), 1U);
}

TEST(PlaceInspection, TellsCamerasWithoutLight) {
    View outside, inside;
    outside.name = "street";
    outside.camera.position = {-2, 2, 1.7};
    inside.name = "drawer";
    inside.camera.position = {2, 1, 0.5};

    EXPECT_THAT(
        inspect(make_office(), {}, {}, {outside, inside}),
        ElementsAre("view 'street': its camera lies outside every room, at (-2, 2, "
                    "1.7) (no light of a room gets there). Room \"office\" reaches from "
                    "(0, 0, 0) to (6, 4, 3)",
                    "view 'drawer': its camera lies inside 'desk' (it sees "
                    "nothing else). Move it out of the object?"));
}

} // namespace
} // namespace isolux::test
