#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "isolux/scene/primitives.h"
#include "isolux/scene/scene.h"

namespace isolux {
namespace {

const MaterialId floor_id(0), wall_id(1), ceiling_id(2), glass_id(3), other_id(4);

std::vector<Material> make_materials() {
    return {{"floor", Opaque{Rgb::grey(0.2)}, Sides::both},
            {"wall", Opaque{Rgb::grey(0.5)}, Sides::both},
            {"ceiling", Opaque{Rgb::grey(0.7)}, Sides::both},
            {"glass", ClearPane{}, Sides::both},
            {"other", Opaque{Rgb::grey(0.3)}, Sides::both}};
}

Room make_test_room(std::string name, double x0, double x1) {
    Room room;
    room.name = std::move(name);
    room.footprint = {{x0, 0}, {x1, 0}, {x1, 3}, {x0, 3}};
    room.height = 2.5;
    room.floor = floor_id;
    room.ceiling = ceiling_id;
    room.walls.assign(4, wall_id);
    return room;
}

SceneDescription make_description(std::vector<Room> rooms) {
    SceneDescription d;
    d.materials = make_materials();
    d.rooms = std::move(rooms);
    return d;
}

/// Two rooms side by side with a doorway from y = 1 to 2, 2 m high, in the shared wall x = 4.
SceneDescription two_rooms(OpeningState state) {
    auto d = make_description({make_test_room("left", 0, 4), make_test_room("right", 4, 7)});
    d.rooms[0].walls[1] = other_id;
    d.rooms[0].openings = {{"door", 1, 1.0, 0.0, 1.0, 2.0, state, glass_id}};
    return d;
}

void add_luminaire(SceneDescription& d,
                   const LuminousOpening& opening,
                   const Frame& frame,
                   BodyModel body) {
    d.luminaire_types.push_back({.name = "type",
                                 .file = "",
                                 .source = LambertianSource{Lumen(1000)},
                                 .opening = opening,
                                 .body = body});
    d.luminaires.push_back(
        {"lamp 1", LuminaireTypeId(d.luminaire_types.size() - 1), frame, 0.8, ""});
}

const LuminousOpening square{OpeningShape::rectangle, Metre(0.6), Metre(0.6), Metre(0)};

TEST(Scene, OfNothingIsEmpty) {
    const Scene scene = build_scene({});
    EXPECT_TRUE(scene.triangles.empty());
    EXPECT_EQ(scene.total_area, 0.0);
    EXPECT_EQ(scene.materials.size(), 1U);
    EXPECT_FALSE(scene.caster.find_first_hit({}, UnitVector3()));
}

TEST(Scene, HoldsARoomSurfaceBySurface) {
    const Scene scene = build_scene(make_description({make_test_room("office", 0, 4)}));
    std::vector<std::string> names;
    double area = 0.0;
    for (const Surface& s : scene.surfaces) {
        names.push_back(s.name);
        EXPECT_TRUE(s.is_shell);
        double sum = 0.0;
        for (std::size_t i = s.first_triangle; i < s.first_triangle + s.triangles; ++i) {
            EXPECT_EQ(&scene.surfaces[scene.triangles[i].surface.index()], &s);
            sum += scene.triangles[i].area;
        }
        EXPECT_DOUBLE_EQ(sum, s.area);
        area += s.area;
    }
    EXPECT_EQ(names,
              (std::vector<std::string>{"office/floor",
                                        "office/ceiling",
                                        "office/wall 1",
                                        "office/wall 2",
                                        "office/wall 3",
                                        "office/wall 4"}));
    EXPECT_NEAR(area, 2 * 12 + 14 * 2.5, 1e-12);
    EXPECT_NEAR(scene.total_area, area, 1e-12);
    EXPECT_EQ(scene.bounds.lower, (Point3{0, 0, 0}));
    EXPECT_EQ(scene.bounds.upper, (Point3{4, 3, 2.5}));
    const Point3 middle{2, 1.5, 1.25};
    for (const SceneTriangle& t : scene.triangles)
        EXPECT_GT(dot(t.normal, middle - t.corner[0]), 0.0); // shells look inwards
}

TEST(Scene, HitsNameTriangleAndMaterial) {
    const Scene scene = build_scene(make_description({make_test_room("office", 0, 4)}));
    const auto down = scene.caster.find_first_hit({1, 1, 1}, UnitVector3(Vector3{0, 0, -1}));
    ASSERT_TRUE(down);
    EXPECT_EQ(scene.material(scene.triangle(down->triangle).material).name, "floor");
    EXPECT_NEAR(down->position.z, 0.0, 1e-15);
    const auto up = scene.caster.find_first_hit({1, 1, 1}, UnitVector3(Vector3{0, 0, 1}));
    EXPECT_EQ(scene.material(scene.triangle(up->triangle).material).name, "ceiling");
}

TEST(Scene, ADoorwayJoinsTwoRooms) {
    const Point3 left{3, 1.5, 1}, right{5, 1.5, 1};
    const Point3 left_beside{3, 2.5, 1}, right_beside{5, 2.5, 1};
    const Scene open = build_scene(two_rooms(OpeningState::open));
    EXPECT_EQ(open.caster.transmittance(left, right), 1.0);
    EXPECT_EQ(open.caster.transmittance(left_beside, right_beside), 0.0);
    const Scene closed = build_scene(two_rooms(OpeningState::closed));
    // glass_id as a leaf is still glass: a leaf is what its material says
    EXPECT_TRUE(closed.caster.has_panes());
    const Scene glazed = build_scene(two_rooms(OpeningState::glazed));
    EXPECT_NEAR(
        glazed.caster.transmittance(left, right), evaluate_slab({}, 1.0).transmittance, 1e-12);
    EXPECT_EQ(glazed.caster.transmittance(left_beside, right_beside), 0.0);
}

TEST(Scene, APaneDeclaredFromBothRoomsDimsOnce) {
    auto d = two_rooms(OpeningState::glazed);
    d.rooms[1].openings = {{"window", 3, 1.0, 0.0, 1.0, 2.0, OpeningState::glazed, glass_id}};
    const Scene scene = build_scene(std::move(d));
    EXPECT_NEAR(scene.caster.transmittance({3, 1.5, 1}, {5, 1.5, 1}),
                evaluate_slab({}, 1.0).transmittance,
                1e-12);
}

TEST(Scene, EachSideOfASharedWallHasItsOwnMaterial) {
    const Scene scene = build_scene(two_rooms(OpeningState::open));
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> y(2.1, 2.9), z(0.1, 2.4);
    for (int i = 0; i < 1000; ++i) {
        const Point3 target{4, y(engine), z(engine)};
        const Point3 from_left{1.5, 1.5, 1.2}, from_right{6.5, 1.5, 1.2};
        const auto a = scene.caster.find_first_hit(from_left, UnitVector3(target - from_left));
        const auto b =
            scene.caster.find_first_hit(from_right, UnitVector3(target - from_right));
        ASSERT_TRUE(a && b);
        EXPECT_EQ(scene.material(scene.triangle(a->triangle).material).name, "other");
        EXPECT_EQ(scene.material(scene.triangle(b->triangle).material).name, "wall");
        EXPECT_TRUE(a->is_front && b->is_front);
        // Light leaves either side freely.
        EXPECT_EQ(scene.caster.transmittance(scene.caster.offset_point(a->position, a->normal),
                                             from_left),
                  1.0);
        EXPECT_EQ(scene.caster.transmittance(scene.caster.offset_point(b->position, b->normal),
                                             from_right),
                  1.0);
    }
}

TEST(Scene, ObjectsBringTheirSlots) {
    auto d = make_description({make_test_room("office", 0, 4)});
    const std::vector<Point3> points{{1, 1, 0}, {2, 1, 0}, {2, 2, 1}, {1, 2, 1}, {1, 1, 1}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
    const std::vector<std::uint32_t> slots{0, 1, 1};
    d.objects.push_back(
        {"thing", SurfaceMesh(points, faces, slots, {"", "cloth"}), {wall_id, other_id}});
    const Scene scene = build_scene(std::move(d));
    ASSERT_EQ(scene.surfaces.size(), 8U);
    EXPECT_EQ(scene.surfaces[6].name, "thing");
    EXPECT_EQ(scene.surfaces[7].name, "thing/cloth");
    EXPECT_EQ(scene.surfaces[7].triangles, 2U);
    EXPECT_FALSE(scene.surfaces[7].is_shell);
    EXPECT_EQ(scene.triangles.back().material, other_id);
}

TEST(Scene, HangsLuminairesWithAllFactors) {
    auto d = make_description({make_test_room("office", 0, 4)});
    add_luminaire(d, square, Frame{{2, 1.5, 2.4}}, BodyModel::none);
    const Scene scene = build_scene(std::move(d));
    ASSERT_EQ(scene.luminaires.size(), 1U);
    const Luminaire& l = scene.luminaires[0];
    EXPECT_DOUBLE_EQ(in_lumen(l.flux), 800.0);
    EXPECT_EQ(l.opening.facets.at(0).vertices.at(0).z, 2.4);
    EXPECT_EQ(scene.type_of(l).name, "type");
    EXPECT_EQ(scene.surfaces.size(), 6U); // no body
}

TEST(Scene, AnAbsorbingPanelCoversAFlatOpeningAndLightStartsBeforeIt) {
    auto d = make_description({make_test_room("office", 0, 4)});
    add_luminaire(d, square, Frame{{2, 1.5, 2.0}}, BodyModel::absorbing);
    const Scene scene = build_scene(std::move(d));
    EXPECT_EQ(scene.surfaces.back().name, "lamp 1/body");
    EXPECT_NEAR(scene.surfaces.back().area, 0.36, 1e-15);
    const Point3 on_opening = scene.caster.offset_point({2.1, 1.4, 2.0}, {0, 0, -1});
    EXPECT_EQ(scene.caster.transmittance(on_opening, {2, 1, 0.1}), 1.0);
    EXPECT_EQ(scene.caster.transmittance({2, 1, 0.1}, on_opening), 1.0);
    EXPECT_EQ(scene.caster.transmittance(on_opening, {2, 1, 2.4}), 0.0);
    EXPECT_EQ(scene.caster.transmittance({2.1, 1.4, 2.4}, {2.1, 1.4, 0.1}), 0.0);
    const auto hit = scene.caster.find_first_hit({2, 1.5, 1}, UnitVector3(Vector3{0, 0, 1}));
    ASSERT_TRUE(hit);
    const Material& black = scene.material(scene.triangle(hit->triangle).material);
    EXPECT_EQ(&black, &scene.materials.back());
    EXPECT_EQ(max_channel(std::get<Opaque>(black.scattering).diffuse), 0.0);
    EXPECT_NEAR(hit->position.z, 2.0 - 0.5e-5, 0.5e-5);
}

TEST(Scene, ThePanelOfATiltedOpeningLetsLightOutOnOneSide) {
    auto d = make_description({make_test_room("office", 0, 4)});
    const Frame frame = make_tilted_frame({2, 1.5, 1.5}, degrees(20), degrees(70), degrees(30));
    add_luminaire(d, square, frame, BodyModel::absorbing);
    const Scene scene = build_scene(std::move(d));
    const Vector3 nadir = -Vector3(frame.z);
    const Point3 front = scene.caster.offset_point(frame.origin, nadir);
    const Point3 back = scene.caster.offset_point(frame.origin, -nadir);
    EXPECT_EQ(scene.caster.transmittance(front, front + 0.5 * nadir), 1.0);
    EXPECT_EQ(scene.caster.transmittance(front, front - 0.5 * nadir), 0.0);
    EXPECT_EQ(scene.caster.transmittance(back, back - 0.5 * nadir), 1.0);
    EXPECT_EQ(scene.caster.transmittance(back, back + 0.5 * nadir), 0.0);
}

TEST(Scene, APanelFlushWithTheCeilingCoversIt) {
    for (const double shift : {0.0, 40.0}) {
        auto d = make_description({make_test_room("office", shift, 4)});
        add_luminaire(d, square, Frame{{2 + shift, 1.5, 2.5}}, BodyModel::absorbing);
        const Scene scene = build_scene(std::move(d));
        const auto hit =
            scene.caster.find_first_hit({2.1 + shift, 1.6, 1}, UnitVector3(Vector3{0, 0, 1}));
        ASSERT_TRUE(hit);
        EXPECT_EQ(&scene.material(scene.triangle(hit->triangle).material),
                  &scene.materials.back());
    }
}

TEST(Scene, ASolidBodyLetsLightOutAndNoneThrough) {
    for (const auto shape :
         {OpeningShape::box, OpeningShape::ellipsoid, OpeningShape::vertical_cylinder}) {
        auto d = make_description({make_test_room("office", 0, 4)});
        add_luminaire(d,
                      {shape, Metre(0.4), Metre(0.3), Metre(0.2)},
                      Frame{{2, 1.5, 1.2}},
                      BodyModel::absorbing);
        const Scene scene = build_scene(std::move(d));
        EXPECT_EQ(scene.caster.transmittance({1, 1.5, 1.2}, {3, 1.5, 1.2}), 0.0);
        for (const Facet& f : scene.luminaires[0].opening.facets) {
            Vector3 sum;
            for (const Point3& p : f.vertices)
                sum = sum + (p - Point3{});
            const Point3 middle = Point3{} + sum / static_cast<double>(f.vertices.size());
            EXPECT_EQ(scene.caster.transmittance(middle, middle + 0.5 * Vector3(f.normal)),
                      1.0);
            EXPECT_EQ(scene.caster.transmittance(middle, middle - 0.5 * Vector3(f.normal)),
                      0.0);
        }
    }
}

TEST(Scene, APointHasNoBody) {
    auto d = make_description({make_test_room("office", 0, 4)});
    add_luminaire(d, {}, Frame{{2, 1.5, 2.0}}, BodyModel::absorbing);
    EXPECT_EQ(build_scene(std::move(d)).surfaces.size(), 6U);
}

TEST(Scene, PanelsHoldInALargeScene) {
    auto d = make_description({make_test_room("hall", 0, 1000)});
    add_luminaire(d, square, Frame{{2, 1.5, 2.0}}, BodyModel::absorbing);
    const Scene scene = build_scene(std::move(d));
    const Point3 on_opening = scene.caster.offset_point({2.1, 1.4, 2.0}, {0, 0, -1});
    EXPECT_EQ(scene.caster.transmittance({2, 1, 0.1}, on_opening), 1.0);
    EXPECT_EQ(scene.caster.transmittance({2.1, 1.4, 2.4}, {2.1, 1.4, 0.1}), 0.0);
}

// Inspection.

std::vector<std::string> inspect(const SceneDescription& d) {
    std::vector<std::string> texts;
    for (const Message& m : inspect_scene(d))
        texts.push_back(to_string(m));
    return texts;
}

SurfaceMesh placed(const SurfaceMesh& mesh, const Point3& at) {
    return mesh.transformed({1, 1, 1}, Frame{at});
}

TEST(SceneInspection, FindsNothingInASoundScene) {
    auto d = two_rooms(OpeningState::open);
    d.objects.push_back({"desk", placed(make_box({1.6, 0.8, 0.7}), {2, 1.5, 0}), {other_id}});
    d.objects.push_back({"screen", placed(make_panel(1.6, 1.2), {2, 1, 0}), {other_id}});
    add_luminaire(d, square, Frame{{2, 1.5, 2.5}}, BodyModel::absorbing); // flush
    EXPECT_EQ(inspect(d), std::vector<std::string>{});
}

TEST(SceneInspection, ReportsWhatIsOddAboutAMesh) {
    auto d = make_description({make_test_room("office", 0, 4)});
    const std::vector<Point3> points{{1, 1, 0}, {2, 1, 0}, {1, 2, 0}, {1, 1, 1}};
    const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    d.objects.push_back({"bowl", SurfaceMesh(points, faces), {other_id}});
    EXPECT_EQ(inspect(d),
              std::vector<std::string>{
                  "object 'bowl': open border, 3.414 m long in 3 edges (the surface does not "
                  "close), at (1, 1, 0). Close the mesh, unless it is meant to be a sheet?"});
}

TEST(SceneInspection, CountsWhatItDoesNotList) {
    auto d = make_description({make_test_room("office", 0, 4)});
    std::vector<Point3> points;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::uint32_t i = 0; i < 8; ++i) {
        const double x = 1.0 + 0.1 * i, z = 0.1 * i;
        points.insert(points.end(), {{x, 1, z}, {x + 0.05, 1, z}, {x, 1.05, z}});
        faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    d.objects.push_back({"leaves", SurfaceMesh(points, faces), {other_id}});
    const auto texts = inspect(d);
    ASSERT_EQ(texts.size(), 6U);
    EXPECT_EQ(texts.back(), "object 'leaves': 3 more of the last kind");
}

TEST(SceneInspection, ReportsWhatLiesOutsideEveryRoom) {
    auto d = make_description({make_test_room("office", 0, 4)});
    d.objects.push_back({"desk", placed(make_box({1, 1, 1}), {20, 0, 0}), {other_id}});
    add_luminaire(d, square, Frame{{2, 1.5, 9.0}}, BodyModel::none);
    EXPECT_EQ(
        inspect(d),
        (std::vector<std::string>{
            "object 'desk': lies outside every room, around (19.5, -0.5, 0) (no light of a "
            "room reaches it). Is its position in metres and in the building's "
            "coordinates?",
            "luminaire 'lamp 1': hangs outside every room, at (2, 1.5, 9) (its light is "
            "lost). Is its position in the building's coordinates?"}));
}

TEST(SceneInspection, ReportsOpeningsThatPierceASurface) {
    auto d = make_description({make_test_room("office", 0, 4)});
    add_luminaire(d, square, Frame{{0.1, 1.5, 2.0}}, BodyModel::none); // 0.2 m into wall 4
    EXPECT_EQ(
        inspect(d),
        std::vector<std::string>{
            "luminaire 'lamp 1': its luminous opening pierces 'office', near (0.1, 1.5, 2) "
            "(part of its light starts behind that surface). Move it, or check the size "
            "of its opening?"});
}

TEST(SceneInspection, ReportsAThinThingThroughAnOpening) {
    auto d = make_description({make_test_room("office", 0, 4)});
    d.objects.push_back({"pole", placed(make_box({0.02, 0.02, 2.4}), {2, 1.5, 0}), {other_id}});
    add_luminaire(d, square, Frame{{2, 1.5, 2.0}}, BodyModel::none);
    ASSERT_EQ(inspect(d).size(), 1U);
    EXPECT_NE(inspect(d)[0].find("pierces 'pole'"), std::string::npos);
}

} // namespace
} // namespace isolux
