#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/scene/mesh.h"
#include "isolux/scene/primitives.h"

namespace isolux {
namespace {

using Kind = MeshFinding::Kind;
using Faces = std::vector<std::vector<std::uint32_t>>;

double area(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (const MeshTriangle& t : mesh.triangles())
        sum += 0.5 * length(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
    return sum;
}

double volume(const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (const MeshTriangle& t : mesh.triangles())
        sum +=
            dot(t.corner[0] - Point3{}, cross(t.corner[1] - Point3{}, t.corner[2] - Point3{}))
            / 6.0;
    return sum;
}

const std::vector<Point3> cube_points{
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Faces cube_faces{
    {3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

SurfaceMesh cube_without(std::size_t face) {
    Faces faces = cube_faces;
    faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(face));
    return {cube_points, faces};
}

void expect_single(const SurfaceMesh& mesh, Kind kind, const std::string& text) {
    const auto findings = mesh.inspect();
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].kind, kind);
    EXPECT_NE(findings[0].text.find(text), std::string::npos) << findings[0].text;
}

TEST(SurfaceMesh, AnEmptyOneHasNothingToReport) {
    const SurfaceMesh mesh;
    EXPECT_TRUE(mesh.triangles().empty());
    EXPECT_TRUE(mesh.inspect().empty());
    EXPECT_EQ(mesh.slots(), std::vector<std::string>{""});
}

TEST(SurfaceMesh, ACubeIsSound) {
    const SurfaceMesh cube(cube_points, cube_faces);
    EXPECT_EQ(cube.triangles().size(), 12U);
    EXPECT_DOUBLE_EQ(area(cube), 6.0);
    EXPECT_DOUBLE_EQ(volume(cube), 1.0);
    EXPECT_TRUE(cube.inspect().empty());
}

TEST(SurfaceMesh, ConcaveAndFlatCorneredFacesAreSplitWithoutOverlap) {
    // An L with one corner of 180 degrees; its area by the shoelace formula is 3.
    const std::vector<Point3> l{
        {0, 0, 5}, {1, 0, 5}, {2, 0, 5}, {2, 1, 5}, {1, 1, 5}, {1, 2, 5}, {0, 2, 5}};
    const SurfaceMesh mesh(l, Faces{{0, 1, 2, 3, 4, 5, 6}});
    EXPECT_EQ(mesh.triangles().size(), 5U);
    EXPECT_DOUBLE_EQ(area(mesh), 3.0);
    for (const MeshTriangle& t : mesh.triangles())
        EXPECT_GT(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]).z, 0.0);
}

TEST(SurfaceMesh, SlotsFollowTheirFaces) {
    const std::vector<std::uint32_t> slot{0, 1, 2, 0, 1, 2};
    const SurfaceMesh mesh(cube_points, cube_faces, slot, {"a", "b", "c"});
    std::array<int, 3> count{};
    for (const MeshTriangle& t : mesh.triangles())
        ++count.at(t.slot);
    EXPECT_EQ(count, (std::array{4, 4, 4}));
    EXPECT_EQ(mesh.slots(), (std::vector<std::string>{"a", "b", "c"}));
}

TEST(SurfaceMesh, PointsRepeatedFaceByFaceStillMakeAClosedCube) {
    std::vector<Point3> points;
    Faces faces;
    for (const auto& face : cube_faces) {
        faces.emplace_back();
        for (const auto i : face) {
            faces.back().push_back(static_cast<std::uint32_t>(points.size()));
            points.push_back(cube_points[i]);
        }
    }
    EXPECT_TRUE(SurfaceMesh(points, faces).inspect().empty());
}

// Inspection.

TEST(MeshInspection, ReportsABorderOnceWithItsLength) {
    expect_single(cube_without(0), Kind::open_edge, "open border, 4 m long in 4 edges");
    Faces faces = cube_faces;
    faces.erase(faces.begin(), faces.begin() + 2); // lid and base
    EXPECT_EQ(SurfaceMesh(cube_points, faces).inspect().size(), 2U);
}

TEST(MeshInspection, ReportsFacesWithoutArea) {
    const std::vector<Point3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const auto findings = SurfaceMesh(line, Faces{{0, 1, 2}}).inspect();
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].kind, Kind::degenerate);
    EXPECT_NE(findings[0].text.find("without area"), std::string::npos);
    EXPECT_TRUE(SurfaceMesh(line, Faces{{0, 1, 2}}).triangles().empty());
    expect_single(SurfaceMesh(line, Faces{{0, 1, 1}}),
                  Kind::degenerate,
                  "fewer than three different corners");
}

TEST(MeshInspection, ReportsAnEdgeOfThreeFacesAndKeepsThemAll) {
    // Three rectangles that share one edge, like a book's pages.
    const std::vector<Point3> points{{0, 0, 0},
                                     {0, 0, 1},
                                     {1, 0, 0},
                                     {1, 0, 1},
                                     {0, 1, 0},
                                     {0, 1, 1},
                                     {-1, 0, 0},
                                     {-1, 0, 1}};
    const SurfaceMesh mesh(points, Faces{{0, 2, 3, 1}, {0, 1, 5, 4}, {0, 6, 7, 1}});
    EXPECT_DOUBLE_EQ(area(mesh), 3.0);
    int crowded = 0;
    for (const auto& f : mesh.inspect())
        if (f.kind == Kind::non_manifold_edge) {
            ++crowded;
            EXPECT_NE(f.text.find("more than two faces meet along 1 m"), std::string::npos);
            EXPECT_EQ(f.place.x, 0.0);
        }
    EXPECT_EQ(crowded, 1);
}

