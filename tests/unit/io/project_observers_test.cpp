#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"

#include "support/small_project.h"

namespace isolux {
namespace {

using test::small_project;
using testing::HasSubstr;

Project parse(const std::string& key, const std::string& value, const std::string& more = "") {
    return parse_project(small_project({{key, value}, {"surfaces", more}}), "p.json");
}

std::string complaint(const std::string& key, const std::string& value) {
    try {
        static_cast<void>(parse(key, value));
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(Observers, LookWhereTheProjectSays) {
    const Project p = parse("observers", R"([
        {"name": "a", "position": [1, 1, 1.2], "direction": 90},
        {"name": "b", "positions": [[1, 1, 1.2], [2, 1, 1.2]], "directions": [[0, 1], [3, 0, -4], 180]}])");
    ASSERT_EQ(p.observers.size(), 2U);
    ASSERT_EQ(p.observers[0].sight_lines.size(), 1U);
    EXPECT_NEAR(p.observers[0].sight_lines[0].direction.y(), 1.0, 1e-12);
    EXPECT_EQ(p.observers[0].room, "office");
    ASSERT_EQ(p.observers[1].sight_lines.size(), 6U);
    EXPECT_NEAR(p.observers[1].sight_lines[1].direction.z(), -0.8, 1e-12);
}

TEST(Observers, LookAllAroundWhereNoDirectionIsGiven) {
    const Project p =
        parse("observers", R"([{"position": [1, 1, 1.2]}, {"grid": {"spacing": 2}}])");
    EXPECT_EQ(p.observers[0].sight_lines.size(), 12U);
    EXPECT_EQ(p.observers[0].name, "observers 1");
    EXPECT_EQ(p.observers[1].sight_lines.size() % 4, 0U);
    for (const SightLine& l : p.observers[1].sight_lines) {
        EXPECT_GE(l.eye.x, 0.5);
        EXPECT_EQ(l.eye.z, 1.2);
    }
}

TEST(Observers, OutdoorsNeedTheGround) {
    const char* const yard = R"([{"name": "yard", "work_plane": {"height": 0}}])";
    const Project p = parse(
        "observers", R"([{"position": [1, 1, 1.5], "rating": "GR", "ground": "yard"}])", yard);
    EXPECT_EQ(p.observers[0].scale, GlareScale::outdoor);
    EXPECT_EQ(p.observers[0].ground, 0U);
    ASSERT_EQ(p.observers[0].sight_lines.size(), 8U);
    EXPECT_NEAR(p.observers[0].sight_lines[0].direction.z(), -std::sin(2 * M_PI / 180), 1e-9);
    EXPECT_THAT(complaint("observers", R"([{"position": [1, 1, 1.5], "rating": "GR"}])"),
                HasSubstr("the key \"ground\" is missing"));
    EXPECT_THAT(complaint("observers",
                          R"([{"position": [1, 1, 1.5], "rating": "GR", "ground": "gras"}])"),
                HasSubstr("p.json:5: #/observers/0/ground: unknown surface \"gras\""));
}

TEST(Observers, ComplainAboutWhatIsWrong) {
    EXPECT_THAT(complaint("observers", R"([{"direction": 0}])"), HasSubstr("needs one of"));
    EXPECT_THAT(complaint("observers", R"([{"position": [1, 1, 1.2], "direction": [0, 0]}])"),
                HasSubstr("p.json:5: #/observers/0/direction: the vector has no length"));
    EXPECT_THAT(
        complaint(
            "observers",
            R"([{"name": "a", "position": [1, 1, 1.2]}, {"name": "a", "position": [1, 1, 1]}])"),
        HasSubstr("the name \"a\" is taken"));
    EXPECT_THAT(complaint("observers", R"([{"grid": {"spacing": 0.0002, "edge": 1.9}}])"),
                HasSubstr("the grid has too many points"));
    EXPECT_THAT(complaint("observers", R"([{"grid": {"spacing": 0.02}}])"),
                HasSubstr("lines of sight are too many (at most 100000 a group)"));
}

TEST(Observers, AreMadeForARoomThatMustMeetAGlareLimit) {
    const Project p = parse("requirements", R"([{"standard": "EN 12464-1", "row": "34.2"}])");
    ASSERT_EQ(p.observers.size(), 1U);
    EXPECT_EQ(p.observers[0].name, "office observers");
    const auto ugr = std::ranges::find_if(p.requirements, [](const ProjectRequirement& r) {
        return r.requirement.symbol == "UGR";
    });
    ASSERT_NE(ugr, p.requirements.end());
    EXPECT_EQ(ugr->observers, 0U);
}

TEST(Energy, TakesRoomsLuminairesAndTheFirstWorkPlane) {
    const Project p = parse("energy", R"({"occupancy": 0.9})");
    ASSERT_EQ(p.energy_zones.size(), 1U);
    EXPECT_EQ(p.energy_zones[0].floor_area, 24.0);
    EXPECT_EQ(p.energy_zones[0].luminaires.size(), 6U);
    EXPECT_EQ(p.energy_zones[0].work_surface, 0U);
    EXPECT_EQ(p.energy_use->occupancy, 0.9);
    EXPECT_EQ(p.energy_use->day_hours, 2250.0);
    EXPECT_THAT(complaint("energy", R"({"occupancy": 9})"),
                HasSubstr("p.json:1: #/energy/occupancy"));
}

TEST(Energy, ReadsPowerAndColourRenderingOfAType) {
    const Project p =
        parse("luminaire_types",
              R"({"panel": {"lambertian": {"size": [0.6, 0.6], "flux": 4000}, "power": 36,
                                "colour_rendering": 90, "glare_factor": 1.5}})");
    EXPECT_EQ(p.schedule[0].watts, 36.0);
    EXPECT_EQ(p.schedule[0].colour_rendering, 90.0);
    EXPECT_EQ(p.glare_factors[0], 1.5);
}

const char* const groups = R"([
    {"type": "panel", "name": "row", "line": {"from": [1, 1, 2.9], "to": [5, 1, 2.9], "count": 3}, "group": "window"},
    {"type": "panel", "name": "spot", "position": [3, 3, 2.9]},
    {"type": "panel", "name": "dark", "position": [4, 3, 2.9], "dimming": 0}])";

