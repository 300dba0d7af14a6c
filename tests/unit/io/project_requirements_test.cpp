#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"

#include "support/small_project.h"
#include "support/temporary_folder.h"

namespace isolux {
namespace {

using test::small_project;
using testing::HasSubstr;

Project parse(const std::string& requirements, const std::string& surfaces = "") {
    return parse_project(
        small_project({{"requirements", requirements}, {"surfaces", surfaces}}), "p.json");
}

std::string complaint(const std::string& requirements, const std::string& surfaces = "") {
    try {
        static_cast<void>(parse(requirements, surfaces));
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

const ProjectRequirement* find(const Project& p, const std::string& symbol) {
    const auto found = std::ranges::find_if(p.requirements, [&](const ProjectRequirement& r) {
        return r.requirement.symbol == symbol;
    });
    return found == p.requirements.end() ? nullptr : &*found;
}

const char* const desk =
    R"([{"name": "desk", "rectangle": {"corner": [2, 1.5, 0.75], "u": [1.6, 0, 0], "v": [0, 0.8, 0]}}])";

TEST(Requirements, MakeTheAreasThatTheRowAsksFor) {
    const Project p =
        parse(R"([{"standard": "EN 12464-1:2021", "row": "34.2", "area": "desk"}])", desk);
    for (const char* name : {"desk",
                             "desk surrounding",
                             "desk background",
                             "office wall 1",
                             "office wall 4",
                             "office ceiling",
                             "office heads",
                             "office heads, horizontal"})
        EXPECT_TRUE(std::ranges::any_of(p.surfaces, [&](const CalculationSurface& s) {
            return s.name == name;
        })) << name;
    ASSERT_NE(find(p, "Em"), nullptr);
    EXPECT_EQ(find(p, "Em")->subject, "desk");
    EXPECT_EQ(find(p, "Em")->requirement.limit, 500.0);
    EXPECT_EQ(find(p, "Es")->subject, "desk surrounding");
    EXPECT_EQ(find(p, "Es")->requirement.limit, 300.0);
    EXPECT_EQ(find(p, "Ez")->subject, "office heads");
    EXPECT_EQ(std::ranges::count_if(
                  p.requirements,
                  [](const ProjectRequirement& r) { return r.requirement.symbol == "Ewall"; }),
              4);
    EXPECT_EQ(find(p, "UGR")->observers, 0U);
    EXPECT_EQ(find(p, "UGR")->subject, "office observers");
}

TEST(Requirements, MeasureTheBandOfHalfAMetreAroundTheTaskAndNothingElse) {
    const Project p =
        parse(R"([{"standard": "EN 12464-1", "row": "34.2", "area": "desk"}])", desk);
    const CalculationSurface& band = p.surfaces[*find(p, "Es")->surface];
    const CalculationSurface& beyond = p.surfaces[*find(p, "Eb")->surface];
    ASSERT_GT(band.receivers.size(), 20U);
    const auto outside = [](const Point3& q) {
        return std::hypot(std::max({2 - q.x, 0.0, q.x - 3.6}),
                          std::max({1.5 - q.y, 0.0, q.y - 2.3}));
    };
    for (const Receiver& r : band.receivers) {
        EXPECT_GT(outside(r.point), 0.0);
        EXPECT_LE(outside(r.point), 0.5 + 1e-9);
        EXPECT_EQ(r.point.z, 0.75);
    }
    for (const Receiver& r : beyond.receivers) {
        EXPECT_GT(outside(r.point), 0.5);
        EXPECT_LE(outside(r.point), 3.5);
        EXPECT_GE(r.point.x, 0.5); // off the edge zone
        EXPECT_LE(r.point.y, 3.5);
    }
}

TEST(Requirements, TakeTheWorkPlaneWhereNoAreaIsNamedAndSayThatNothingIsAroundIt) {
    const Project p = parse(R"([{"standard": "EN 12464-1:2021", "row": "34.2"}])");
    EXPECT_EQ(find(p, "Em")->subject, "office work plane");
    EXPECT_FALSE(find(p, "Es")->surface);
    EXPECT_THAT(find(p, "Es")->reason, HasSubstr("leaves nothing around it"));
    EXPECT_EQ(p.surfaces.front().name, "office work plane");
}

TEST(Requirements, LeaveOutAndRaiseWhatTheProjectSays) {
    const Project p = parse(R"([{"standard": "EN 12464-1:2021", "row": "34.2", "modified": true,
        "leave_out": ["walls", "ceiling"]}])");
    EXPECT_EQ(find(p, "Em")->requirement.limit, 1000.0);
    EXPECT_EQ(find(p, "Ewall"), nullptr);
    EXPECT_EQ(find(p, "Eceiling_U0"), nullptr);
    EXPECT_NE(find(p, "Ez"), nullptr);
}

TEST(Requirements, LeaveThePointsBehindLuminairesOutOfTheCeiling) {
    const Project p = parse(R"([{"standard": "EN 12464-1:2021", "row": "34.2"}])");
    const CalculationSurface& ceiling = p.surfaces[*find(p, "Eceiling")->surface];
    ASSERT_FALSE(ceiling.receivers.empty());
    for (const Receiver& r : ceiling.receivers)
        for (const LuminairePlacement& l : p.scene.luminaires) {
            const Vector3 d = l.world_from_luminaire.point_to_local(r.point);
            EXPECT_FALSE(std::abs(d.x) < 0.3 && std::abs(d.y) < 0.3);
        }
    EXPECT_LT(ceiling.receivers.size(),
              ceiling.grid->counts.columns * ceiling.grid->counts.rows);
}

TEST(Requirements, ReadAStandardOfTheUsersOwn) {
    const test::TemporaryFolder folder;
    test::write_bytes(
        folder.path() / "brief.json",
        R"({"isolux_standard": 1, "name": "Brief", "sources": [{"key": "k", "text": "client"}],
      "columns": [{"symbol": "Emin", "quantity": "illuminance", "area": "task", "statistic": "minimum",
        "sense": "at least", "unit": "lx", "clause": "3", "name": "least"}],
      "rows": [{"id": "desk", "clause": "3", "task": "desk", "limits": {"Emin": 300}, "source": "k"}]})");
    const Project p = parse_project(
        small_project({{"standards", R"(["brief.json"])"},
                       {"requirements", R"([{"standard": "Brief", "row": "desk"}])"}}),
        folder.path() / "p.json");
    ASSERT_EQ(p.requirements.size(), 1U);
    EXPECT_EQ(p.requirements[0].requirement.statistic, Statistic::minimum);
    EXPECT_EQ(p.requirements[0].requirement.source, "client");
    EXPECT_EQ(p.inputs.back().file, "brief.json");
}

TEST(Requirements, ComplainAboutWhatDoesNotExist) {
    EXPECT_THAT(
        complaint(R"([{"standard": "EN 12464-3", "row": "34.2"}])"),
        HasSubstr("p.json:5: #/requirements/0/standard: unknown standard \"EN 12464-3\""));
    EXPECT_THAT(
        complaint(R"([{"standard": "EN 12464-1:2021", "row": "34.22"}])"),
        HasSubstr("p.json:5: #/requirements/0/row: EN 12464-1:2021 has no row \"34.22\" "
                  "(rows are numbered as in this edition, \"9.1\" for example). Did "
                  "you mean \"34.2\"? `isolux standards WORD` finds rows"));
    EXPECT_THAT(complaint(R"([{"standard": "EN 12464", "row": "34.2"}])"),
                HasSubstr("unknown standard \"EN 12464\" (known are \"EN 12464-1:2021\", \"EN "
                          "12464-2:2014\" and \"EN 1838:2013\"). Did you mean \"EN "
                          "12464-1\"?"));
    EXPECT_THAT(complaint(R"([{"standard": "EN 12464-1", "row": 44.1}])"),
                HasSubstr("/row: text is expected here (found a number). Write \"44.1\" in "
                          "quotes?"));
    EXPECT_THAT(
        complaint(R"([{"standard": "EN 12464-1:2021", "row": "34.2", "area": "desc"}])", desk),
        HasSubstr("p.json:5: #/requirements/0/area: unknown surface \"desc\" (surfaces has no "
                  "such name). Did you mean \"desk\"?"));
    EXPECT_THAT(
        complaint(R"([{"standard": "EN 12464-1:2021", "row": "34.2", "area": "desk",
        "areas": {"space": "desk"}}])",
                  desk),
        HasSubstr("surface \"desk\" measures another quantity (cylindrical illuminance is "
                  "judged here)"));
    EXPECT_THAT(complaint(R"([{"row": "34.2"}])"),
                HasSubstr("the key \"standard\" is missing"));
}

