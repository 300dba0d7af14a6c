#include <gtest/gtest.h>

#include "support/malformed_project.h"

namespace isolux::test {
namespace {

class MalformedSurfaces : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedSurfaces, IsReportedInTheseWords) { expect_these_words(GetParam()); }

TEST_P(MalformedSurfaces, DepartsFromTheSchemaIfItsShapeIsWrong) {
    expect_schema_agrees(GetParam());
}

const Malformed areas[] = {
    {"NoArea",
     "surfaces",
     R"([{"name": "desk"}])",
     R"(#/surfaces/0: a surface needs one of "work_plane", "floor", "ceiling", "wall", "rectangle", "polygon", "points" and "points_file" (none is given))",
     shape},
    {"SameNameTwice",
     "surfaces",
     R"([{"name": "desk", "work_plane": {}}, {"name": "Desk", "floor": {}}])",
     R"(#/surfaces/1/name: the surface name "Desk" is taken by entry 1 of "surfaces" (it names the result files))"},
    {"WorkPlaneAboveTheCeiling",
     "surfaces",
     R"([{"work_plane": {"height": 75}}])",
     R"(#/surfaces/0/work_plane/height: the work plane at 75 m is above the ceiling (room "office" is 3 m high))"},
    {"EdgeLeavesNothing",
     "surfaces",
     R"([{"work_plane": {"edge": 2}}])",
     R"(#/surfaces/0/work_plane: an edge band of 2 m leaves nothing of room "office" (no point would be measured). Make "edge" smaller?)"},
    {"EdgeLeavesNothingOfAWall",
     "surfaces",
     R"([{"wall": {"number": 1, "edge": 1.5}}])",
     "#/surfaces/0/wall: an edge band of 1.5 m leaves nothing of the wall (no point "
     R"(would be measured). Make "edge" smaller?)"},
    {"NoSuchWall",
     "surfaces",
     R"([{"wall": {"number": 5}}])",
     R"(#/surfaces/0/wall/number: there is no wall 5 (room "office" has walls 1 to 4))"},
    {"SideWithoutLength",
     "surfaces",
     R"([{"rectangle": {"corner": [0, 0, 1], "u": [0, 0, 0], "v": [0, 1, 0]}}])",
     "#/surfaces/0/rectangle/u: the side has no length (the rectangle has no area)"},
    {"SidesAskew",
     "surfaces",
     R"([{"rectangle": {"corner": [0, 0, 1], "u": [1, 0, 0], "v": [0.1, 1, 0]}}])",
     "#/surfaces/0/rectangle/v: v is not at right angles to u (the area would not be a "
     R"(rectangle). Use "polygon"?)"},
    {"NormalWithoutLength",
     "surfaces",
     R"([{"rectangle": {"centre": [1, 1, 1], "size": [1, 1], "normal": [0, 0, 0]}}])",
     "#/surfaces/0/rectangle/normal: the vector has no length (no direction follows from "
     "it)"},
    {"CornerWithSize",
     "surfaces",
     R"([{"rectangle": {"corner": [0, 0, 1], "u": [1, 0, 0], "v": [0, 1, 0], "size": [1, 1]}}])",
     R"(#/surfaces/0/rectangle/size: "size" does not go with "corner" (give one of the two))"},
    {"PolygonNotFlat",
     "surfaces",
     R"([{"polygon": [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1.1]]}])",
     "#/surfaces/0/polygon: the polygon is not flat (a corner is 0.0499 m off the plane "
     "of the others)"},
    {"PolygonCrossesItself",
     "surfaces",
     R"([{"polygon": [[0, 0, 1], [2, 0, 1], [2, 2, 1], [0.5, -1, 1]]}])",
     "#/surfaces/0/polygon: the outline crosses or touches itself (it has no clear "
     "inside). Are two corners in the wrong order?"},
    {"PolygonWithoutArea",
     "surfaces",
     R"([{"polygon": [[0, 0, 1], [1, 0, 1], [2, 0, 1]]}])",
     "#/surfaces/0/polygon: the polygon has no area (or corners that coincide)"},
    {"WhichRoom",
     "surfaces",
     R"([{"work_plane": {"room": "hall"}}])",
     R"(#/surfaces/0/work_plane/room: unknown room "hall" (rooms has no such name))"},
};

INSTANTIATE_TEST_SUITE_P(Areas, MalformedSurfaces, testing::ValuesIn(areas), name_of);

const Malformed grids[] = {
    {"SpacingZero",
     "surfaces",
     R"([{"work_plane": {}, "grid": {"spacing": 0}}])",
     "#/surfaces/0/grid/spacing: 0 is too small (it must be above 0 m)",
     shape},
    {"WallByName",
     "surfaces",
     R"([{"wall": "north"}])",
     "#/surfaces/0/wall: a wall is an object {\"number\": 1} (found text). Wall 1 runs from "
     "(0, "
     "0) to (6, 0), wall 2 on to (6, 4), wall 3 on to (0, 4), wall 4 back to (0, 0)",
     shape},
    {"RectangleInMillimetres",
     "surfaces",
     R"([{"rectangle": {"corner": [0, 0, 0.8], "u": [60000, 0, 0], "v": [0, 40000, 0]}}])",
     "#/surfaces/0: the grid has too many points (at most 1000000 a surface). Is the size of "
     "60000 m x 40000 m in metres?"},
    {"SpacingInMillimetres",
     "surfaces",
     R"([{"work_plane": {}, "grid": {"spacing": 0.0005}}])",
     "#/surfaces/0: the grid has too many points (at most 1000000 a surface). Is the "
     "spacing in metres?"},
    {"NoColumns",
     "surfaces",
     R"([{"work_plane": {}, "grid": {"columns": 0, "rows": 3}}])",
     "#/surfaces/0/grid/columns: 0 is too small (it must be at least 1)",
     shape},
    {"ColumnsWithoutRows",
     "surfaces",
     R"([{"work_plane": {}, "grid": {"columns": 4}}])",
     R"(#/surfaces/0/grid: the key "rows" is missing (a grid needs it))",
     shape},
    {"SpacingAndCounts",
     "surfaces",
     R"([{"work_plane": {}, "grid": {"spacing": 1, "columns": 4, "rows": 3}}])",
     R"(#/surfaces/0/grid: "spacing" and "columns" exclude each other (a grid has one of them))",
     shape},
    {"NotStandard",
     "surfaces",
     R"([{"work_plane": {}, "grid": "fine"}])",
     R"(#/surfaces/0/grid: "fine" is not known here (it must be "standard"))",
     shape},
    {"GridOfPoints",
     "surfaces",
     R"([{"points": [[1, 1, 1]], "grid": "standard"}])",
     R"(#/surfaces/0/grid: "grid" does not go with "points" (give one of the two))"},
    {"GridMissesTheArea",
     "surfaces",
     R"([{"polygon": [[0, 0, 1], [4, 0, 1], [4, 4, 1], [3.9, 0.1, 1]], "grid": {"columns": 1, "rows": 1}}])",
     "#/surfaces/0: no point of the grid lies on the surface (nothing would be "
     "measured). Choose a finer grid?"},
};

INSTANTIATE_TEST_SUITE_P(Grids, MalformedSurfaces, testing::ValuesIn(grids), name_of);

const Malformed points[] = {
    {"PointOfFourNumbers",
     "surfaces",
     R"([{"points": [[1, 1, 1], [1, 1, 1, 0]]}])",
     "#/surfaces/0/points/1: 4 numbers ([x, y, z] or [x, y, z, nx, ny, nz] is expected)",
     shape},
    {"PointFacingNowhere",
     "surfaces",
     R"([{"points": [[1, 1, 1, 0, 0, 0]]}])",
     "#/surfaces/0/points/0: the normal has no length (which way does the point face?)"},
    {"NoPoints",
     "surfaces",
     R"([{"points": []}])",
     "#/surfaces/0/points: the list has 0 elements (at least 1 needed)",
     shape},
    {"NoPointsFile",
     "surfaces",
     R"([{"points_file": "sensors.pts"}])",
     R"(#/surfaces/0/points_file: cannot find "sensors.pts" (no such file))"},
};

INSTANTIATE_TEST_SUITE_P(Points, MalformedSurfaces, testing::ValuesIn(points), name_of);

const Malformed quantities[] = {
    {"UnknownQuantity",
     "surfaces",
     R"([{"work_plane": {}, "quantity": "lux"}])",
     R"(#/surfaces/0/quantity: "lux" is not known here (it must be "illuminance", "cylindrical", "semi-cylindrical", "hemispherical" or "mean-spherical"))",
     shape},
    {"SemiCylinderFacingNowhere",
     "surfaces",
     R"([{"work_plane": {}, "quantity": "semi-cylindrical"}])",
     R"(#/surfaces/0: the key "direction" is missing (which way does the semi-cylinder face?))"},
    {"SemiCylinderWithoutDirection",
     "surfaces",
     R"([{"work_plane": {}, "quantity": "semi-cylindrical", "direction": [0, 0]}])",
     "#/surfaces/0/direction: the vector has no length (no direction follows from it)"},
    {"DirectionOfAPlane",
     "surfaces",
     R"([{"work_plane": {}, "direction": 90}])",
     R"(#/surfaces/0/direction: only "quantity": "semi-cylindrical" has a direction (this surface has another quantity))"},
};

INSTANTIATE_TEST_SUITE_P(Quantities, MalformedSurfaces, testing::ValuesIn(quantities), name_of);

} // namespace
} // namespace isolux::test
