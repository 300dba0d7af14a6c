#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/project_json.h"
#include "isolux/io/sha256.h"

#include "support/malformed_project.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace isolux::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The ```json blocks of the user guide.
std::vector<std::string> examples_of_guide() {
    const std::string guide =
        read_bytes(isolux::test::source_dir().string() + "/docs/project-file.md");
    const std::string fence = "```json\n";
    std::vector<std::string> examples;
    for (std::size_t at = guide.find(fence); at != std::string::npos;
         at = guide.find(fence, at)) {
        at += fence.size();
        examples.push_back(guide.substr(at, guide.find("```", at) - at));
    }
    return examples;
}

std::vector<std::string> notices_of(const Project& project) {
    std::vector<std::string> all;
    for (const Message& message : project.notices)
        all.push_back(to_string(message));
    return all;
}

TEST(ReadProject, TenLinesAreEnough) {
    const Project project = parse_project(examples_of_guide().at(0), "rooms/small.json");

    EXPECT_EQ(project.name, "small");
    ASSERT_EQ(project.scene.luminaires.size(), 6U);
    EXPECT_EQ(project.scene.luminaires[0].name, "panel 1");
    const Point3 first = project.scene.luminaires[0].world_from_luminaire.origin;
    EXPECT_DOUBLE_EQ(first.x, 1.0);
    EXPECT_DOUBLE_EQ(first.y, 1.0);
    EXPECT_DOUBLE_EQ(first.z, 2.999);
    ASSERT_EQ(project.surfaces.size(), 1U);
    EXPECT_EQ(project.surfaces[0].name, "office work plane");
    EXPECT_EQ(project.settings.tolerance, 0.01);
    EXPECT_EQ(project.settings.confidence, 0.95);
    EXPECT_THAT(
        notices_of(project),
        ElementsAre("rooms/small.json:1: no maintenance factor is given (1 is used: the "
                    "results are initial values). Set \"maintenance_factor\"?"));
}

TEST(ReadProject, UsesTheUsualReflectances) {
    const Project project = parse_project(small_project(), "p.json");

    const auto reflectance = [&](MaterialId id) {
        return std::get<Opaque>(project.scene.materials[id.index()].scattering).diffuse.g;
    };
    const Room& room = project.scene.rooms.at(0);
    EXPECT_EQ(reflectance(room.floor), 0.2);
    EXPECT_EQ(reflectance(room.ceiling), 0.7);
    EXPECT_EQ(reflectance(room.walls.at(3)), 0.5);
}

TEST(ReadProject, EveryExampleOfTheGuideWorksInOneProject) {
    const TemporaryFolder folder;
    const std::filesystem::path root = folder.path();
    std::filesystem::create_directories(root / "projects/guide");
    std::filesystem::copy(isolux::test::source_dir().string() + "/luminaires",
                          root / "luminaires",
                          std::filesystem::copy_options::recursive);
    write_bytes(root / "projects/guide/chair.obj",
                "v 0 0 0\nv 400 0 0\nv 400 400 0\nv 0 400 0\n"
                "usemtl fabric\nf 1 2 3\nusemtl chrome\nf 1 3 4\n");
    std::string text = "{\"isolux\": 1";
    const std::vector<std::string> examples = examples_of_guide();
    for (std::size_t i = 1; i < examples.size(); ++i)
        text += ",\n" + examples[i];
    write_bytes(root / "projects/guide/project.json", text + "}");

    const Project project = read_project(root / "projects/guide/project.json");

    EXPECT_EQ(examples.size(), 13U) << "one for each key of the top level";
    EXPECT_EQ(project.settings.tolerance, 0.02);
    EXPECT_EQ(project.settings.time_limit->count(), 300.0);
    EXPECT_EQ(project.scene.rooms.size(), 2U);
    EXPECT_EQ(project.scene.objects.size(), 8U + 3U);
    EXPECT_EQ(project.scene.luminaire_types.size(), 5U);
    EXPECT_EQ(project.scene.luminaires.size(), 6U + 5U + 8U + 1U + 2U);
    // Six of the guide's own; surroundings and background of the desk, three more walls and the
    // ceiling for the requirements.
    EXPECT_EQ(project.surfaces.size(), 6U + 6U);
    EXPECT_EQ(project.scenes.size(), 2U);
    EXPECT_EQ(project.observers.size(), 2U);
    ASSERT_EQ(project.inputs.size(), 3U);
    EXPECT_EQ(project.inputs[0].file, "chair.obj");
    EXPECT_EQ(project.file.sha256, sha256(text + "}"));
}

