#include <cmath>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "isolux/calc/calculate.h"
#include "isolux/io/json_value.h"
#include "isolux/io/project_json.h"

#include "support/source_dir.h"
#include "support/temporary_folder.h"

/// Rooms described elsewhere, said again as projects: the format can say it, and directions
/// come out as their authors state them. Skipped where the scenes are not beside the checkout.
namespace isolux::test {
namespace {

const std::filesystem::path scenes = isolux::test::source_dir().string() + "/../shared/scenes";

double number(const JsonValue& object, std::string_view key) {
    return object.find(key)->number;
}

Vector3 vector(const JsonValue& list) {
    return {list.items.at(0).number, list.items.at(1).number, list.items.at(2).number};
}

std::string in_json(const Vector3& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

std::string points_of(const JsonValue& scene) {
    std::string surfaces;
    for (const JsonValue& group : scene.find("points")->items) {
        std::string points;
        for (const JsonValue& p : group.find("points")->items)
            points += fmt::format("{}[{}, {}, {}, {}, {}, {}]",
                                  points.empty() ? "" : ", ",
                                  p.items[0].number,
                                  p.items[1].number,
                                  p.items[2].number,
                                  p.items[3].number,
                                  p.items[4].number,
                                  p.items[5].number);
        surfaces += fmt::format("{}{{\"name\": \"{}\", \"points\": [{}]}}",
                                surfaces.empty() ? "" : ", ",
                                group.find("name")->text,
                                points);
    }
    return "[" + surfaces + "]";
}

std::string project_text(const JsonValue& scene,
                         const std::string& room,
                         const std::string& types,
                         const std::string& luminaires) {
    const JsonValue& m = *scene.find("materials");
    const auto rho = [&](std::string_view name) {
        return number(*m.find(name), "reflectance");
    };
    return fmt::format(
        R"({{"isolux": 1, "rooms": [{{{}, "reflectances": {{"floor": {}, "walls": {},
                        "ceiling": {}}}}}], "luminaire_types": {{{}}}, "luminaires": [{}],
                        "surfaces": {}}})",
        room,
        rho("floor"),
        rho("wall"),
        rho("ceiling"),
        types,
        luminaires,
        points_of(scene));
}

void expect_near(const Vector3& a, const Vector3& b, double tolerance) {
    EXPECT_NEAR(length(a - b), 0.0, tolerance);
}

/// Illuminances of the project against those of independent engines, METHODS 7.1: every |z| of
/// the 680 points at most 6 (their errors and ours, 16 replicates), no common bias beyond 0.2
/// %. The points of a run share its light paths, so their z are those of two runs.
void expect_illuminances(const std::string& text, const std::string& name) {
    constexpr std::uint64_t runs = 2;
    const JsonValue reference =
        parse_json(read_bytes(scenes / "reference" / (name + ".json")), "reference");
    const std::vector<JsonValue>& groups = reference.find("groups")->items;
    const Project project = parse_project(text, scenes / "project.json");
    const Scene scene = build_scene(parse_project(text, scenes / "project.json").scene);
    std::vector<double> squares(groups.size());
    for (std::uint64_t run = 0; run < runs; ++run) {
        Settings settings = project.settings;
        settings.seed += run;
        const Results results = calculate(scene, project.surfaces, settings);
        EXPECT_TRUE(results.converged);
        ASSERT_EQ(groups.size(), results.surfaces.size());
        for (std::size_t g = 0; g < groups.size(); ++g) {
            double ratio = 0.0;
            double own = 0.0;
            const auto& points = results.surfaces[g].points;
            for (std::size_t p = 0; p < points.size(); ++p) {
                const double lux = groups[g].find("lux")->items[p].number;
                const double error = groups[g].find("se")->items[p].number;
                const Estimate& e = points[p].total;
                const double z = (e.mean - lux) / std::hypot(error, e.standard_error);
                EXPECT_LT(std::abs(z), 6.0)
                    << name << " point " << p << ": " << e.mean << ", " << lux;
                ratio += e.mean / lux / static_cast<double>(points.size());
                own += z * z / static_cast<double>(points.size());
            }
            squares[g] += own / runs;
            EXPECT_LT(std::sqrt(own), 1.8) << name << " run " << run;
            EXPECT_NEAR(ratio, 1.0, 2e-3) << name;
        }
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
        EXPECT_LT(std::sqrt(squares[g]), 1.4) << name;
        testing::Test::RecordProperty(name + std::to_string(g),
                                      fmt::format("rms z {:.3f}", std::sqrt(squares[g])));
    }
}

