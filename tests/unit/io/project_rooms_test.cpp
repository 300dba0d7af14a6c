#include <gtest/gtest.h>

#include "support/malformed_project.h"

namespace isolux::test {
namespace {

class MalformedRooms : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedRooms, IsReportedInTheseWords) { expect_these_words(GetParam()); }

TEST_P(MalformedRooms, DepartsFromTheSchemaIfItsShapeIsWrong) {
    expect_schema_agrees(GetParam());
}

const Malformed rooms[] = {
    {"NoHeight",
     "rooms",
     R"([{"name": "office", "size": [6, 4]}])",
     R"(#/rooms/0: the key "height" is missing (a room needs it))",
     shape},
    {"HeightNegative",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": -3}])",
     "#/rooms/0/height: -3 is too small (it must be above 0 m)",
     shape},
    {"HeightText",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": "3 m"}])",
     "#/rooms/0/height: a number is expected here (found text). Write 3 without quotes?",
     shape},
    {"SizeAndFootprint",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "footprint": [[0, 0], [6, 0], [6, 4]], "height": 3}])",
     R"(#/rooms/0: "size" and "footprint" exclude each other (a room has one of them))",
     shape},
    {"NeitherSizeNorFootprint",
     "rooms",
     R"([{"name": "office", "height": 3}])",
     R"(#/rooms/0: a room needs one of "size" and "footprint" (none is given))",
     shape},
    {"FootprintCrossesItself",
     "rooms",
     R"([{"name": "office", "footprint": [[0, 0], [6, 4], [6, 0], [0, 4]], "height": 3}])",
     "#/rooms/0/footprint: the outline crosses or touches itself (it has no clear "
     "inside). Are two corners in the wrong order?"},
    {"FootprintClockwise",
     "rooms",
     R"([{"name": "office", "footprint": [[0, 0], [0, 4], [6, 4], [6, 0]], "height": 3}])",
     "#/rooms/0/footprint: the footprint runs clockwise (walls are numbered "
     "counter-clockwise seen from above). Write the corners in the opposite order?"},
    {"FootprintClosedTwice",
     "rooms",
     R"([{"name": "office", "footprint": [[0, 0], [6, 0], [6, 4], [0, 0]], "height": 3}])",
     "#/rooms/0/footprint: corners 4 and 1 coincide (no wall fits between them). Leave "
     "out the last corner: the outline closes by itself"},
    {"FootprintOfTwoCorners",
     "rooms",
     R"([{"name": "office", "footprint": [[0, 0], [6, 0]], "height": 3}])",
     "#/rooms/0/footprint: the list has 2 elements (at least 3 needed)",
     shape},
    {"SameNameTwice",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3}, {"name": "office", "size": [6, 4], "position": [6, 0], "height": 3}])",
     R"(#/rooms/1: the room name "office" is taken (rooms are found by name))"},
    {"Overlap",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3}, {"name": "hall", "size": [6, 4], "position": [5.9, 0], "height": 3}])",
     R"(#/rooms/1: room "hall" overlaps room "office" (each place belongs to one room). Give it a "position" beside the other?)"},
    {"UnknownFinish",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "reflectances": {"ceiling": "white pant"}}])",
     R"(#/rooms/0/reflectances/ceiling: unknown material "white pant" (neither one of the project nor an everyday one). Did you mean "white paint"?)"},
    {"FifthWallOfFour",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "reflectances": {"wall 5": 0.3}}])",
     "#/rooms/0/reflectances/wall 5: there is no wall 5 (the room has walls 1 to 4)"},
    {"MisspeltFinish",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "reflectances": {"cieling": 0.8}}])",
     R"(#/rooms/0/reflectances/cieling: unknown key "cieling" (reflectances has no such key). Did you mean "ceiling"?)",
     shape},
    {"TooFarAway",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "position": [1e7, 0]}])",
     "#/rooms/0/position/0: 10000000 is too large (it must be at most 1000000 m)",
     shape},
};

INSTANTIATE_TEST_SUITE_P(Rooms, MalformedRooms, testing::ValuesIn(rooms), name_of);

