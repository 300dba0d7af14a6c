#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/project_json.h"

#include "support/small_project.h"

/// What a good project file stands for.
namespace isolux::test {
namespace {

Project parse(const std::map<std::string, std::string>& changes) {
    return parse_project(small_project(changes), "p.json");
}

Project with_luminaires(const std::string& json) { return parse({{"luminaires", json}}); }

Project with_surface(const std::string& json) {
    return parse({{"surfaces", "[" + json + "]"}});
}

void expect_near(const Vector3& a, const Vector3& b) {
    EXPECT_NEAR(length(a - b), 0.0, 1e-9) << a.x << ' ' << a.y << ' ' << a.z;
}

void expect_near(const Point3& a, const Point3& b) { expect_near(a - Point3{}, b - Point3{}); }

TEST(ProjectLuminaires, AreTurnedAboutTheirAxisThenTippedThenTurned) {
    // Nadir and C0 for tilt 25 and azimuth 30 degrees, from the definition: the nadir tips
    // towards +x, then all turns about the vertical.
    const Project project = with_luminaires(
        R"([{"type": "panel", "position": [1, 1, 2], "tilt": 25, "azimuth": 30}])");
    const Frame frame = project.scene.luminaires.at(0).world_from_luminaire;

    expect_near(-Vector3(frame.z), {0.365998151, 0.211309131, -0.906307787});
    expect_near(Vector3(frame.x), {0.784885567, 0.453153894, 0.422618262});
}

TEST(ProjectLuminaires, OfAFieldKeepHalfTheSpacingToTheWalls) {
    const Project project = with_luminaires(
        R"([{"type": "panel", "field": {"rows": 2, "columns": 2, "suspended": 0.5}}])");

    ASSERT_EQ(project.scene.luminaires.size(), 4U);
    expect_near(project.scene.luminaires[0].world_from_luminaire.origin, {1.5, 1.0, 2.5});
    expect_near(project.scene.luminaires[3].world_from_luminaire.origin, {4.5, 3.0, 2.5});
}

TEST(ProjectLuminaires, OutsideAnLShapedRoomAreLeftOutOfAField) {
    const Project project = parse(
        {{"rooms",
          R"([{"footprint": [[0, 0], [4, 0], [4, 4], [2, 4], [2, 2], [0, 2]], "height": 3}])"},
         {"luminaires", R"([{"type": "panel", "field": {"rows": 2, "columns": 2}}])"}});

    EXPECT_EQ(project.scene.luminaires.size(), 3U);
    ASSERT_EQ(project.notices.size(), 1U);
    EXPECT_EQ(
        to_string(project.notices[0]),
        "p.json:3: #/luminaires/0/field: 1 of 4 luminaires fall outside room \"room\" or into "
        "a column (they are left out)");
}

TEST(ProjectRooms, OfUnusualHeightAreNoticed) {
    const auto notices = [](const std::string& height) {
        std::string all;
        for (const Message& m :
             parse({{"rooms",
                     R"([{"name": "office", "size": [60, 40], "height": )" + height + "}]"}})
                 .notices)
            all += to_string(m) + "\n";
        return all;
    };

    EXPECT_EQ(notices("30"), "");
    EXPECT_EQ(notices("31"),
              "p.json:5: #/rooms/0/height: the room is 60 m x 40 m, 31 m high (higher than 30 "
              "m). Are these centimetres? isolux takes metres\n");
}

TEST(ProjectLuminaires, OfALineIncludeBothEnds) {
    const Project project = with_luminaires(
        R"([{"type": "panel", "line": {"from": [1, 1, 2], "to": [5, 3, 2], "count": 3}}])");

    ASSERT_EQ(project.scene.luminaires.size(), 3U);
    expect_near(project.scene.luminaires[0].world_from_luminaire.origin, {1, 1, 2});
    expect_near(project.scene.luminaires[1].world_from_luminaire.origin, {3, 2, 2});
    expect_near(project.scene.luminaires[2].world_from_luminaire.origin, {5, 3, 2});
}

TEST(ProjectLuminaires, OfARingCanLookOutwards) {
    const Project project = with_luminaires(
        R"([{"type": "panel", "ring": {"centre": [3, 2, 2], "radius": 1, "count": 4, "outwards": true}}])");

    ASSERT_EQ(project.scene.luminaires.size(), 4U);
    for (const LuminairePlacement& l : project.scene.luminaires)
        expect_near(Vector3(l.world_from_luminaire.x),
                    l.world_from_luminaire.origin - Point3{3, 2, 2});
    expect_near(project.scene.luminaires[1].world_from_luminaire.origin, {3, 3, 2});
}

TEST(ProjectLuminaires, MultiplyMaintenanceFactorAndBothDimmings) {
    const Project project = parse(
        {{"luminaire_types",
          R"({"panel": {"isotropic": {"flux": 100}, "maintenance_factor": 0.7, "dimming": 0.5}})"},
         {"luminaires",
          R"([{"type": "panel", "position": [1, 1, 2], "dimming": 0.5, "group": "a"}])"}});

    EXPECT_DOUBLE_EQ(project.scene.luminaires.at(0).scale, 0.7 * 0.5 * 0.5);
    EXPECT_EQ(project.scene.luminaires[0].group, "a");
    EXPECT_TRUE(project.notices.empty());
}

TEST(ProjectLuminaires, CanLieWithTheirLengthAlongX) {
    const Project project = parse(
        {{"luminaire_types",
          R"({"panel": {"lambertian": {"size": [0.2, 1.2], "flux": 100}, "align_length_axis": true}})"},
         {"luminaires", R"([{"type": "panel", "position": [1, 1, 2]}])"}});
    const Frame frame = project.scene.luminaires.at(0).world_from_luminaire;

    EXPECT_EQ(project.length_aligned, std::vector<std::string>{"panel"});
    expect_near(Vector3(frame.y), {1, 0, 0});
    expect_near(cross(frame.x, frame.y), Vector3(frame.z));
    expect_near(Vector3(frame.z), {0, 0, 1});
}

TEST(ProjectLuminaires, KeepTheirFluxWhateverTheColour) {
    const Project project =
        parse({{"luminaire_types",
                R"({"panel": {"isotropic": {"flux": 100}, "colour": [1, 0.9, 0.7]}})"}});

    EXPECT_DOUBLE_EQ(luminance_sum(project.scene.luminaire_types.at(0).colour), 1.0);
}

TEST(ProjectLuminaires, OfLambertianTypesHaveBodiesUnlessToldOtherwise) {
    const Project project = parse({{"luminaire_types",
                                    R"({"panel": {"lambertian": {"diameter": 1, "flux": 1}},
                                        "sheet": {"lambertian": {"diameter": 1, "flux": 1}, "body": "none"},
                                        "bulb": {"isotropic": {"flux": 1}}})"}});

    EXPECT_EQ(project.scene.luminaire_types.at(0).body, BodyModel::absorbing);
    EXPECT_EQ(project.scene.luminaire_types.at(1).body, BodyModel::none);
    EXPECT_EQ(project.scene.luminaire_types.at(2).body, BodyModel::none);
    EXPECT_EQ(project.scene.luminaire_types.at(0).opening.shape, OpeningShape::ellipse);
}

TEST(ProjectSurfaces, DefaultToTheWorkPlaneOfEveryRoom) {
    const Project project = parse({});

    ASSERT_EQ(project.surfaces.size(), 1U);
    const CalculationSurface& plane = project.surfaces[0];
    EXPECT_EQ(plane.name, "office work plane");
    // Edge band: min(0.5, 15 % of 4 m) = 0.5 m; 5 m x 3 m: p = 0.2 * 5^lg 5 = 0.616 m.
    EXPECT_DOUBLE_EQ(plane.grid->width, 5.0);
    EXPECT_EQ(plane.grid->counts.columns, 9U);
    EXPECT_EQ(plane.grid->counts.rows, 5U);
    EXPECT_DOUBLE_EQ(plane.receivers[0].point.z, 0.75);
    EXPECT_EQ(plane.outline.size(), 4U);
}

TEST(ProjectSurfaces, LeaveOutTheEdgeBandAndColumnsOfAnLShapedRoom) {
    const Project project =
        parse({{"rooms",
                R"([{"footprint": [[0, 0], [4, 0], [4, 4], [2, 4], [2, 2], [0, 2]], "height": 3,
               "columns": [{"centre": [3, 1], "size": [0.5, 0.5]}]}])"},
               {"luminaires", R"([{"type": "panel", "position": [1, 1, 3]}])"},
               {"surfaces", R"([{"work_plane": {"edge": 0}, "grid": {"columns": 4, "rows": 4}},
                          {"work_plane": {"edge": 0.6}, "grid": {"columns": 14, "rows": 14}}])"}});

    EXPECT_EQ(project.surfaces.at(0).receivers.size(), 12U);
    EXPECT_EQ(project.surfaces[0].grid->cell_of_point.size(), 12U);
    for (const Receiver& r : project.surfaces.at(1).receivers) {
        EXPECT_GE(r.point.x, 0.6);
        EXPECT_LE(r.point.x, 3.4);
        EXPECT_TRUE(r.point.x >= 2.0 || r.point.y <= 1.4);
        EXPECT_GE(std::hypot(r.point.x - 2.0, r.point.y - 2.0), 0.6);
        EXPECT_FALSE(std::abs(r.point.x - 3.0) < 0.25 && std::abs(r.point.y - 1.0) < 0.25);
    }
}

TEST(ProjectSurfaces, OnAWallFaceTheRoomAndReadFromLeftToRight) {
    const Project project =
        with_surface(R"({"wall": {"number": 1}, "grid": {"columns": 3, "rows": 3}})");
    const CalculationSurface& wall = project.surfaces.at(0);

    EXPECT_EQ(wall.name, "office wall 1");
    expect_near(Vector3(wall.receivers[0].axis), {0, 1, 0});
    expect_near(wall.receivers[0].point, {5, 0, 0.5}); // facing wall 1 its left end is x = 6
    expect_near(Vector3(wall.grid->frame.y), {0, 0, 1});
}

TEST(ProjectSurfaces, OnAWallLeaveOutWindowsAlsoOfTheRoomBehind) {
    const Project project = parse(
        {{"rooms",
          R"([{"name": "office", "size": [6, 4], "height": 3,
               "openings": [{"wall": 2, "offset": 0, "width": 2, "height": 3, "state": "glazed"}]},
              {"name": "hall", "size": [2, 4], "position": [6, 0], "height": 3}])"},
         {"surfaces",
          R"([{"wall": {"room": "office", "number": 2}, "grid": {"columns": 4, "rows": 1}},
              {"wall": {"room": "hall", "number": 4}, "grid": {"columns": 4, "rows": 1}}])"}});