TEST(ReferenceScenes, TiltedSpotsPointWhereTheirAuthorsSay) {
    if (!std::filesystem::exists(scenes))
        GTEST_SKIP() << "the reference scenes are not beside the checkout";
    const JsonValue scene = parse_json(read_bytes(scenes / "downlights.json"), "scene");
    const std::vector<JsonValue>& spots = scene.find("luminaires")->items;
    std::string luminaires;
    for (const JsonValue& l : spots)
        luminaires += fmt::format(
            R"({}{{"type": "spot", "position": {}, "rotation": {}, "tilt": {}, "azimuth": {}}})",
            luminaires.empty() ? "" : ", ",
            in_json(vector(*l.find("position"))),
            number(l, "rotation_deg"),
            number(l, "tilt_deg"),
            number(l, "azimuth_deg"));

    const std::string text = project_text(scene,
                                          R"("size": [8, 5], "height": 2.8)",
                                          R"("spot": {"file": "ies/downlight_cos20.ies"})",
                                          luminaires);
    const Project project = parse_project(text, scenes / "project.json");

    ASSERT_EQ(project.scene.luminaires.size(), spots.size());
    for (std::size_t i = 0; i < spots.size(); ++i) {
        const Frame& frame = project.scene.luminaires[i].world_from_luminaire;
        expect_near(-Vector3(frame.z), vector(*spots[i].find("nadir")), 2e-9);
        expect_near(Vector3(frame.x), vector(*spots[i].find("c0")), 2e-9);
    }
    EXPECT_EQ(project.scene.luminaire_types[0].opening.shape, OpeningShape::point);
    expect_illuminances(text, "downlights");
}

TEST(ReferenceScenes, FlushPanelsAreLambertianTypesWithABody) {
    if (!std::filesystem::exists(scenes))
        GTEST_SKIP() << "the reference scenes are not beside the checkout";
    const JsonValue scene = parse_json(read_bytes(scenes / "shoebox.json"), "scene");
    std::string centres;
    for (const JsonValue& l : scene.find("luminaires")->items)
        centres += (centres.empty() ? "" : ", ")
                   + in_json(vector(*l.find("corner")) + 0.5 * vector(*l.find("u"))
                             + 0.5 * vector(*l.find("v")));

    const std::string text =
        project_text(scene,
                     R"("size": [6, 4], "height": 3)",
                     R"("panel": {"lambertian": {"size": [0.6, 0.6], "flux": 4000}})",
                     R"({"type": "panel", "positions": [)" + centres + "]}");
    const Project project = parse_project(text, scenes / "project.json");

    ASSERT_EQ(project.scene.luminaires.size(), 4U);
    EXPECT_EQ(project.scene.luminaire_types[0].body, BodyModel::absorbing);
    std::size_t points = 0;
    for (const CalculationSurface& surface : project.surfaces)
        points += surface.receivers.size();
    EXPECT_EQ(points, 96U);
    expect_illuminances(text, "shoebox");
    // The half-spacing rule hangs the same four panels.
    const Project field = parse_project(
        R"({"isolux": 1, "rooms": [{"size": [6, 4], "height": 3}], "luminaire_types":
            {"panel": {"lambertian": {"size": [0.6, 0.6], "flux": 4000}}},
            "luminaires": [{"type": "panel", "field": {"rows": 2, "columns": 2}}]})",
        "p.json");
    expect_near(field.scene.luminaires[3].world_from_luminaire.origin - Point3{},
                project.scene.luminaires[3].world_from_luminaire.origin - Point3{},
                1e-9);
}

} // namespace
} // namespace isolux::test
