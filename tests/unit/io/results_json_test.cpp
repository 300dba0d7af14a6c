#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "isolux/io/contributions_file.h"
#include "isolux/io/csv.h"
#include "isolux/io/results_json.h"
#include "isolux/io/safe_file.h"
#include "isolux/io/schema.h"

#include "support/sample_results.h"
#include "support/temporary_folder.h"

namespace isolux {
namespace {

using nlohmann::json;
using testing::UnorderedElementsAre;

/// A room with two luminaires of a type that is laid along x, turned, and a bulb.
Scene make_scene() {
    SceneDescription d;
    d.materials = {{"paint", Opaque{Rgb::grey(0.5), 0.0}, Sides::both}};
    Room room;
    room.name = "office";
    room.footprint = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
    room.height = 2.8;
    room.walls.resize(4);
    d.rooms = {room};
    LuminaireType panel;
    panel.name = "panel";
    panel.source = LambertianSource{Lumen(4000.0 / 3.0)};
    panel.opening = {OpeningShape::rectangle, Metre(0.3), Metre(1.2), Metre(0)};
    LuminaireType bulb;
    bulb.name = "bulb";
    bulb.source = IsotropicSource{Lumen(800)};
    d.luminaire_types = {panel, bulb};
    LuminairePlacement a;
    a.name = "panel 1";
    a.world_from_luminaire =
        make_tilted_frame({3, 1, 2.7}, degrees(90), degrees(7), degrees(3));
    a.scale = 0.8;
    a.group = "window";
    LuminairePlacement b;
    b.name = "bulb 1";
    b.type = LuminaireTypeId(1);
    b.world_from_luminaire.origin = {5, 3, 2.5};
    d.luminaires = {a, b};
    return build_scene(std::move(d));
}

ResultsDocument make_document() {
    Settings settings;
    settings.seed = 9223372036854775807ULL;
    settings.tolerance = 0.02;
    Project project;
    project.name = "Büro \"4\"";
    project.file = {"office.json", std::string(64, 'a')};
    project.inputs = {{"a.ies", std::string(64, 'b')}};
    project.notices = {{"office.json", "the project's own notice", ""}};
    ScheduleEntry entry{"panel", "a.ies", "Maker", "Panel", 9, 3600.0, 36.0, 80.0, {}};
    entry.maintenance = {0.8, true, 0.9, 1.0, 0.95, 0.94};
    project.schedule = {entry, {"bulb", "", "", "", 1, 470.0, {}, {}, {}}};
    project.description = "Two rooms & a corridor";
    ResultsDocument document = make_results_document(project, settings, test::make_results());
    document.plan = make_plan(make_scene());
    const std::vector<std::string> aligned{"panel"};
    mark_aligned(document.plan, aligned);
    return document;
}

/// Complaints of valijson about a document, one a line.
std::string violations(const json& document) {
    const json text = json::parse(results_schema());
    valijson::Schema schema;
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    const valijson::adapters::NlohmannJsonAdapter schema_adapter(text);
    parser.populateSchema(schema_adapter, schema);
    valijson::Validator validator;
    valijson::ValidationResults found;
    const valijson::adapters::NlohmannJsonAdapter target(document);
    std::string all;
    if (!validator.validate(schema, target, &found))
        for (const auto& error : found) {
            for (const std::string& step : error.context)
                all += step;
            all.append(": ").append(error.description).append("\n");
        }
    return all;
}

TEST(ResultsJson, IsValidAgainstThePublishedSchema) {
    EXPECT_EQ(violations(json::parse(to_results_json(make_document()))), "");
    Results nothing;
    nothing.surfaces.push_back({});
    Project empty;
    empty.file.sha256 = std::string(64, '0');
    EXPECT_EQ(
        violations(json::parse(to_results_json(make_results_document(empty, {}, nothing)))),
        "");
}

TEST(ResultsJson, SchemaNoticesWhatDoesNotBelong) {
    const json good = json::parse(to_results_json(make_document()));
    const auto is_refused = [&](const char* pointer, const json& value) {
        json bad = good;
        bad[json::json_pointer(pointer)] = value;
        return !violations(bad).empty();
    };
    EXPECT_TRUE(is_refused("/surprise", 1));
    EXPECT_TRUE(is_refused("/surfaces/0/unit", "fc"));
    EXPECT_TRUE(is_refused("/surfaces/0/points/0/value", nullptr));
    EXPECT_TRUE(is_refused("/surfaces/0/points/0/flags/0", "odd"));
    EXPECT_TRUE(is_refused("/surfaces/0/quantity", "luminance"));
    EXPECT_TRUE(is_refused("/project/sha256", "abc"));
    EXPECT_TRUE(is_refused("/confidence", 95));
}

TEST(ResultsJson, HasTheMembersThatScriptsRelyOn) {
    const json d = json::parse(to_results_json(make_document()));
    const Results r = test::make_results();
    EXPECT_EQ(d["version"], std::string(isolux_version()));
    EXPECT_EQ(d["project"]["name"], "Büro \"4\"");
    EXPECT_EQ(d["inputs"][0]["file"], "a.ies");
    EXPECT_EQ(d["seed"].get<std::uint64_t>(), 9223372036854775807ULL);
    EXPECT_EQ(d["tolerance"], 0.02);
    EXPECT_EQ(d["confidence"], 0.95);
    EXPECT_EQ(d["rays"], 300000021000);
    EXPECT_EQ(d["time"], (json{{"wall_s", 1.25}, {"cpu_s", 9.5}}));
    EXPECT_EQ(d["converged"], false);
    EXPECT_EQ(d["notices"][0]["what"], "the project's own notice");
    EXPECT_EQ(d["notices"][1]["what"], "outside every room");
    const json& s = d["surfaces"][0];
    EXPECT_EQ(s["name"], "office/work \"plane\", 1");
    EXPECT_EQ(s["quantity"], "illuminance");
    EXPECT_EQ(s["unit"], "lx");
    EXPECT_EQ(s["grid"]["columns"], 3);
    EXPECT_EQ(s["grid"]["rows"], 2);
    EXPECT_FALSE(d["surfaces"][1].contains("grid"));
    const json& p = s["points"][1];
    EXPECT_EQ(p["position"], (json{1.5, 0.5, 0.75}));
    EXPECT_EQ(p["normal"], (json{0.0, 0.0, 1.0}));
    EXPECT_EQ(p["value"], r.surfaces[0].points[1].total.mean);
    EXPECT_EQ(p["direct"], r.surfaces[0].points[1].direct.mean);
    EXPECT_EQ(p["flags"], (json{"heavy_tail", "near_surface"}));
    const Interval interval = confidence_interval(r.surfaces[0].points[1].total, 0.97);
    EXPECT_EQ(p["lower"], interval.lower);
    EXPECT_EQ(p["upper"], interval.upper);
    for (const char* name : {"mean", "minimum", "maximum", "U0", "Ud"})
        for (const char* member : {"value", "standard_error", "lower", "upper"})
            EXPECT_TRUE(s["summary"][name][member].is_number()) << name << ' ' << member;
    EXPECT_EQ(d["flux_balance"]["escaped"]["value"], 8.5);
}

TEST(ResultsJson, ReadsBackToTheLastBit) {
    const std::string text = to_results_json(make_document());
    const ResultsDocument d = parse_results_json(text, "results.json");
    EXPECT_EQ(to_results_json(d), text);
    const CalculationSurface before = make_document().results.surfaces[0].surface;
    const CalculationSurface after = d.results.surfaces[0].surface;
    EXPECT_EQ(after.outline, before.outline);
    EXPECT_EQ(after.grid->cell_of_point, before.grid->cell_of_point);
    EXPECT_EQ(after.grid->frame.z, before.grid->frame.z);
    EXPECT_EQ(d.results.surfaces[1].surface.receivers[0].kind,
              IlluminanceKind::semi_cylindrical);
    EXPECT_EQ(d.results.surfaces[1].surface.receivers[0].reference,
              UnitVector3::from_unit({-1, 0, 0}));
    EXPECT_EQ(d.results.notices, make_document().results.notices);
}

TEST(ResultsJson, RecordsWhatHangsWhere) {
    const json d = json::parse(to_results_json(make_document()));
    EXPECT_EQ(d["project"]["description"], "Two rooms & a corridor");
    const json& types = d["installation"]["luminaire_types"];
    ASSERT_EQ(types.size(), 2u);
    EXPECT_EQ(types[0]["name"], "panel");
    EXPECT_EQ(types[0]["align_length_axis"], true);
    EXPECT_EQ(types[0]["long_side"], (json{{"axis", "y"}, {"length_m", 1.2}}));
    EXPECT_EQ(types[0]["flux_lm"], 4000.0 / 3.0);
    EXPECT_EQ(types[1]["align_length_axis"], false);
    EXPECT_FALSE(types[1].contains("long_side"));
    const json& curves = types[0]["curves"];
    EXPECT_EQ(curves["gamma"].size(), 181u);
    // A Lambertian panel of flux Phi: Phi / pi cos(gamma).
    EXPECT_NEAR(curves["c90"][60].get<double>(), 0.5 * 4000.0 / 3.0 / std::acos(-1.0), 1e-9);
    EXPECT_EQ(curves["c0"][180], 0.0);
    const json& luminaires = d["installation"]["luminaires"];
    ASSERT_EQ(luminaires.size(), 2u);
    EXPECT_EQ(luminaires[0]["type"], "panel");
    EXPECT_EQ(luminaires[0]["position"], (json{3.0, 1.0, 2.7}));
    EXPECT_EQ(luminaires[0]["scale"], 0.8);
    EXPECT_EQ(luminaires[0]["group"], "window");
    EXPECT_EQ(d["installation"]["rooms"][0]["name"], "office");
    EXPECT_EQ(d["installation"]["rooms"][0]["upper"], 2.8);
}

TEST(ResultsJson, GivesThePlanBackAsItWas) {
    const Plan before = make_plan(make_scene());
    const Plan after =
        parse_results_json(to_results_json(make_document()), "results.json").plan;
    ASSERT_EQ(after.luminaires.size(), before.luminaires.size());
    for (std::size_t k = 0; k < before.luminaires.size(); ++k) {
        EXPECT_EQ(after.luminaires[k].body, before.luminaires[k].body);
        EXPECT_EQ(after.luminaires[k].c0, before.luminaires[k].c0);
        EXPECT_EQ(after.luminaires[k].nadir, before.luminaires[k].nadir);
    }
    EXPECT_EQ(after.rooms[0].lines, before.rooms[0].lines);
    EXPECT_EQ(after.rooms[0].faces, before.rooms[0].faces);
}

TEST(ResultsJson, TellsTheDateAmongTheTimes) {
    ResultsDocument document = make_document();
    document.date = "2026-05-13T09:30:00Z";
    const std::string text = to_results_json(document);
    EXPECT_TRUE(text.ends_with("\"cpu_s\":9.5,\"date\":\"2026-05-13T09:30:00Z\"}\n}\n"));
    EXPECT_EQ(parse_results_json(text, "r.json").date, document.date);
    EXPECT_EQ(violations(json::parse(text)), "");
}

TEST(ResultsJson, DiffersByTimeAloneBetweenEqualRuns) {
    ResultsDocument a = make_document();
    ResultsDocument b = make_document();
    b.results.wall_seconds = 2.0;
    b.results.cpu_seconds = 3.0;
    const std::string text_a = to_results_json(a);
    const std::string text_b = to_results_json(b);
    EXPECT_NE(text_a, text_b);
    EXPECT_EQ(text_a.substr(0, text_a.find("\"time\"")),
              text_b.substr(0, text_b.find("\"time\"")));
    EXPECT_TRUE(text_a.ends_with("\"time\": {\"wall_s\":1.25,\"cpu_s\":9.5}\n}\n"));
}

TEST(ResultsJson, PutsEveryPointOnALineOfItsOwn) {
    const std::string text = to_results_json(make_document());
    std::size_t lines = 0;
    for (std::size_t at = text.find("\n    {\"position\":"); at != std::string::npos;
         at = text.find("\n    {\"position\":", at + 1))
        ++lines;
    const Results r = test::make_results();
    EXPECT_EQ(lines, r.surfaces[0].points.size() + r.surfaces[1].points.size());
}

TEST(ResultsJson, KeepsAnEmptyListOnTheLineOfItsName) {
    ResultsDocument document = make_document();
    document.results.surfaces.clear();
    document.results.modelling.clear();
    const std::string text = to_results_json(document);
    EXPECT_NE(text.find(",\n \"surfaces\": [],\n \"modelling\": [],\n \"observers\": "),
              std::string::npos);
}

TEST(ResultsJson, SurvivesNamesThatAreNotUtf8) {
    ResultsDocument d = make_document();
    d.results.surfaces[0].surface.name = "B\xFCro";
    const json parsed = json::parse(to_results_json(d));
    EXPECT_EQ(parsed["surfaces"][0]["name"], "B\xEF\xBF\xBDro");
}

std::string message_of(const std::string& text) {
    try {
        static_cast<void>(parse_results_json(text, "r.json"));
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

/// The good document with one value replaced, or taken out.
std::string with(const char* pointer, const json& value) {
    json d = json::parse(to_results_json(make_document()));
    d[json::json_pointer(pointer)] = value;
    return message_of(d.dump());
}

TEST(ResultsReader, NamesThePlaceOfBrokenJson) {
    EXPECT_EQ(message_of("{\"a\": 1,\n  \"b\" 2}"),
              "r.json:2:7: this is not JSON. Truncated file?");
    EXPECT_THAT(message_of(""), testing::HasSubstr("r.json:1:1: this is not JSON"));
}

TEST(ResultsReader, NamesThePlaceOfWhatDoesNotFit) {
    const std::string hint = ". Is this the results.json of an isolux calculation?";
    EXPECT_EQ(message_of("[]"), "r.json#: not an object" + hint);
    EXPECT_EQ(message_of("{}"), "r.json#: 'isolux_results' is missing" + hint);
    EXPECT_EQ(with("/isolux_results", 2),
              "r.json#/isolux_results: this format is not version 1" + hint);
    EXPECT_EQ(with("/surfaces/0/points/1/value", "12"),
              "r.json#/surfaces/0/points/1/value: not a number" + hint);
    EXPECT_EQ(with("/surfaces/0/points/1/normal", json{1, 2}),
              "r.json#/surfaces/0/points/1/normal: not three numbers" + hint);
    EXPECT_EQ(with("/surfaces", 1), "r.json#/surfaces: not a list" + hint);
    EXPECT_EQ(with("/seed", -1), "r.json#/seed: not a whole number" + hint);
    EXPECT_EQ(with("/converged", 1), "r.json#/converged: neither true nor false" + hint);
    EXPECT_EQ(with("/estimator", 1), "r.json#/estimator: not a text" + hint);
    EXPECT_EQ(with("/surfaces/1/quantity", "glare"),
              "r.json#/surfaces/1/quantity: unknown quantity 'glare'" + hint);
    EXPECT_EQ(with("/surfaces/0/grid/cells/0", 6),
              "r.json#/surfaces/0/grid/cells/0: beyond the last cell" + hint);
    EXPECT_EQ(with("/surfaces/0/grid/cells", json::array()),
              "r.json#/surfaces/0/grid/cells: as many cells as points are needed" + hint);
    const std::string types = "r.json#/installation/luminaire_types/0/";
    EXPECT_EQ(with("/installation/luminaire_types/0/opening/shape", "star"),
              types + "opening/shape: unknown shape 'star'" + hint);
    EXPECT_EQ(with("/installation/luminaire_types/0/curves/c0", json::array()),
              types + "curves/c0: as many values as gammas are needed" + hint);
    EXPECT_EQ(with("/installation/luminaires/0/type", "lamp"),
              "r.json#/installation/luminaires/0/type: there is no luminaire type 'lamp'"
                  + hint);
    EXPECT_EQ(with("/installation/rooms/0/lines/0", json{1, 2, 3}),
              "r.json#/installation/rooms/0/lines/0: not pairs of numbers" + hint);
}

TEST(ResultsReader, NamesThePlaceOfDecisionsThatDoNotFit) {
    const std::string hint = ". Is this the results.json of an isolux calculation?";
    EXPECT_EQ(with("/verdicts/0/decision", "maybe"),
              "r.json#/verdicts/0/decision: unknown word 'maybe'" + hint);
    EXPECT_EQ(with("/modelling/0/horizontal", "roof"),
              "r.json#/modelling/0/horizontal: there is no surface 'roof'" + hint);
    EXPECT_EQ(with("/observers/0/worst", 7),
              "r.json#/observers/0/worst: beyond the last observer" + hint);
}

TEST(ResultsJson, HasVerdictsWithMarginsAndClauses) {
    const json d = json::parse(to_results_json(make_document()));
    EXPECT_EQ(d["verdict"], "pass");
    const json& v = d["verdicts"][0];
    EXPECT_EQ(v["decision"], "pass");
    EXPECT_EQ(v["clause"], "5; 7");
    EXPECT_EQ(v["limit"], 500.0);
    EXPECT_EQ(v["margin"], 10.0);
    EXPECT_EQ(v["least_margin"], 4.0);
    EXPECT_FALSE(d["verdicts"][1].contains("value"));
    EXPECT_EQ(d["observers"][0]["observers"][0]["value"], 18.25);
    EXPECT_FALSE(d["observers"][0]["observers"][1].contains("value"));
}

TEST(WriteResults, MakesOneFolderWithJsonAndOneCsvASurface) {
    const test::TemporaryFolder folder;
    const auto out = folder.path() / "new" / "out";
    write_results(out, make_document());
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(out))
        names.push_back(entry.path().filename().string());
    EXPECT_THAT(
        names,
        UnorderedElementsAre("results.json", "office_work _plane_, 1.csv", "faces 机房.csv"));
    EXPECT_EQ(test::read_bytes(out / "results.json"), to_results_json(make_document()));
    EXPECT_EQ(to_results_json(read_results_json(out / "results.json")),
              to_results_json(make_document()));
    EXPECT_THROW(static_cast<void>(read_results_json(out / "none.json")), InputError);
}

/// A run that keeps less apart than the one before must not leave the other's tables.
TEST(WriteResults, WritesAndRemovesWhatTheSettingsAskFor) {
    const test::TemporaryFolder folder;
    const auto table = folder.path() / sensitivities_table;
    ResultsDocument document = make_document();
    Results& r = document.results;
    std::size_t points = 0;
    for (const SurfaceResult& s : r.surfaces)
        points += s.points.size();
    r.sensitivities =
        Sensitivities{{{"wall", 0.5, {}}}, 16, points, std::vector<float>(16 * points, 2.0F)};
    r.contributions = Contributions{{{"row", SourceKind::group, 1.0, {0}}},
                                    16,
                                    points,
                                    std::vector<float>(16 * points, 1.0F),
                                    std::vector<float>(16 * points, 1.0F)};
    write_results(folder.path(), document);
    EXPECT_EQ(test::read_bytes(table), to_sensitivities_csv(r));
    EXPECT_EQ(read_contributions(folder.path()).contributions.points, points);
    write_results(folder.path(), make_document());
    EXPECT_FALSE(std::filesystem::exists(table));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / contributions_index));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / contributions_table));
}

TEST(WriteResults, SaysWhyTheFolderCannotBeMade) {
    const test::TemporaryFolder folder;
    write_file_safely(folder.path() / "out", "a file");
    try {
        write_results(folder.path() / "out", make_document());
        FAIL() << "no error";
    } catch (const WriteError& error) {
        EXPECT_EQ(std::string(error.what()),
                  (folder.path() / "out").string()
                      + ": cannot be written (Not a directory). Does the folder exist?");
    }
}

} // namespace
} // namespace isolux
