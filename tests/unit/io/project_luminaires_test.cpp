#include <fstream>
#include <variant>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/malformed_project.h"
#include "support/stored_zip.h"
#include "support/temporary_folder.h"

namespace isolux::test {
namespace {

class MalformedLuminaires : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedLuminaires, IsReportedInTheseWords) { expect_these_words(GetParam()); }

TEST_P(MalformedLuminaires, DepartsFromTheSchemaIfItsShapeIsWrong) {
    expect_schema_agrees(GetParam());
}

const Malformed types[] = {
    {"NoTypes",
     "luminaire_types",
     "{}",
     "#/luminaire_types: there are no luminaire types (a project needs at least one)\n"
     R"(#/luminaires/0/type: unknown luminaire type "panel" (luminaire_types has no such member))",
     shape},
    {"NoFlux",
     "luminaire_types",
     R"({"panel": {"lambertian": {"size": [0.6, 0.6]}}})",
     R"(#/luminaire_types/panel/lambertian: the key "flux" is missing (a lambertian opening needs it))",
     shape},
    {"FluxNegative",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": -470}}})",
     "#/luminaire_types/panel/isotropic/flux: -470 is too small (it must be above 0 lm)",
     shape},
    {"FluxOutside",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": 470}, "flux": 400}})",
     R"(#/luminaire_types/panel/flux: "flux" does not go with "isotropic" (give one of the two))"},
    {"SizeAndDiameter",
     "luminaire_types",
     R"({"panel": {"lambertian": {"size": [1, 1], "diameter": 1, "flux": 1}}})",
     R"(#/luminaire_types/panel/lambertian: "size" and "diameter" exclude each other (a lambertian opening has one of them))",
     shape},
    {"NoSource",
     "luminaire_types",
     R"({"panel": {"maintenance_factor": 0.8}})",
     R"(#/luminaire_types/panel: a luminaire type needs one of "file", "lambertian" and "isotropic" (none is given))",
     shape},
    {"NoSuchFile",
     "luminaire_types",
     R"({"panel": {"file": "nowhere.ies"}})",
     R"(#/luminaire_types/panel/file: cannot find "nowhere.ies" (no such file))"},
    {"FileIsAFolder",
     "luminaire_types",
     R"({"panel": {"file": "."}})",
     R"(#/luminaire_types/panel/file: "." is a folder (a file belongs here))"},
    {"BodyOfAPoint",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": 470}, "body": "absorbing"}})",
     "#/luminaire_types/panel/body: a luminaire with a point for an opening has no body "
     R"((it has no size). Give it an "opening"?)"},
    {"BlackLight",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": 470}, "colour": [0, 0, 0]}})",
     "#/luminaire_types/panel/colour: the colour is black (a luminaire of that colour "
     "gives no light)"},
    {"DimmedAboveFull",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": 470}, "dimming": 1.2}})",
     "#/luminaire_types/panel/dimming: 1.2 is too large (it must be at most 1)",
     shape},
    {"LampSetZero",
     "luminaire_types",
     R"({"panel": {"file": ".", "lamp_set": 0}})",
     "#/luminaire_types/panel/lamp_set: 0 is too small (it must be at least 1)\n"
     R"(#/luminaire_types/panel/file: "." is a folder (a file belongs here))",
     shape},
    {"VariantOfABareBulb",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": 470}, "variant": "2"}})",
     R"(#/luminaire_types/panel/variant: "variant" does not go with "isotropic" (give one of the two))"},
};

INSTANTIATE_TEST_SUITE_P(Types, MalformedLuminaires, testing::ValuesIn(types), name_of);

const Malformed other_words[] = {
    {"LumenForFlux",
     "luminaire_types",
     R"({"panel": {"isotropic": {"flux": 470}, "lumen": 500}})",
     R"(#/luminaire_types/panel/lumen: unknown key "lumen" (a luminaire type has no such key). Did you mean "flux"?)",
     shape},
};

INSTANTIATE_TEST_SUITE_P(OtherWords,
                         MalformedLuminaires,
                         testing::ValuesIn(other_words),
                         name_of);

const Malformed placement[] = {
    {"UnknownType",
     "luminaires",
     R"([{"type": "pannel", "position": [1, 1, 2]}])",
     R"(#/luminaires/0/type: unknown luminaire type "pannel" (luminaire_types has no such member). Did you mean "panel"?)"},
    {"NoPlace",
     "luminaires",
     R"([{"type": "panel"}])",
     R"(#/luminaires/0: a luminaire needs one of "position", "positions", "field", "line" and "ring" (none is given))",
     shape},
    {"AboveTheCeiling",
     "luminaires",
     R"([{"type": "panel", "position": [1, 1, 3.2]}])",
     "#/luminaires/0/position: the luminaire at (1, 1, 3.2) is outside every room (no "
     R"(wall would reflect its light). Room "office" reaches from z = 0 m to 3 m)"},
    {"BesideTheRoom",
     "luminaires",
     R"([{"type": "panel", "positions": [[1, 1, 2], [7, 1, 2]]}])",
     "#/luminaires/0/positions/1: the luminaire at (7, 1, 2) is outside every room (no "
     R"(wall would reflect its light). Room "office" reaches from (0, 0, 0) to (6, 4, 3))"},
    {"LineBesideTheRoom",
     "luminaires",
     R"([{"type": "panel", "line": {"from": [5, 1, 2], "to": [9, 1, 2], "count": 5}}])",
     "#/luminaires/0/line: 3 of 5 luminaires are outside every room, the first at (7, 1, 2) "
     "(no wall would reflect their light). "
     R"(Room "office" reaches from (0, 0, 0) to (6, 4, 3))"},
    {"LineInMillimetres",
     "luminaires",
     R"([{"type": "panel", "line": {"from": [500, 1000, 2800], "to": [5500, 1000, 2800], "count": 3}}])",
     "#/luminaires/0/line: all 3 luminaires are outside every room, the first at (500, 1000, "
     "2800) (no wall would reflect their light). Is it in metres? "
     R"(Room "office" reaches from (0, 0, 0) to (6, 4, 3))"},
    {"RotateForRotation",
     "luminaires",
     R"([{"type": "panel", "position": [1, 1, 2], "rotate": 90}])",
     R"(#/luminaires/0/rotate: unknown key "rotate" (a luminaire has no such key). Did you mean "rotation"?)",
     shape},
    {"AimEqualsPosition",
     "luminaires",
     R"([{"type": "panel", "position": [1, 1, 2], "aim": [1, 1, 2]}])",
     "#/luminaires/0/aim: the aim equals the position (no direction follows from it). "
     "Aim at the floor below?"},
    {"AimAndTilt",
     "luminaires",
     R"([{"type": "panel", "position": [1, 1, 2], "aim": [1, 1, 0], "tilt": 10}])",
     R"(#/luminaires/0/tilt: "tilt" does not go with "aim" (give one of the two))"},
    {"SpinWithoutAim",
     "luminaires",
     R"([{"type": "panel", "position": [1, 1, 2], "spin": 90}])",
     R"(#/luminaires/0/spin: "spin" turns about the aim (there is no "aim"). Use "rotation" instead?)"},
    {"UnknownRoom",
     "luminaires",
     R"([{"type": "panel", "field": {"room": "Offise", "rows": 1, "columns": 1}}])",
     R"(#/luminaires/0/field/room: unknown room "Offise" (rooms has no such name). Did you mean "office"?)"},
    {"ZeroRows",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 0, "columns": 2}}])",
     "#/luminaires/0/field/rows: 0 is too small (it must be at least 1)",
     shape},
    {"FieldAboveTheCeiling",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 1, "columns": 2, "height": 3.5}}])",
     R"(#/luminaires/0/field/height: 3.5 m is above the ceiling (room "office" is 3 m high))"},
    {"FieldBelowTheFloor",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 1, "columns": 2, "suspended": 3}}])",
     R"(#/luminaires/0/field/suspended: 3 m below the ceiling is below the floor (room "office" is 3 m high))"},
    {"HeightAndSuspended",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 1, "columns": 2, "height": 2.5, "suspended": 0.5}}])",
     R"(#/luminaires/0/field/suspended: "suspended" does not go with "height" (give one of the two))"},
    {"FieldOutsideTheRoom",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 1, "columns": 2, "corner": [10, 10], "size": [1, 1]}}])",
     R"(#/luminaires/0/field: no luminaire of the field lies in room "office" (all are left out))"},
    {"FieldBeyondTheRoom",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 1, "columns": 2, "corner": [10, 10]}}])",
     "#/luminaires/0/field/corner: the corner lies beyond the room (nothing is left to "
     "fill)"},
    {"FieldTooLarge",
     "luminaires",
     R"([{"type": "panel", "field": {"rows": 200, "columns": 200}}])",
     "#/luminaires/0/field: 40000 luminaires are too many (at most 10000 an entry)"},
    {"LineInOnePlace",
     "luminaires",
     R"([{"type": "panel", "line": {"from": [1, 1, 2], "to": [1, 1, 2], "count": 2}}])",
     "#/luminaires/0/line: the line starts where it ends (its luminaires would hang in "
     "one place)"},
    {"RingWithoutRadius",
     "luminaires",
     R"([{"type": "panel", "ring": {"centre": [3, 2, 2], "count": 6}}])",
     R"(#/luminaires/0/ring: the key "radius" is missing (a ring needs it))",
     shape},
    {"OutwardsAndAim",
     "luminaires",
     R"([{"type": "panel", "ring": {"centre": [3, 2, 2], "radius": 1, "count": 4, "outwards": true}, "aim": [3, 2, 0]}])",
     R"(#/luminaires/0: "outwards" does not go with "aim" (both say where the luminaires look))"},
    {"AllOff",
     "luminaires",
     R"([{"type": "panel", "position": [1, 1, 2], "dimming": 0}])",
     "#/luminaires: all luminaires are dimmed to 0 (there would be no light)"},
};

