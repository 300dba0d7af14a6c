#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "isolux/calc/plan.h"
#include "isolux/scene/primitives.h"
#include "isolux/viz/label_layout.h"
#include "isolux/viz/surface_view.h"

#include "support/photometric_files.h"

namespace isolux {
namespace {

double length_of_all(const std::vector<Polyline>& lines) {
    double sum = 0.0;
    for (const Polyline& line : lines)
        sum += length_of(line);
    return sum;
}

double area_of_all(const std::vector<Polyline>& faces) {
    double sum = 0.0;
    for (const Polyline& face : faces)
        sum += std::abs(signed_area(face));
    return sum;
}

/// An L-shaped room with a column, a square panel turned by 45 degrees and a bulb.
Scene make_scene() {
    SceneDescription d;
    d.materials = {{"paint", Opaque{Rgb::grey(0.5), 0.0}, Sides::both}};
    Room room;
    room.name = "office";
    room.footprint = {{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 2}, {0, 2}};
    room.floor_level = 3.0;
    room.height = 2.8;
    room.walls.resize(6);
    room.columns = {{{{1, 0.5}, {1.4, 0.5}, {1.4, 0.9}, {1, 0.9}}, MaterialId(0)}};
    d.rooms = {room};
    LuminaireType panel;
    panel.name = "panel";
    panel.source = LambertianSource{Lumen(4000)};
    panel.opening = {OpeningShape::rectangle, Metre(0.6), Metre(0.6), Metre(0)};
    LuminaireType bulb;
    bulb.name = "bulb";
    bulb.source = IsotropicSource{Lumen(800)};
    d.luminaire_types = {panel, bulb};
    LuminairePlacement a;
    a.name = "panel 1";
    a.world_from_luminaire = rotate(a.world_from_luminaire, UnitVector3(), degrees(45));
    a.world_from_luminaire.origin = {3, 1, 5.7};
    LuminairePlacement b;
    b.name = "bulb 1";
    b.type = LuminaireTypeId(1);
    b.world_from_luminaire.origin = {5, 3, 5};
    d.luminaires = {a, b};
    return build_scene(std::move(d));
}

/// Corners snap to a micrometre.
constexpr double snapping = 2e-5;

TEST(Plan, DrawsTheFootprintWithItsColumn) {
    const Plan plan = make_plan(make_scene());
    ASSERT_EQ(plan.rooms.size(), 1u);
    const PlanOutline& room = plan.rooms[0];
    EXPECT_EQ(room.name, "office");
    EXPECT_NEAR(length_of_all(room.lines), 20.0 + 1.6, snapping);
    EXPECT_NEAR(area_of_all(room.faces), 12.0 + 4.0 - 0.16, 1e-9);
    EXPECT_NEAR(room.lower, 3.0, 1e-9);
    EXPECT_NEAR(room.upper, 5.8, 1e-9);
}

TEST(Plan, DrawsLuminairesToScaleAndTurned) {
    const Plan plan = make_plan(make_scene());
    ASSERT_EQ(plan.luminaires.size(), 2u);
    const PlanLuminaire& panel = plan.luminaires[0];
    ASSERT_EQ(panel.body.size(), 4u);
    EXPECT_NEAR(signed_area(panel.body), 0.36, 1e-9);
    EXPECT_NEAR(panel.c0.x, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(panel.c0.y, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(std::hypot(panel.nadir.x, panel.nadir.y), 0.0, 1e-12);
    EXPECT_TRUE(plan.luminaires[1].body.empty());
    EXPECT_EQ(plan.types[1].name, "bulb");
    EXPECT_NEAR(plan.types[1].flux, 800.0, 1e-9);
    EXPECT_TRUE(plan.objects.empty());
}

TEST(Plan, LaysTheBodyOfOneLuminaireDownAsItsFileHasIt) {
    ISOLUX_NEEDS_CORPUS();
    for (const std::string name : {"linear-pair.ies", "linear-pair.ldt"}) {
        LuminaireType type;
        auto parsed = corpus::read("valid", name);
        type.opening = parsed.value.opening;
        type.source = std::move(parsed.value);
        Extent e;
        for (const Point2& p : body_outline(make_plan_type(type).body, Frame{}))
            e.include(p);
        EXPECT_GT(e.width(), 10.0 * e.height()) << name; // length along x in both
        EXPECT_GT(std::max(e.width(), e.height()), 1.0) << name;
    }
}

std::vector<SceneTriangle> triangles_of(const SurfaceMesh& mesh) {
    std::vector<SceneTriangle> all;
    for (const MeshTriangle& t : mesh.triangles())
        all.push_back({t.corner,
                       UnitVector3(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0])),
                       0.0,
                       MaterialId(0),
                       SurfaceId(0)});
    return all;
}

TEST(Outline, OfABoxIsItsRectangleOnce) {
    const auto outline = make_outline("desk", triangles_of(make_box({1.6, 0.8, 0.72})));
    EXPECT_NEAR(length_of_all(outline.lines), 4.8, snapping);
    EXPECT_NEAR(outline.upper - outline.lower, 0.72, 1e-12);
}

TEST(Outline, OfAnUprightSheetIsALine) {
    const auto outline = make_outline("screen", triangles_of(make_panel(1.6, 0.5)));
    EXPECT_NEAR(length_of_all(outline.lines), 1.6, snapping);
    EXPECT_TRUE(outline.faces.empty());
}

TEST(SelectVisible, KeepsWhatIsInTheRoomOfTheSurface) {
    Plan plan = make_plan(make_scene());
    plan.luminaires.push_back({"storey above", 0, {3, 1, 8.7}, {}, {}, {}});
    plan.luminaires.push_back({"other room", 0, {30, 1, 5.7}, {}, {}, {}});
    CalculationSurface surface;
    surface.receivers = {{{5, 1, 3.75}, UnitVector3()}};
    const Plan visible = select_visible(plan, surface, make_surface_view(surface));
    EXPECT_EQ(visible.rooms.size(), 1u);
    EXPECT_EQ(visible.luminaires.size(), 2u);
}

TEST(ConvexHull, LeavesInnerPointsOutAndRunsCounterClockwise) {
    const Polyline hull = convex_hull({{1, 1}, {0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}});
    EXPECT_EQ(hull.size(), 4u);
    EXPECT_DOUBLE_EQ(signed_area(hull), 4.0);
}

const std::vector<Polyline> page{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}};

TEST(LabelLayout, GivesRoomOnce) {
    LabelLayout layout;
    EXPECT_TRUE(layout.place({{50, 50}, 10, 4, 0}, page));
    EXPECT_FALSE(layout.place({{58, 52}, 10, 4, 0}, page));
    EXPECT_TRUE(layout.place({{60.1, 50}, 10, 4, 0}, page));
    EXPECT_FALSE(layout.place({{97, 80}, 10, 4, 0}, page)); // over the edge
}

TEST(LabelLayout, KnowsTurnedBoxes) {
    // Side by side on a diagonal: their upright bounding boxes meet, they do not.
    EXPECT_FALSE(overlap({{0, 0}, 10, 2, 45}, {{3, 3}, 10, 2, 45}));
    EXPECT_TRUE(overlap({{0, 0}, 10, 2, 45}, {{3, -3}, 10, 2, 45}));
}

TEST(LabelLayout, PlacesTextOnTheStraightPartOfALine) {
    LabelLayout layout;
    Polyline line{{10, 50}, {60, 50}};
    for (int k = 0; k < 40; ++k) // then a zigzag
        line.push_back({60.0 + 0.5 * k, k % 2 == 0 ? 48.0 : 52.0});
    const auto box = place_on_line(layout, line, 12, 3, page);
    ASSERT_TRUE(box.has_value());
    EXPECT_NEAR(box->centre.y, 50, 1e-9);
    EXPECT_LT(box->centre.x, 55);
    EXPECT_NEAR(box->turn, 0, 1e-9);
    EXPECT_FALSE(place_on_line(layout, {{10, 20}, {12, 20}}, 12, 3, page).has_value());
}

TEST(Simplify, KeepsCornersAndDropsTheRest) {
    const Polyline line{{0, 0}, {1, 0.001}, {2, 0}, {2, 1}, {2, 2}};
    EXPECT_EQ(simplify(line, 0.01), (Polyline{{0, 0}, {2, 0}, {2, 2}}));
}

} // namespace
} // namespace isolux