    for (const CalculationSurface& wall : project.surfaces) {
        ASSERT_EQ(wall.receivers.size(), 2U) << wall.name;
        EXPECT_GT(wall.receivers[0].point.y, 2.0);
        EXPECT_GT(wall.receivers[1].point.y, 2.0);
    }
}

TEST(ProjectSurfaces, OnTheCeilingFaceDown) {
    const Project project = with_surface(R"({"ceiling": {}})");

    expect_near(Vector3(project.surfaces.at(0).receivers[0].axis), {0, 0, -1});
    EXPECT_DOUBLE_EQ(project.surfaces[0].receivers[0].point.z, 3.0);
    for (const Receiver& r : project.surfaces[0].receivers)
        EXPECT_TRUE(r.point.x > 0 && r.point.x < 6 && r.point.y > 0 && r.point.y < 4);
}

TEST(ProjectSurfaces, ByCentreSizeAndNormalStandUpright) {
    const Project project = with_surface(
        R"({"rectangle": {"centre": [3, 0.1, 1.5], "size": [2, 1], "normal": [0, 1, 0]}, "grid": {"columns": 2, "rows": 1}})");
    const CalculationSurface& board = project.surfaces.at(0);

    EXPECT_EQ(board.name, "surface 1");
    expect_near(board.receivers.at(0).point, {3.5, 0.1, 1.5});
    expect_near(board.receivers.at(1).point, {2.5, 0.1, 1.5});
    expect_near(Vector3(board.receivers[0].axis), {0, 1, 0});
}

TEST(ProjectSurfaces, ByCornerFaceUCrossV) {
    const Project project = with_surface(
        R"({"rectangle": {"corner": [1, 1, 1], "u": [0, 1, 0], "v": [2, 0, 0]}, "grid": {"spacing": 0.5}})");

    EXPECT_EQ(project.surfaces.at(0).grid->counts.columns, 2U);
    EXPECT_EQ(project.surfaces[0].grid->counts.rows, 4U);
    expect_near(Vector3(project.surfaces[0].receivers[0].axis), {0, 0, -1});
    expect_near(project.surfaces[0].receivers[0].point, {1.25, 1.25, 1.0});
}

TEST(ProjectSurfaces, OfPolygonsClipTheGrid) {
    const Project project = with_surface(
        R"({"polygon": [[0, 0, 1], [4, 0, 1], [0, 4, 1]], "grid": {"columns": 4, "rows": 4}})");

    EXPECT_EQ(project.surfaces.at(0).receivers.size(), 10U); // the diagonal counts
    expect_near(Vector3(project.surfaces[0].receivers[0].axis), {0, 0, 1});
}

TEST(ProjectSurfaces, KnowTheFiveIlluminances) {
    const Project project = parse({{"surfaces", R"([
        {"points": [[1, 1, 1, 0, 1, 0]]},
        {"points": [[1, 1, 1, 0, 1, 0]], "quantity": "cylindrical"},
        {"points": [[1, 1, 1, 0, 1, 0]], "quantity": "semi-cylindrical", "direction": 90},
        {"points": [[1, 1, 1, 0, 1, 0]], "quantity": "hemispherical"},
        {"points": [[1, 1, 1, 0, 1, 0]], "quantity": "mean-spherical"}])"}});
    const auto receiver = [&](std::size_t i) { return project.surfaces.at(i).receivers.at(0); };

    EXPECT_EQ(receiver(0).kind, IlluminanceKind::planar);
    expect_near(Vector3(receiver(0).axis), {0, 1, 0});
    EXPECT_EQ(receiver(1).kind, IlluminanceKind::cylindrical);
    expect_near(Vector3(receiver(1).axis), {0, 0, 1});
    EXPECT_EQ(receiver(2).kind, IlluminanceKind::semi_cylindrical);
    expect_near(Vector3(receiver(2).reference), {0, 1, 0});
    EXPECT_EQ(receiver(3).kind, IlluminanceKind::hemispherical);
    EXPECT_EQ(receiver(4).kind, IlluminanceKind::mean_spherical);
    EXPECT_EQ(project.surfaces[4].name, "points 5");
}

TEST(ProjectSurfaces, WithMadeUpNamesNeverShareOne) {
    const Project project = with_surface(
        R"({"work_plane": {}}, {"work_plane": {"height": 1.2}}, {"name": "office work plane 2", "floor": {}})");

    EXPECT_EQ(project.surfaces.at(0).name, "office work plane");
    EXPECT_EQ(project.surfaces.at(1).name, "office work plane 3");
    EXPECT_EQ(project.surfaces.at(2).name, "office work plane 2");
}

} // namespace
} // namespace isolux::test