INSTANTIATE_TEST_SUITE_P(Placement, MalformedLuminaires, testing::ValuesIn(placement), name_of);

// ---- containers -----------------------------------------------------------------------------

TEST(LuminaireTypeOfAContainer, IsTheVariantAskedFor) {
    const auto ies = [](int candela) {
        return "IESNA:LM-63-2002\n[TEST] 1\n[TESTLAB] l\n[ISSUEDATE] d\n[MANUFAC] "
               "m\nTILT=NONE\n"
               "1 -1 1 2 1 1 2 0.2 0.4 0\n1 1 5\n0 90\n0\n"
               + std::to_string(candela) + " " + std::to_string(candela) + "\n";
    };
    std::string general = "<Root><GeneralDefinitions><Files>";
    std::string photometries;
    std::string emitters;
    std::string variants;
    for (const std::string n : {"1", "2"}) {
        general += "<File id=\"f" + n + "\" contentType=\"ldc/ies\" type=\"localFileName\">" + n
                   + ".ies</File>";
        photometries += "<Photometry id=\"p" + n + "\"><PhotometryFileReference fileId=\"f" + n
                        + "\"/></Photometry>";
        emitters += "<Emitter id=\"e" + n
                    + "\"><FixedLightEmitter><PhotometryReference photometryId=\"p" + n
                    + "\"/></FixedLightEmitter></Emitter>";
        variants += "<Variant id=\"v" + n + "\"><Geometry><EmitterReference emitterId=\"e" + n
                    + "\"/></Geometry></Variant>";
    }
    const test::TemporaryFolder folder;
    std::ofstream(folder.path() / "lamp.gldf", std::ios::binary) << test::stored_zip(
        {{"product.xml",
          general + "</Files><Photometries>" + photometries + "</Photometries><Emitters>"
              + emitters + "</Emitters></GeneralDefinitions><ProductDefinitions><Variants>"
              + variants + "</Variants></ProductDefinitions></Root>"},
         {"ldc/1.ies", ies(100)},
         {"ldc/2.ies", ies(200)}});
    const auto max_candela = [&](const std::string& variant) {
        const Project project = parse_project(
            test::small_project(
                {{"luminaire_types",
                  R"({"panel": {"file": "lamp.gldf", "variant": ")" + variant + "\"}}"}}),
            (folder.path() / "p.json").generic_string());
        return std::get<LuminairePhotometry>(project.scene.luminaire_types.at(0).source)
            .distribution.max_intensity()
            .value();
    };
    EXPECT_EQ(max_candela("v1"), 100.0);
    EXPECT_EQ(max_candela("2"), 200.0);
    EXPECT_THAT([&] { max_candela("v3"); },
                testing::ThrowsMessage<InputError>(
                    testing::HasSubstr("variant 'v3' asked for (there are 2")));
}

} // namespace
} // namespace isolux::test