TEST(ReadProject, SaysWhereJsonEnds) {
    EXPECT_EQ(
        errors_of("{\n  \"isolux\": 1,\n}"),
        ":3:1: not valid JSON (unexpected '}'; expected string literal). Remove the comma "
        "before it?");
    EXPECT_EQ(errors_of("{\"isolux\": 1 \"rooms\": []}"),
              ":1:14: not valid JSON (unexpected string literal; expected '}'). Is a comma "
              "missing before it?");
    EXPECT_THAT(errors_of("{\"a\": 1,, \"b\": 2}"), HasSubstr("Remove one of the two commas?"));
    EXPECT_THAT(errors_of("{\"a\": [, 1]}"), HasSubstr("Remove the comma?"));
    EXPECT_THAT(errors_of("{\"a\": 'b'}"), HasSubstr("Write texts in double quotes?"));
    EXPECT_THAT(errors_of("{\"a\": 1e999}"), HasSubstr(":1:"));
    EXPECT_THAT(errors_of(""), HasSubstr(":1:1: not valid JSON (unexpected end of input"));
}

TEST(ReadProject, RefusesWhatIsNoProject) {
    EXPECT_EQ(errors_of("[1, 2]"), ":1: a project is an object {...} (found a list)");
    EXPECT_EQ(errors_of(std::string(200, '[') + std::string(200, ']')),
              ": nested more than 100 levels deep (no key needs that)");
    EXPECT_EQ(errors_of("{\"name\": \"" + std::string(20'000, 'x') + "\"}"),
              ": a text of more than 10000 bytes (no key needs one)");
}

TEST(ReadProject, ListsEveryProblemAtOnce) {
    EXPECT_EQ(
        errors_of(small_project({{"settings", R"({"tolerance": 2, "sed": 1})"},
                                 {"luminaires", R"([{"type": "panel"}, 3])"}})),
        "#/settings/sed: unknown key \"sed\" (settings has no such key). Did you mean "
        "\"seed\"?\n"
        "#/settings/tolerance: 2 is too large (it must be at most 0.5). Write \"2%\" or 0.02?\n"
        "#/luminaires/0: a luminaire needs one of \"position\", \"positions\", \"field\", "
        "\"line\" and \"ring\" (none is given)\n"
        "#/luminaires/1: a luminaire is an object {...} (found a number)");
}

TEST(ReadProject, SaysOnceWhatIsWrongWithALuminaire) {
    const std::string panels = R"([
        {"type": "panel", "position": [1, 1, 2]},
        {"type": "panel", "position": [2, 1, 2], "gruop": "window", "name": "w"}])";

    const std::string scene = R"([{"name": "a", "levels": {"window": 0.5, "w": 1}}])";
    EXPECT_EQ(errors_of(small_project({{"luminaires", panels}, {"scenes", scene}})),
              "#/luminaires/1/gruop: unknown key \"gruop\" (a luminaire has no such key). Did "
              "you mean \"group\"?");
    const std::string wall = R"([{"name": "a", "levels": {"wall": 0.5}}])";
    EXPECT_THAT(errors_of(small_project({{"luminaires", panels}, {"scenes", wall}})),
                HasSubstr("#/scenes/0/levels/wall: unknown luminaires \"wall\""));
}

TEST(ReadProject, SaysOnceWhatIsWrongWithASurface) {
    const std::string surfaces = R"([{"name": "lawn", "floor": {"rom": "office"}},
                                     {"name": "way", "rectangle": {}}])";
    const std::string observers =
        R"([{"position": [1, 1, 1.5], "rating": "GR", "ground": "way"}])";
    EXPECT_EQ(errors_of(small_project({{"surfaces", surfaces}, {"observers", observers}})),
              "#/surfaces/0/floor/rom: unknown key \"rom\" (a floor has no such key). Did you "
              "mean \"room\"?\n#/surfaces/1/rectangle: a rectangle needs one of \"corner\" "
              "and \"centre\" (none is given)");
}