TEST(MeshInspection, ReportsNeighboursWoundAgainstEachOther) {
    Faces faces = cube_faces;
    std::reverse(faces[1].begin(), faces[1].end());
    const SurfaceMesh mesh(cube_points, faces);
    EXPECT_DOUBLE_EQ(area(mesh), 6.0);
    expect_single(mesh, Kind::non_manifold_edge, "wound against each other along 4 m");
}

TEST(MeshInspection, TwoCubesThatTouchInACornerAreSound) {
    auto points = cube_points;
    Faces faces = cube_faces;
    for (const Point3& p : cube_points)
        points.push_back(p + Vector3{1, 1, 1});
    for (auto face : cube_faces) {
        for (auto& i : face)
            i += 8;
        faces.push_back(face);
    }
    const SurfaceMesh mesh(points, faces);
    EXPECT_TRUE(mesh.inspect().empty());
    EXPECT_DOUBLE_EQ(area(mesh), 12.0);
}

TEST(MeshInspection, ReportsAClosedSurfaceTurnedInsideOut) {
    Faces faces = cube_faces;
    for (auto& face : faces)
        std::reverse(face.begin(), face.end());
    for (const double far : {0.0, 1e6}) {
        auto points = cube_points;
        for (Point3& p : points)
            p.x += far;
        expect_single(
            SurfaceMesh(points, faces), Kind::inside_out, "1 m3 is turned inside out");
    }
}

TEST(MeshInspection, ReportsDuplicateFaces) {
    const std::vector<Point3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const SurfaceMesh mesh(points, Faces{{0, 1, 2}, {1, 2, 0}});
    int duplicates = 0;
    for (const auto& f : mesh.inspect())
        duplicates += f.kind == Kind::duplicate_face;
    EXPECT_EQ(duplicates, 1);
    EXPECT_EQ(mesh.triangles().size(), 2U);
}

TEST(SurfaceMesh, AFaceThatVisitsACornerTwiceIsKept) {
    // A square with a square hole, joined by a bridge that is walked twice.
    const std::vector<Point3> points{
        {0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
    const SurfaceMesh mesh(points, Faces{{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}});
    EXPECT_NEAR(area(mesh), 8.0, 1e-14);
    EXPECT_EQ(mesh.inspect().size(), 2U); // the outer and the inner border
}

TEST(SurfaceMesh, TransformedScalesThenPlaces) {
    Frame frame;
    frame.origin = {10, 20, 30};
    frame = rotate(frame, UnitVector3::from_unit({0, 0, 1}), degrees(90));
    const SurfaceMesh moved =
        SurfaceMesh(cube_points, cube_faces).transformed({2, 3, 4}, frame);
    EXPECT_NEAR(volume(moved), 24.0, 1e-10);
    double most_x = -1e9, least_x = 1e9, most_y = -1e9;
    for (const auto& t : moved.triangles())
        for (const auto& p : t.corner)
            most_x = std::max(most_x, p.x), least_x = std::min(least_x, p.x),
            most_y = std::max(most_y, p.y);
    EXPECT_NEAR(most_x, 10.0, 1e-14);
    EXPECT_NEAR(least_x, 7.0, 1e-14); // y, scaled by 3, turned to -x
    EXPECT_NEAR(most_y, 22.0, 1e-14);
}

TEST(SurfaceMesh, AMirrorImageStaysRightSideOut) {
    const SurfaceMesh mirrored =
        SurfaceMesh(cube_points, cube_faces).transformed({-1, 1, 1}, Frame{});
    EXPECT_NEAR(volume(mirrored), 1.0, 1e-14);
    EXPECT_TRUE(mirrored.inspect().empty());
}

// Primitives.

TEST(Primitives, BoxStandsOnItsPosition) {
    const SurfaceMesh box = make_box({1.6, 0.8, 0.74});
    EXPECT_NEAR(volume(box), 1.6 * 0.8 * 0.74, 1e-15);
    EXPECT_NEAR(area(box), 2 * (1.6 * 0.8 + 0.8 * 0.74 + 0.74 * 1.6), 1e-14);
    EXPECT_TRUE(box.inspect().empty());
    for (const auto& t : box.triangles())
        for (const auto& p : t.corner) {
            EXPECT_EQ(std::abs(p.x), 0.8);
            EXPECT_EQ(std::abs(p.y), 0.4);
            EXPECT_TRUE(p.z == 0.0 || p.z == 0.74);
        }
}

TEST(Primitives, CylinderHasTheCirclesVolume) {
    for (const int n : {3, 8, 32}) {
        const SurfaceMesh cylinder = make_cylinder(0.4, 2.0, n);
        EXPECT_NEAR(volume(cylinder), std::numbers::pi * 0.04 * 2.0, 1e-14);
        EXPECT_TRUE(cylinder.inspect().empty());
    }
}

TEST(Primitives, PanelFacesMinusY) {
    const SurfaceMesh panel = make_panel(1.6, 1.2);
    EXPECT_NEAR(area(panel), 1.92, 1e-15);
    for (const auto& t : panel.triangles())
        EXPECT_LT(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]).y, 0.0);
}

} // namespace
} // namespace isolux
