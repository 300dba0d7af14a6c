#include <gtest/gtest.h>

#include "support/malformed_project.h"

namespace isolux::test {
namespace {

Project project_with(const std::string& views) {
    return parse_project(small_project({{"views", views}}), "p.json");
}

Camera camera_of(const std::string& view) {
    return project_with("[" + view + "]").views.at(0).camera;
}

TEST(ViewReader, ReadsAPerspectiveView) {
    const Project p = project_with(
        R"([{"name": "door", "position": [1, 1, 1.6], "target": [5, 3, 1], "field_of_view": 75, "resolution": [320, 200]}])");
    ASSERT_EQ(p.views.size(), 1u);
    EXPECT_EQ(p.views[0].name, "door");
    const Camera& c = p.views[0].camera;
    EXPECT_EQ(c.projection, Projection::perspective);
    EXPECT_EQ(c.position, (Point3{1, 1, 1.6}));
    EXPECT_EQ(c.target, (Point3{5, 3, 1}));
    EXPECT_NEAR(c.field_of_view.in_degrees(), 75.0, 1e-12);
    EXPECT_EQ(c.columns, 320u);
    EXPECT_EQ(c.rows, 200u);
    EXPECT_EQ(c.lens_radius, 0.0);
    EXPECT_TRUE(p.notices.empty());
}

TEST(ViewReader, TurnsAFocalLengthIntoAFieldOfView) {
    const Camera c = camera_of(
        R"({"name": "a", "position": [1, 1, 1], "target": [2, 2, 1], "focal_length": 18, "f_number": 2})");
    EXPECT_NEAR(c.field_of_view.in_degrees(), 90.0, 1e-9);
    EXPECT_NEAR(c.lens_radius, 0.5 * 0.018 / 2.0, 1e-12);
}

TEST(ViewReader, ReadsALens) {
    const Camera c = camera_of(
        R"({"name": "a", "position": [1, 1, 1], "target": [2, 2, 1], "aperture": 50, "focus_distance": 2.5})");
    EXPECT_NEAR(c.lens_radius, 0.025, 1e-15);
    EXPECT_EQ(c.focus_distance, 2.5);
}

TEST(ViewReader, ReadsFisheyes) {
    const Camera c = camera_of(
        R"({"name": "a", "position": [1, 1, 1], "target": [1, 1, 3], "projection": "equal-area fisheye"})");
    EXPECT_EQ(c.projection, Projection::equal_area);
    EXPECT_NEAR(c.field_of_view.in_degrees(), 180.0, 1e-12);
    EXPECT_EQ(c.columns, c.rows);
}

TEST(ViewReader, FramesARoomAsAPlan) {
    const Camera c = camera_of(R"({"name": "plan", "plan": {}})");
    EXPECT_EQ(c.projection, Projection::orthographic);
    EXPECT_EQ(c.position, (Point3{3, 2, 2}));
    EXPECT_EQ(c.up, (Vector3{0, 1, 0}));
    EXPECT_NEAR(c.width, 6.3, 0.02);
    EXPECT_EQ(c.columns, 640u);
    EXPECT_NEAR(static_cast<double>(c.rows), 427.0, 1.0);
}

TEST(ViewReader, NoticesAFocusWithoutALens) {
    const Project p = project_with(
        R"([{"name": "a", "position": [1, 1, 1], "target": [2, 2, 1], "focus_distance": 2}])");
    ASSERT_EQ(p.notices.size(), 1u);
    EXPECT_EQ(to_string(p.notices[0]),
              "p.json:6: #/views/0/focus_distance: a pinhole shows everything sharp (the focus "
              "distance does nothing). Give \"aperture\" or \"f_number\" too?");
}

class MalformedViews : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedViews, IsReportedInTheseWords) { expect_these_words(GetParam()); }

TEST_P(MalformedViews, DepartsFromTheSchemaIfItsShapeIsWrong) {
    expect_schema_agrees(GetParam());
}

const Malformed views[] = {
    {"NoName",
     "views",
     R"([{"position": [1, 1, 1], "target": [2, 2, 1]}])",
     R"(#/views/0: the key "name" is missing (a view needs it))",
     shape},
    {"NoTarget",
     "views",
     R"([{"name": "a", "position": [1, 1, 1]}])",
     R"(#/views/0: the key "target" is missing (a view needs it))",
     shape},
    {"SameName",
     "views",
     R"([{"name": "a", "plan": {}}, {"name": "a", "plan": {}}])",
     R"(#/views/1/name: another view is named "a" (names must be unique))"},
    {"TargetAtEye",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [1, 1, 1]}])",
     R"(#/views/0/target: the target equals the position (no direction follows from it))"},
    {"ZeroUp",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "up": [0, 0, 0]}])",
     R"(#/views/0/up: the vector is zero (it has no direction))"},
    {"UnknownProjection",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "projection": "fish"}])",
     R"(#/views/0/projection: "fish" is not known here (it must be "perspective", "orthographic", "fisheye", "equal-area fisheye" or "stereographic fisheye"))",
     shape},
    {"OrthographicWithoutWidth",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "projection": "orthographic"}])",
     R"(#/views/0: the key "width" is missing (a view needs it))"},
    {"OrthographicWithAngle",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "projection": "orthographic", "width": 3, "field_of_view": 50}])",
     R"(#/views/0/field_of_view: "field_of_view" has no meaning here (parallel rays span no angle: give "width"))"},
    {"PerspectiveWithWidth",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "width": 3}])",
     R"(#/views/0/width: "width" has no meaning here (only an orthographic view is so many metres wide))"},
    {"BothAngleAndFocalLength",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "focal_length": 24, "field_of_view": 50}])",
     R"(#/views/0/field_of_view: "field_of_view" does not go with "focal_length" (give one of the two))"},
    {"TooWidePerspective",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "field_of_view": 180}])",
     R"(#/views/0/field_of_view: 180 is too large (it must be at most 175 degrees))"},
    {"EndlessStereographic",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "projection": "stereographic fisheye", "field_of_view": 360}])",
     R"(#/views/0/field_of_view: a stereographic view of 360 degrees is endless (it must be below). Use an equal-area fisheye?)"},
    {"FisheyeWithLens",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "projection": "fisheye", "aperture": 20}])",
     R"(#/views/0/aperture: "aperture" has no meaning here (only a perspective view has a lens))"},
    {"FisheyeWithFocalLength",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "projection": "fisheye", "focal_length": 20}])",
     R"(#/views/0/focal_length: "focal_length" has no meaning here (a fisheye is described by its field of view))"},
    {"ApertureAndFNumber",
     "views",
     R"([{"name": "a", "position": [1, 1, 1], "target": [2, 1, 1], "aperture": 20, "f_number": 2}])",
     R"(#/views/0/aperture: "aperture" does not go with "f_number" (give one of the two))"},
    {"PlanAboveTheCeiling",
     "views",
     R"([{"name": "a", "plan": {"height": 3}}])",
     R"(#/views/0/plan/height: 3 m is not below the ceiling (room "office" is 3 m high))"},
    {"PlanWithTarget",
     "views",
     R"([{"name": "a", "plan": {}, "target": [1, 1, 1]}])",
     R"(#/views/0/target: "target" does not go with "plan" (give one of the two))",
     shape},
    {"HugeResolution",
     "views",
     R"([{"name": "a", "plan": {}, "resolution": [20000, 10]}])",
     R"(#/views/0/resolution/0: 20000 is too large (it must be at most 16384))",
     shape},
    {"LongResolution",
     "views",
     R"([{"name": "a", "plan": {}, "resolution": [20, 10, 3]}])",
     R"(#/views/0/resolution: the list has 3 elements ([columns, rows] is expected))",
     shape},
};

INSTANTIATE_TEST_SUITE_P(Views, MalformedViews, testing::ValuesIn(views), name_of);

} // namespace
} // namespace isolux::test
