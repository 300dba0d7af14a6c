#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "cli/program.h"

namespace isolux::test {
namespace {

constexpr const char* viewed_office = R"({
  "isolux": 1,
  "name": "small office",
  "maintenance_factor": 0.8,
  "rooms": [{"name": "office", "size": [6, 4], "height": 3}],
  "luminaire_types": {"linear": {"lambertian": {"size": [1.2, 0.3], "flux": 4000}}},
  "luminaires": [{"type": "linear", "field": {"rows": 2, "columns": 2}}],
  "surfaces": [{"work_plane": {"height": 0.75, "edge": 0}, "grid": {"columns": 3, "rows": 2}}],
  "views": [
    {"name": "door", "position": [0.5, 0.5, 1.7], "target": [4, 3, 1], "resolution": [32, 20]},
    {"name": "plan", "plan": {}, "resolution": [30, 20]}
  ]
})";

class RenderVerb : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string project_ = folder_.write("office.json", viewed_office);

    [[nodiscard]] Ran render(std::vector<std::string> options) const {
        options.insert(options.begin(), {"render", project_, "-o", folder_.path("out")});
        return run_program(options);
    }

    [[nodiscard]] bool exists(const std::string& name) const {
        return std::filesystem::exists(folder_.path("out/" + name));
    }
};

TEST_F(RenderVerb, WritesThePicturesOfAView) {
    const Ran ran = render({"--view", "door", "--spp", "2"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    for (const char* file : {"door.exr", "door.png", "door-luminance.png"})
        EXPECT_TRUE(exists(file)) << file;
    EXPECT_FALSE(exists("door-illuminance.png"));
    EXPECT_FALSE(exists("plan.exr"));
    EXPECT_NE(ran.out.find("view door: 32 x 20 pixels, 2 rays a pixel, raw error "),
              std::string::npos)
        << ran.out;
    EXPECT_NE(ran.out.find(" EV "), std::string::npos) << ran.out;
}

TEST_F(RenderVerb, RendersEveryViewUnlessOneIsNamed) {
    const Ran ran = render({"--preview", "--quantity", "illuminance", "--quiet"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.out, "");
    for (const char* file : {"door.exr", "plan.exr", "plan-illuminance.png"})
        EXPECT_TRUE(exists(file)) << file;
}

TEST_F(RenderVerb, StopsAtATimeLimit) {
    const Ran ran =
        render({"--view", "door", "--time", "1s", "--tolerance", "0.01%", "--filter", "none"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_NE(ran.out.find("(stopped early)"), std::string::npos) << ran.out;
    EXPECT_TRUE(exists("door.exr"));
}

TEST_F(RenderVerb, KeepsThePictureSoFarWhenInterrupted) {
    const Ran ran = run_shell("\"$ISOLUX\" render '" + project_ + "' -o '" + folder_.path("out")
                              + "' --view door --spp 60000 --filter none & pid=$!; sleep 2; "
                                "kill -INT $pid; wait $pid; echo status $?");
    EXPECT_NE(ran.out.find("status 1"), std::string::npos) << ran.out << ran.err;
    EXPECT_TRUE(exists("door.exr"));
    EXPECT_TRUE(exists("door.png"));
}

TEST_F(RenderVerb, UsesADenoiserTheMachineHas) {
    const Ran ran = run_shell(
        "LD_LIBRARY_PATH='" ISOLUX_FAKE_DENOISER_FOLDER "' \"$ISOLUX\" render '" + project_
        + "' -o '" + folder_.path("out") + "' --view door --spp 2 --filter oidn");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(exists("door.exr"));
}

TEST_F(RenderVerb, SaysThatThereIsNoDenoiser) {
    if (std::system("ldconfig -p | grep -q libOpenImageDenoise.so.2") == 0)
        GTEST_SKIP() << "this machine has Open Image Denoise";
    const Ran ran = render({"--view", "door", "--filter", "oidn"});
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_EQ(ran.err,
              "error: Open Image Denoise 2 is not on this machine (libOpenImageDenoise.so.2 "
              "cannot be loaded). Install it, or use --filter axis-aligned?\n");
}

TEST_F(RenderVerb, RejectsWhatItDoesNotKnow) {
    const auto error_of = [&](std::vector<std::string> options) {
        const Ran ran = render(std::move(options));
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_EQ(ran.out, "");
        return ran.err;
    };
    EXPECT_EQ(error_of({"--view", "dor"}),
              "error: --view: the project has no view \"dor\". Did you mean \"door\"?\n");
    EXPECT_EQ(error_of({"--view", "window"}),
              "error: --view: the project has no view \"window\". Its views are: door, plan\n");
    EXPECT_EQ(
        error_of({"--filter", "bilateral"}),
        "error: --filter: 'bilateral' is not known. Known are none, axis-aligned, oidn\n");
    EXPECT_EQ(error_of({"--quantity", "illuminence"}),
              "error: --quantity: 'illuminence' is not known. Did you mean illuminance?\n");
    EXPECT_EQ(error_of({"--spp", "1"}), "error: --spp: 1 is out of range (2 to 65535)\n");
}

TEST_F(RenderVerb, SaysThatAProjectHasNoViews) {
    const std::string bare =
        folder_.write("bare.json",
                      R"({"isolux": 1, "luminaire_types": {"b": {"isotropic": {"flux": 500}}},
            "luminaires": [{"type": "b", "position": [0, 0, 2]}]})");
    const Ran ran = run_program({"render", bare, "-o", folder_.path("out")});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: " + bare
                  + ":1: the project has no views (nothing says where to look from). Add "
                    "\"views\": [{\"name\": \"door\", \"position\": [x, y, z], \"target\": [x, "
                    "y, z]}]?\n");
}

TEST_F(RenderVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"render", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"Usage: isolux render", "--preview", "--filter", "Ctrl-C"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text;
}

TEST_F(RenderVerb, IsPartOfRunUnlessItIsNotWanted) {
    const std::string out = folder_.path("run");
    Ran ran = run_program({"run", project_, "-o", out, "--tolerance", "20%", "--no-views"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(out + "/views"));
    ran = run_program({"run", project_, "-o", out, "--tolerance", "20%"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(std::filesystem::exists(out + "/views/door.exr"));
    EXPECT_TRUE(std::filesystem::exists(out + "/views/plan.png"));
    EXPECT_NE(read_text(out + "/report.html").find("alt=\"door\""), std::string::npos);
    EXPECT_NE(ran.out.find("view door: 32 x 20 pixels"), std::string::npos) << ran.out;
    // What an earlier run saw is not what this one calculated.
    ran = run_program({"run", project_, "-o", out, "--tolerance", "20%", "--no-views"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(out + "/views/door.exr"));
    EXPECT_FALSE(std::filesystem::exists(out + "/views/plan.png"));
    EXPECT_EQ(read_text(out + "/report.html").find("alt=\"door\""), std::string::npos);
}

} // namespace
} // namespace isolux::test