TEST(ReadProject, StopsListingSomewhere) {
    std::string points;
    for (int i = 0; i < 1000; ++i)
        points += std::string(i > 0 ? "," : "") + "[1]";
    const std::string errors =
        errors_of(small_project({{"surfaces", "[{\"points\": [" + points + "]}]"}}));

    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 200);
    EXPECT_THAT(errors, HasSubstr("800 more problems (only the first are listed)"));
}

TEST(ReadProject, AsksForTheRoomIfThereAreTwo) {
    EXPECT_EQ(errors_of(small_project({{"rooms",
                                        R"([{"name": "office", "size": [6, 4], "height": 3},
                        {"name": "hall", "size": [2, 4], "position": [6, 0], "height": 3}])"},
                                       {"surfaces", R"([{"work_plane": {}}])"}})),
              "#/surfaces/0/work_plane: the key \"room\" is missing (the project has 2 rooms)");
}

TEST(ReadProject, OneWrongRoomGivesOneMessage) {
    EXPECT_EQ(errors_of(small_project(
                  {{"rooms", R"([{"name": "office", "size": [6, 4], "height": 0}])"},
                   {"surfaces", R"([{"work_plane": {"room": "office"}}])"},
                   {"luminaires", R"([{"type": "panel", "position": [1, 1, 2]}])"}})),
              "#/rooms/0/height: 0 is too small (it must be above 0 m)");
}

TEST(ReadProject, TellsWhichFileIsMissingAndWhichIsNear) {
    const TemporaryFolder folder;
    write_bytes(folder.path() / "downlight.ies", "");
    write_bytes(folder.path() / "p.json",
                small_project({{"luminaire_types", R"({"panel": {"file": "downligt.ies"}})"}}));
    const std::string path = (folder.path() / "p.json").generic_string();
    try {
        static_cast<void>(read_project(path));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(),
                  path + ":2: #/luminaire_types/panel/file: cannot find \""
                      + (folder.path() / "downligt.ies").generic_string()
                      + "\" (no such file). Did you mean \"downlight.ies\"?");
    }
}

TEST(ReadProject, PassesOnWhatTheFilesReadersSay) {
    const TemporaryFolder folder;
    write_bytes(folder.path() / "a.ies", "nothing\n");
    write_bytes(folder.path() / "a.obj", "v 0 0\n");
    write_bytes(folder.path() / "empty.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    write_bytes(folder.path() / "a.pts", "1 2 3\n1 2\n1 2 x\n");
    write_bytes(folder.path() / "p.json",
                small_project({{"luminaire_types", R"({"panel": {"file": "a.ies"}})"},
                               {"objects", R"([{"mesh": "a.obj"}, {"mesh": "empty.obj"}])"},
                               {"surfaces", R"([{"points_file": "a.pts"}])"}}));
    try {
        static_cast<void>(read_project(folder.path() / "p.json"));
        FAIL();
    } catch (const InputError& error) {
        const std::string all = error.what();
        const std::string at = folder.path().generic_string() + "/";
        EXPECT_THAT(all, HasSubstr(at + "a.ies"));
        EXPECT_THAT(all, HasSubstr(at + "a.obj:1"));
        EXPECT_THAT(all, HasSubstr("p.json:5: #/objects/1/mesh: the mesh has no faces"));
        EXPECT_THAT(all, HasSubstr(at + "a.pts:2: 2 numbers (a point is x y z or x y z nx"));
        EXPECT_THAT(all, HasSubstr(at + "a.pts:3: \"x\" is not a number"));
    }
}

TEST(ReadProject, RefusesAProjectThatIsNoFile) {
    const TemporaryFolder folder;
    const std::string path = folder.path().generic_string();
    EXPECT_THROW(static_cast<void>(read_project(path + "/none.json")), InputError);
    try {
        static_cast<void>(read_project(path));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), path + ": \"" + path + "\" is a folder (a file belongs here)");
    }
    EXPECT_THROW(static_cast<void>(read_project("/dev/zero")), InputError);
}

} // namespace
} // namespace isolux::test