const Malformed openings[] = {
    {"BeyondTheWall",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [{"wall": 2, "offset": 3.5, "width": 1, "height": 2}]}])",
     "#/rooms/0/openings/0: the opening ends 4.5 m along wall 2 (the wall is 4 m long)"},
    {"ThroughTheCeiling",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [{"wall": 1, "offset": 0, "sill": 2, "width": 1, "height": 2}]}])",
     "#/rooms/0/openings/0: the opening ends 4 m above the floor (the room is 3 m high)"},
    {"InNoWall",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [{"wall": 7, "offset": 0, "width": 1, "height": 2}]}])",
     "#/rooms/0/openings/0/wall: there is no wall 7 (the room has walls 1 to 4)"},
    {"Overlap",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [
                  {"name": "door", "wall": 1, "offset": 0, "width": 1, "height": 2},
                  {"wall": 1, "offset": 0.9, "sill": 1, "width": 1, "height": 1}]}])",
     R"(#/rooms/0/openings/1: the opening overlaps "door" (each place of a wall belongs to one opening))"},
    {"GlazedWithWood",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [{"wall": 1, "offset": 0, "width": 1, "height": 2, "state": "glazed", "material": "oak"}]}])",
     "#/rooms/0/openings/0/material: the material of a glazed opening is not a pane (it "
     R"(would be opaque). Make its state "closed"?)"},
    {"ClosedWithGlass",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [{"wall": 1, "offset": 0, "width": 1, "height": 2, "state": "closed", "material": "window glass"}]}])",
     "#/rooms/0/openings/0/material: the material of a closed opening is a pane (light "
     R"(would pass). Make its state "glazed"?)"},
    {"HoleOfOak",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [{"wall": 1, "offset": 0, "width": 1, "height": 2, "material": "oak"}]}])",
     "#/rooms/0/openings/0/material: an open opening has no material (there is nothing). "
     R"(Make its state "closed" or "glazed"?)"},
    {"SameName",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "openings": [
                  {"name": "door", "wall": 1, "offset": 0, "width": 1, "height": 2},
                  {"name": "door", "wall": 2, "offset": 0, "width": 1, "height": 2}]}])",
     R"(#/rooms/0/openings/1: the name "door" is taken by another opening of this room (surfaces are found by name))"},
    {"ColumnInTheWall",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "columns": [{"centre": [0, 2], "size": [0.4, 0.4]}]}])",
     "#/rooms/0/columns/0: the column does not stand free inside the footprint (columns "
     "and walls must not touch). Make a column at a wall part of the footprint?"},
    {"ColumnsTouch",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "columns": [{"centre": [2, 2], "diameter": 0.4}, {"centre": [2.1, 2], "size": [0.4, 0.4]}]}])",
     "#/rooms/0/columns/1: the column touches column 1 (columns must stand apart)"},
    {"ColumnWithoutSize",
     "rooms",
     R"([{"name": "office", "size": [6, 4], "height": 3, "columns": [{"centre": [2, 2]}]}])",
     R"(#/rooms/0/columns/0: a column needs one of "outline", "size" and "diameter" (none is given))",
     shape},
};

INSTANTIATE_TEST_SUITE_P(Openings, MalformedRooms, testing::ValuesIn(openings), name_of);

const Malformed objects[] = {
    {"BoxOfNoHeight",
     "objects",
     R"([{"box": [1, 1, 0]}])",
     "#/objects/0/box/2: 0 is too small (it must be above 0 m)",
     shape},
    {"BoxAndPanel",
     "objects",
     R"([{"box": [1, 1, 1], "panel": [1, 1]}])",
     R"(#/objects/0: "box" and "panel" exclude each other (an object has one of them))",
     shape},
    {"NoMesh",
     "objects",
     R"([{"mesh": "nowhere/chair.obj"}])",
     R"(#/objects/0/mesh: cannot find "nowhere/chair.obj" (there is no folder "nowhere"). Paths are relative to the project file)"},
    {"MeshOfUnknownFormat",
     "objects",
     R"([{"mesh": "chair.blend"}])",
     R"(#/objects/0/mesh: "chair.blend" is not a mesh file we read (obj, ply, stl and off are))"},
    {"PositionInThePlane",
     "objects",
     R"([{"box": [1, 1, 1], "position": [1, 2]}])",
     "#/objects/0/position: a list [x, y, z] is expected here (found 2 elements)",
     shape},
    {"ScaleZero",
     "objects",
     R"([{"box": [1, 1, 1], "scale": 0}])",
     "#/objects/0/scale: a factor of 0 leaves nothing of the object (it must not be 0)",
     shape},
    {"UnknownMaterial",
     "objects",
     R"([{"box": [1, 1, 1], "material": "okk"}])",
     R"(#/objects/0/material: unknown material "okk" (neither one of the project nor an everyday one). Did you mean "oak"?)"},
    {"BoxWithMaterials",
     "objects",
     R"([{"box": [1, 1, 1], "materials": {}}])",
     R"(#/objects/0/materials: "materials" does not go with "box" (give one of the two))"},
    {"ArrayOfDifferentLengths",
     "objects",
     R"([{"box": [1, 1, 1], "array": {"count": [2, 2, 2], "spacing": [1, 1]}}])",
     "#/objects/0/array: count has 3 numbers, spacing 2 (they belong together)"},
    {"ArrayTooLarge",
     "objects",
     R"([{"box": [1, 1, 1], "array": {"count": [200, 200], "spacing": [1, 1]}}])",
     "#/objects/0/array/count: 40000 copies are too many (at most 10000)"},
    {"CylinderOfTwoSides",
     "objects",
     R"([{"cylinder": {"diameter": 1, "height": 1, "segments": 2}}])",
     "#/objects/0/cylinder/segments: 2 is too small (it must be at least 3)",
     shape},
};

INSTANTIATE_TEST_SUITE_P(Objects, MalformedRooms, testing::ValuesIn(objects), name_of);

} // namespace
} // namespace isolux::test