TEST(Requirements, NeedAnAreaOrARoomWhereThereAreTwoRooms) {
    EXPECT_THAT(
        [] {
            try {
                static_cast<void>(parse_project(
                    small_project(
                        {{"rooms",
                          R"([{"name": "office", "size": [6, 4], "height": 3}, {"name": "b", "size": [2, 2], "height": 3, "position": [6, 0]}])"},
                         {"requirements", R"([{"standard": "EN 12464-1", "row": "34.2"}])"}}),
                    "p.json"));
            } catch (const InputError& e) {
                return std::string(e.what());
            }
            return std::string();
        }(),
        HasSubstr("neither \"area\" nor \"room\" is given (what must meet the requirement?)"));
}

TEST(MaintenanceFactor, IsTheProductOfItsParts) {
    const Project p =
        parse_project(small_project({{"maintenance_factor",
                                      R"({"LLMF": 0.9, "LSF": 1, "LMF": 0.9, "RSMF": 0.95})"}}),
                      "p.json");
    ASSERT_EQ(p.schedule.size(), 1U);
    EXPECT_DOUBLE_EQ(p.schedule[0].maintenance.value, 0.9 * 0.9 * 0.95);
    EXPECT_TRUE(p.schedule[0].maintenance.has_parts);
    EXPECT_EQ(p.schedule[0].maintenance.room_surface, 0.95);
    EXPECT_EQ(p.schedule[0].count, 6U);
    EXPECT_DOUBLE_EQ(p.scene.luminaires[0].scale, p.schedule[0].maintenance.value);
}

TEST(MaintenanceFactor, ComplainsAboutAPartAboveOne) {
    try {
        static_cast<void>(parse_project(
            small_project({{"maintenance_factor", R"({"LLMF": 1.1})"}}), "p.json"));
        ADD_FAILURE() << "no complaint";
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), HasSubstr("p.json:4: #/maintenance_factor/LLMF"));
    }
}

} // namespace
} // namespace isolux