std::string scene_complaint(const std::string& scenes) {
    try {
        static_cast<void>(parse_project(
            small_project({{"luminaires", groups}, {"scenes", scenes}}), "p.json"));
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(Scenes, SetLevelsOfGroupsTypesAndLuminaires) {
    const Project p = parse_project(
        small_project({{"luminaires", groups},
                       {"scenes",
                        R"([{"name": "talk", "levels": {"window": 0.2, "spot": 1.5}},
                            {"name": "off", "others": 0},
                            {"name": "one fails", "levels": {"row 2": 0}}])"}}),
        "p.json");
    ASSERT_EQ(p.scenes.size(), 3U);
    EXPECT_EQ(p.scenes[0].factors, (std::vector<double>{0.2, 0.2, 0.2, 1.5, 1.0}));
    EXPECT_EQ(p.scenes[1].factors, std::vector<double>(5, 0.0));
    EXPECT_EQ(p.scenes[2].factors, (std::vector<double>{1.0, 0.0, 1.0, 1.0, 1.0}));
}

TEST(Observers, OfAHugeRoomStandFurtherApart) {
    const Project p = parse_project(
        small_project({{"rooms", R"([{"name": "office", "size": [1000, 230], "height": 6}])"},
                       {"requirements", R"([{"standard": "EN 12464-1", "row": "34.2"}])"}}),
        "p.json");
    ASSERT_EQ(p.observers.size(), 1U);
    EXPECT_LE(p.observers[0].sight_lines.size(), 100'000U);
    EXPECT_GT(p.observers[0].sight_lines.size(), 80'000U);
    ASSERT_EQ(p.notices.size(), 1U);
    EXPECT_EQ(to_string(p.notices[0]),
              "p.json:5: #/requirements/0: the observers of room \"office\" stand 3.09 m apart "
              "(every 2 m would make more than 100000 lines of sight)");
}

TEST(Scenes, NoticeLevelsAboveOne) {
    const Project p = parse_project(
        small_project(
            {{"luminaires", groups},
             {"scenes", R"([{"name": "a", "levels": {"window": 50}, "others": 1.5}])"}}),
        "p.json");
    ASSERT_EQ(p.notices.size(), 2U);
    EXPECT_EQ(to_string(p.notices[0]),
              "p.json:9: #/scenes/0/others: a level of 1.5 gives the luminaires 150 % of their "
              "flux");
    EXPECT_EQ(
        to_string(p.notices[1]),
        "p.json:9: #/scenes/0/levels/window: a level of 50 gives the luminaires 5000 % of "
        "their flux. Write 0.5 for 50 %?");
}

TEST(Scenes, ComplainAboutNamesAndLightThatIsNotThere) {
    EXPECT_THAT(
        scene_complaint(R"([{"name": "a", "levels": {"windw": 1}}])"),
        HasSubstr("p.json:9: #/scenes/0/levels/windw: unknown luminaires \"windw\" (no group, "
                  "type or luminaire has this name). Did you mean \"window\"?"));
    EXPECT_THAT(scene_complaint(R"([{"name": "a", "levels": {"dark": 1}}])"),
                HasSubstr("\"dark\" is off in the project (there is no light to scale)"));
    EXPECT_THAT(scene_complaint(R"([{"name": "a"}, {"name": "a"}])"),
                HasSubstr("the name \"a\" is taken"));
    EXPECT_THAT(scene_complaint(R"([{"levels": {}}])"),
                HasSubstr("the key \"name\" is missing"));
}

} // namespace
} // namespace isolux
