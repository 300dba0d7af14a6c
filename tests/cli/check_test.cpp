#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "cli/office.h"
#include "cli/program.h"
#include "support/source_dir.h"

namespace isolux::test {
namespace {

TEST(CheckVerb, SumsUpAGoodProject) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"check", folder.write("office.json", office)});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.out,
              "small office: 1 room, 0 objects, 5 luminaires, 2 calculation surfaces with 7 "
              "points; 13200 lm over 24 m2 of floor, 550 lm/m2\n"
              "luminaires: 4 x linear: 4000 lm each x 0.8 (maintenance, dimming), 12800 lm in "
              "all as hung; long side 1.2 m "
              "along world x\n"
              "luminaires: 1 x bulb: 500 lm each x 0.8 (maintenance, dimming), 400 lm in all "
              "as hung; no long side\n"
              "surface: office work plane, 6 points in a grid of 3 x 2\n"
              "surface: desk/1, 1 point\n"
              "no errors, nothing odd\n");
    EXPECT_EQ(ran.err, "");
}

TEST(CheckVerb, ListsWhatIsOdd) {
    const TemporaryFolder folder;
    const std::string project =
        folder.write("office.json",
                     R"({"isolux": 1, "rooms": [{"size": [6, 4], "height": 3}],
            "luminaire_types": {"bulb": {"isotropic": {"flux": 500}}},
            "luminaires": [{"type": "bulb", "position": [3, 2, 2]}]})");
    const Ran ran = run_program({"check", project});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.out.find("notice: " + project + ":1: no maintenance factor is given"),
              std::string::npos)
        << ran.out;
    EXPECT_NE(ran.out.find("no errors, 1 notice\n"), std::string::npos) << ran.out;
}

TEST(CheckVerb, ListsEveryError) {
    const TemporaryFolder folder;
    const std::string project =
        folder.write("office.json",
                     R"({"isolux": 1, "rooms": [{"size": [6, 4], "hight": 3}],
            "luminaire_types": {"bulb": {"isotropic": {"flux": -500}}},
            "luminaires": [{"type": "bulb", "position": [3, 2, 2]}]})");
    const Ran ran = run_program({"check", project});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_NE(ran.err.find("error: " + project + ":1: #/rooms/0"), std::string::npos)
        << ran.err;
    EXPECT_NE(ran.err.find("error: " + project + ":2: #/luminaire_types/bulb"),
              std::string::npos)
        << ran.err;
}

TEST(CheckVerb, SaysWhenThereIsNoProject) {
    const Ran ran = run_program({"check", "/nowhere/at/all"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err, "error: /nowhere/at/all: no such file or folder\n");
}

TEST(CheckVerb, KnowsALuminaireFile) {
    const TemporaryFolder folder;
    for (const char* name : {"lamp.ldt", "lamp.IES"}) {
        const std::string file = folder.write(name, "1\n");
        const Ran ran = run_program({"check", file});
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_EQ(ran.err,
                  "error: " + file
                      + ": this is a luminaire file, not a project. `isolux photometry info "
                      + file + "` tells what it says\n");
    }
}

TEST(CheckVerb, TellsWhereNoLightComes) {
    const TemporaryFolder folder;
    const std::string project = folder.write("p.json", R"({"isolux": 1,
        "maintenance_factor": 0.8,
        "rooms": [{"name": "office", "size": [6, 4], "height": 3}],
        "objects": [{"name": "desk", "box": [1, 1, 0.76], "position": [3, 2, 0]}],
        "luminaire_types": {"bulb": {"isotropic": {"flux": 500}}},
        "luminaires": [{"type": "bulb", "position": [3, 2, 2]}],
        "surfaces": [{"name": "plane", "points": [[3, 2, 0.75], [1, 1, 0.75]]}],
        "observers": [{"name": "door", "position": [7, 2, 1.6], "direction": 180}],
        "views": [{"name": "street", "position": [-1, 2, 1.6], "target": [3, 2, 1]}]})");
    const Ran ran = run_program({"check", project});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"notice: surface 'plane': 1 of 2 points lies inside 'desk'",
                             "notice: observers 'door': ",
                             "notice: view 'street': its camera lies outside every room",
                             "no errors, 3 notices\n"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text << "\n" << ran.out;
}

TEST(CheckVerb, FindsNothingOddInTheProjectOfTheReadme) {
    std::ifstream in(source_dir() / "README.md");
    const std::string readme{std::istreambuf_iterator<char>(in), {}};
    const std::string opening = "```json\n{\n";
    const std::size_t from = readme.find(opening);
    ASSERT_NE(from, std::string::npos);
    const std::size_t first = from + opening.size() - 2;
    const TemporaryFolder folder;
    std::filesystem::copy(source_dir() / "luminaires/wall-washer.ies", folder.path());
    const Ran ran =
        run_program({"check",
                     folder.write("classroom.json",
                                  readme.substr(first, readme.find("```", first) - first))});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.out.find("no errors, nothing odd\n"), std::string::npos) << ran.out;
}

TEST(CheckVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"check", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"Usage: isolux check", "Examples:", "Exit status:"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text;
}

} // namespace
} // namespace isolux::test
