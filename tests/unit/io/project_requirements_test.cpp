#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"

#include "support/small_project.h"
#include "support/source_dir.h"
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
    EXPECT_EQ(find(p, "Es")->reason,
              "\"office work plane\" leaves no point of the room within 0.5 m around it (edge "
              "zones of walls do not count): name a surface under \"areas\", or put "
              "\"surrounding\" into \"leave_out\"");
    EXPECT_EQ(
        find(p, "Eb")->reason,
        "\"office work plane\" leaves no point of the room between 0.5 m and 3.5 m around "
        "it (edge zones of walls do not count): name a surface under \"areas\", or put "
        "\"background\" into \"leave_out\"");
    EXPECT_EQ(p.surfaces.front().name, "office work plane");
}

TEST(Requirements, SayThatNothingLiesAroundWhatIsNoLevelGrid) {
    const Project p = parse(
        R"([{"standard": "EN 12464-1", "row": "44.4", "area": "board"}])",
        R"([{"name": "board", "rectangle": {"centre": [0.1, 2, 1.5], "size": [2, 1], "normal": [1, 0, 0]}}])");
    EXPECT_EQ(find(p, "Es")->reason,
              "\"board\" is no level grid, around which there would be a band: name a surface "
              "under \"areas\", or put \"surrounding\" into \"leave_out\"");
    EXPECT_EQ(find(p, "Eb_U0")->reason,
              "\"board\" is no level grid, around which there would be a background: name a "
              "surface under \"areas\", or put \"background\" into \"leave_out\"");
}

TEST(Requirements, TellOfOneTaskAreaOfSeveralThatLeavesNothingAroundIt) {
    const Project p = parse(
        R"([{"standard": "EN 12464-1", "row": "34.2", "area": ["desk", "plane"]}])",
        R"([{"name": "desk", "rectangle": {"corner": [2, 1.5, 0.75], "u": [1.6, 0, 0], "v": [0, 0.8, 0]}},
            {"name": "plane", "work_plane": {}}])");
    std::vector<std::string> subjects;
    for (const ProjectRequirement& r : p.requirements)
        if (r.requirement.symbol == "Es")
            subjects.push_back(r.subject + (r.surface ? "" : ": " + r.reason.substr(0, 24)));
    EXPECT_THAT(
        subjects,
        testing::ElementsAre("desk surrounding", "surrounding: \"plane\" leaves no point "));
}

const char* const pupils =
    R"([{"name": "pupils", "position": [5, 2, 1.2], "direction": 180}, {"name": "teacher", "position": [1, 2, 1.6], "direction": 0}])";

/// What UGR is judged at when a requirement of row 44.1 has these further keys.
std::vector<std::string> judged_at(const std::string& keys,
                                   const std::string& observers,
                                   std::vector<Message>* notices = nullptr) {
    const Project p = parse_project(
        small_project(
            {{"observers", observers},
             {"requirements", R"([{"standard": "EN 12464-1", "row": "44.1")" + keys + "}]"}}),
        "p.json");
    std::vector<std::string> subjects;
    for (const ProjectRequirement& r : p.requirements)
        if (r.requirement.symbol == "UGR") {
            EXPECT_EQ(p.observers[r.observers.value()].name, r.subject);
            subjects.push_back(r.subject);
        }
    if (notices != nullptr)
        *notices = p.notices;
    return subjects;
}

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ObserversOfRequirements, AreTheUsersOwnOnlyWithANotice) {
    std::vector<Message> notices;
    EXPECT_THAT(judged_at("", pupils, &notices), ElementsAre("pupils", "teacher"));
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_EQ(
        to_string(notices[0]),
        "p.json:6: #/requirements/0: UGR of row 44.1 is judged at your observers "
        "\"pupils\" and \"teacher\" only. \"observers\": [\"pupils\", \"teacher\", \"grid\"] "
        "adds the grid of the room");
}

TEST(ObserversOfRequirements, AreTheGridWhereThereAreNoOthers) {
    std::vector<Message> notices;
    EXPECT_THAT(judged_at("", "", &notices), ElementsAre("office observers"));
    EXPECT_THAT(notices, IsEmpty());
}

TEST(ObserversOfRequirements, AreThoseThatItNames) {
    std::vector<Message> notices;
    const auto at = [&](const std::string& names) {
        return judged_at(", \"observers\": " + names, pupils, &notices);
    };
    EXPECT_THAT(at(R"(["pupils", "grid"])"), ElementsAre("pupils", "office observers"));
    EXPECT_THAT(at(R"("grid")"), ElementsAre("office observers"));
    EXPECT_THAT(at(R"("teacher")"), ElementsAre("teacher"));
    EXPECT_THAT(at(R"(["pupils", "pupils"])"), ElementsAre("pupils"));
    EXPECT_THAT(notices, IsEmpty());
}

TEST(ObserversOfRequirements, DoNotDependOnTheOrderOfRequirements) {
    const Project p = parse_project(
        small_project(
            {{"observers", pupils},
             {"requirements",
              R"([{"standard": "EN 12464-1", "row": "44.1", "observers": "grid"}, {"standard": "EN 12464-1", "row": "34.2", "leave_out": ["luminaires"]}, {"standard": "EN 12464-1", "row": "34.2", "observers": ["grid"]}])"}}),
        "p.json");
    std::vector<std::string> subjects;
    for (const ProjectRequirement& r : p.requirements)
        if (r.requirement.symbol == "UGR")
            subjects.push_back(r.subject);
    EXPECT_THAT(subjects,
                ElementsAre("office observers", "pupils", "teacher", "office observers"));
    EXPECT_EQ(p.observers.size(), 3U);
}

