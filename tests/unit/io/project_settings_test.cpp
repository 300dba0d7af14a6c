#include <gtest/gtest.h>

#include "support/malformed_project.h"

namespace isolux::test {
namespace {

class MalformedSettings : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedSettings, IsReportedInTheseWords) { expect_these_words(GetParam()); }

TEST_P(MalformedSettings, DepartsFromTheSchemaIfItsShapeIsWrong) {
    expect_schema_agrees(GetParam());
}

const Malformed top_level[] = {
    {"NoVersion",
     "isolux",
     "",
     R"(#: the key "isolux" is missing (it tells the version of the format). Add "isolux": 1?)",
     shape},
    {"NewerVersion",
     "isolux",
     "2",
     R"(#/isolux: this version of the format is not known (the only one is 1). Is a newer isolux needed?)",
     shape},
    {"UnknownKey",
     "luminaire",
     "[]",
     R"(#/luminaire: unknown key "luminaire" (a project has no such key). Did you mean "luminaires"?)",
     shape},
    {"EmptyName",
     "name",
     R"("")",
     R"(#/name: the text is empty (something must stand here))",
     shape},
    {"RoomsNoList",
     "rooms",
     R"({"name": "office"})",
     "#/rooms: a list is expected here (found an object)\n"
     R"(#/luminaires/0/field/room: unknown room "office" (rooms has no such name))",
     shape},
    {"NoLuminaires",
     "luminaires",
     "",
     R"(#: the key "luminaires" is missing (a project needs it))",
     shape},
    {"EmptyLuminaires",
     "luminaires",
     "[]",
     "#/luminaires: the list has 0 elements (at least 1 needed)",
     shape},
    {"MaintenanceFactorAboveOne",
     "maintenance_factor",
     "80",
     "#/maintenance_factor: 80 is too large (it must be at most 1). Write 0.8 for 80 %?",
     shape},
};

INSTANTIATE_TEST_SUITE_P(TopLevel, MalformedSettings, testing::ValuesIn(top_level), name_of);

const Malformed settings[] = {
    {"ToleranceZero",
     "settings",
     R"({"tolerance": 0})",
     "#/settings/tolerance: 0 is too small (it must be at least 0.0001)",
     shape},
    {"ToleranceAbove50Percent",
     "settings",
     R"({"tolerance": "60%"})",
     "#/settings/tolerance: 60 % is too large (it must be at most 50 %)"},
    {"ToleranceNoPercentage",
     "settings",
     R"({"tolerance": "one"})",
     R"(#/settings/tolerance: "one" is not a percentage (a number or text such as "1%" is expected))",
     shape},
    {"ConfidenceOne",
     "settings",
     R"({"confidence": 1})",
     "#/settings/confidence: 1 is too large (it must be at most 0.9999)",
     shape},
    {"TimeWithoutUnit",
     "settings",
     R"({"time_limit": "60"})",
     R"(#/settings/time_limit: "60" is not a time (a number of seconds or text such as "90s", "5min", "1h" is expected))",
     shape},
    {"TimeZero",
     "settings",
     R"({"time_limit": "0s"})",
     "#/settings/time_limit: a time limit of 0 s makes no sense (above 0, at most a year)"},
    {"SeedNotWhole",
     "settings",
     R"({"seed": 1.5})",
     "#/settings/seed: 1.5 is not a whole number (only whole numbers count here)",
     shape},
    {"UnknownEstimator",
     "settings",
     R"({"estimator": "path-trace"})",
     R"(#/settings/estimator: "path-trace" is not known here (it must be "automatic", "local-estimation", "local-estimation-mis" or "path-tracing"). Did you mean "path-tracing"?)",
     shape},
    {"DirectOnlyText",
     "settings",
     R"({"direct_only": "yes"})",
     "#/settings/direct_only: true or false is expected here (found text)",
     shape},
    {"UnknownContributions",
     "settings",
     R"({"contributions": "group"})",
     R"(#/settings/contributions: "group" is not known here (it must be "automatic", "none", "groups" or "luminaires"). Did you mean "groups"?)",
     shape},
    {"SensitivitiesNumber",
     "settings",
     R"({"sensitivities": 1})",
     "#/settings/sensitivities: true or false is expected here (found a number)",
     shape},
};

INSTANTIATE_TEST_SUITE_P(Settings, MalformedSettings, testing::ValuesIn(settings), name_of);

const Malformed materials[] = {
    {"ReflectanceAboveOne",
     "materials",
     R"({"paint": 70})",
     "#/materials/paint: 70 is too large (it must be at most 1). Write 0.7 for 70 %?",
     shape},
    {"NegativeReflectance",
     "materials",
     R"({"paint": {"reflectance": [0.5, -0.1, 0.5]}})",
     "#/materials/paint/reflectance/1: -0.1 is too small (it must be at least 0)",
     shape},
    {"TwoColourChannels",
     "materials",
     R"({"paint": [0.5, 0.5]})",
     "#/materials/paint: a list [red, green, blue] is expected here (found 2 elements)",
     shape},
    {"DiffuseAndMirrorAboveOne",
     "materials",
     R"({"paint": {"reflectance": 0.7, "mirror": 0.4}})",
     "#/materials/paint: diffuse reflectance and mirror share add up to 1.1 (more light "
     "would leave than arrives). Reduce one of the two"},
    {"OneSidedPane",
     "materials",
     R"({"glass": {"pane": {}, "sides": "front"}})",
     "#/materials/glass/sides: a pane has no dark side (light passes it both ways). Remove "
     "\"sides\""},
    {"PaneWithReflectance",
     "materials",
     R"({"glass": {"pane": {}, "reflectance": 0.1}})",
     R"(#/materials/glass/reflectance: "reflectance" does not go with "pane" (give one of the two))"},
    {"PaneTooClear",
     "materials",
     R"({"glass": {"pane": {"transmittance": 0.95}}})",
     "#/materials/glass/pane/transmittance: 0.95 is more than a pane of index 1.52 can "
     "transmit (its two surfaces leave 0.918). Leave the key out for clear glass?"},
    {"LikeUnknown",
     "materials",
     R"({"desk": {"like": "oack"}})",
     R"(#/materials/desk/like: unknown material "oack" (neither one of the project nor an everyday one). Did you mean "oak"?)"},
    {"LikeItself",
     "materials",
     R"({"a": {"like": "b"}, "b": {"like": "a"}})",
     R"(#/materials/b/like: "a" is like itself, directly or through others (where would its values come from?))"},
    {"NameAlone",
     "materials",
     R"({"desk": "oak"})",
     R"(#/materials/desk: a number, [red, green, blue] or an object {...} is expected here (found text). Write {"like": "oak"}?)",
     shape},
    {"NameTwice",
     "materials",
     R"({"desk": 0.5, "desk": 0.6})",
     R"(#/materials/desk: the key "desk" is there twice (only one can count))"},
};

INSTANTIATE_TEST_SUITE_P(Materials, MalformedSettings, testing::ValuesIn(materials), name_of);

} // namespace
} // namespace isolux::test