TEST(ObserversOfRequirements, TakeAGroupWithTheGridsNameForTheGrid) {
    const std::string own =
        R"([{"name": "office observers", "position": [5, 2, 1.2]}, {"name": "door", "position": [1, 2, 1.6]}])";
    std::vector<Message> notices;
    EXPECT_THAT(judged_at("", own, &notices), ElementsAre("office observers", "door"));
    EXPECT_THAT(notices, IsEmpty());
    EXPECT_THAT(judged_at(R"(, "observers": ["door", "grid"])", own),
                ElementsAre("door", "office observers"));
}

TEST(ObserversOfRequirements, AreNotNamedInVain) {
    std::vector<Message> notices;
    const std::string keys = R"(, "leave_out": "observers", "observers": "teacher")";
    EXPECT_THAT(judged_at(keys, pupils, &notices), IsEmpty());
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_EQ(to_string(notices[0]),
              "p.json:6: #/requirements/0/observers: nobody is judged at these observers "
              "(\"leave_out\" leaves them out). Leave \"observers\" out?");
}

TEST(ObserversOfRequirements, AreNotNamedWhereTheRowLimitsNoGlare) {
    const Project p = parse_project(
        small_project(
            {{"observers", pupils},
             {"surfaces", desk},
             {"requirements",
              R"([{"standard": "EN 1838", "row": "route-centre", "area": "desk", "observers": "teacher"}])"}}),
        "p.json");
    ASSERT_EQ(p.notices.size(), 1U);
    EXPECT_THAT(
        to_string(p.notices[0]),
        HasSubstr("nobody is judged at these observers (row route-centre limits no glare)"));
}

TEST(ObserversOfRequirements, MustExistAndBeOfTheScale) {
    const auto complaint_about = [](const std::string& observers,
                                    const std::string& names,
                                    const std::string& row = R"("EN 12464-1", "row": "44.1")") {
        try {
            static_cast<void>(
                parse_project(small_project({{"observers", observers},
                                             {"surfaces", desk},
                                             {"requirements",
                                              R"([{"area": "desk", "standard": )" + row
                                                  + R"(, "observers": )" + names + "}]"}}),
                              "p.json"));
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_EQ(complaint_about(pupils, R"(["pupil"])"),
              "p.json:6: #/requirements/0/observers: unknown observers \"pupil\" (neither the "
              "name of a group in observers nor \"grid\"). Did you mean \"pupils\"?");
    EXPECT_THAT(complaint_about(pupils, R"("gird")"), HasSubstr("Did you mean \"grid\"?"));
    EXPECT_THAT(complaint_about(pupils, "[]"), HasSubstr("#/requirements/0/observers"));
    EXPECT_THAT(
        complaint_about(R"([{"name": "grid", "position": [5, 2, 1.2]}])", R"("grid")"),
        HasSubstr("\"grid\" may be the group of that name or the grid that isolux adds (which "
                  "one is meant?). Give the group another name?"));
    const std::string yard =
        R"([{"name": "yard", "position": [5, 2, 1.2], "rating": "GR", "ground": "desk"}])";
    EXPECT_THAT(
        complaint_about(yard, R"("yard")"),
        HasSubstr("the observers \"yard\" are rated by another scale (UGR is limited by "
                  "row 44.1)"));
    EXPECT_THAT(complaint_about(yard, R"(["yard", "grid"])", R"("EN 12464-2", "row": "5.1.1")"),
                HasSubstr("isolux adds no grid of observers for GR (where people look outdoors "
                          "is for the project to say). Name groups of your own?"));
}

TEST(ObserversOfRequirements, HaveNoGridWithoutARoom) {
    EXPECT_THAT(
        [] {
            try {
                static_cast<void>(parse_project(
                    small_project(
                        {{"rooms",
                          R"([{"name": "office", "size": [6, 4], "height": 3}, {"name": "b", "size": [2, 2], "height": 3, "position": [6, 0]}])"},
                         {"surfaces",
                          R"([{"name": "yard", "rectangle": {"corner": [20, 20, 0], "u": [5, 0, 0], "v": [0, 5, 0]}}])"},
                         {"requirements",
                          R"([{"standard": "EN 12464-1", "row": "44.1", "area": "yard", "observers": "grid"}])"}}),
                    "p.json"));
            } catch (const InputError& e) {
                return std::string(e.what());
            }
            return std::string();
        }(),
        HasSubstr("there is no room for a grid of observers. Name groups of your own?"));
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

TEST(ShippedProjects, NameTheirObserversAndShareThePointsOfModelling) {
    for (const char* name : {"classroom", "open-office"}) {
        const Project p = read_project(test::source_dir() / "projects" / name / "project.json");
        for (const Message& m : p.notices)
            EXPECT_THAT(to_string(m), testing::Not(HasSubstr("observers"))) << name;
        const ProjectRequirement* modelling = find(p, "modelling_low");
        ASSERT_NE(modelling, nullptr) << name;
        const CalculationSurface& faces = p.surfaces[modelling->surface.value()];
        EXPECT_TRUE(std::ranges::any_of(p.surfaces, [&](const CalculationSurface& s) {
            return s.kind == IlluminanceKind::planar
                   && std::ranges::equal(
                       s.receivers, faces.receivers, [](const Receiver& a, const Receiver& b) {
                           return a.point == b.point;
                       });
        })) << name;
    }
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
