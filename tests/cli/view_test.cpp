#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/office.h"
#include "cli/program.h"

namespace isolux::test {
namespace {

using testing::HasSubstr;

class ViewVerb : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string results_ = folder_.path("out");

    void SetUp() override {
        const std::string project = folder_.write("office.json", office);
        const Ran ran =
            run_program({"run", project, "-o", results_, "--tolerance", "10%", "--quiet"});
        ASSERT_EQ(ran.exit_code, 0) << ran.err;
    }

    [[nodiscard]] Ran view(const std::string& options) const {
        return run_shell("$ISOLUX view '" + results_ + "' " + options);
    }
};

TEST_F(ViewVerb, ProbesTheNearestPointWithoutAWindow) {
    const Ran ran = view("--probe 1,1,1.1");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out,
                HasSubstr("desk/1: point 1 at (1.000, 1.000, 1.000) m, 0.100 m away\n"));
    EXPECT_THAT(ran.out, HasSubstr("95 % interval ["));
    EXPECT_THAT(ran.out, HasSubstr("direct "));
}

TEST_F(ViewVerb, ProbesOneSurfaceAlone) {
    const Ran ran = view("--probe 1,1,1.1 --surface 'office work plane'");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("office work plane: point 1 at (1.000, 1.000, 0.750) m"));
}

TEST_F(ViewVerb, SaysThatThereIsNoDisplay) {
    const Ran unset = run_shell("unset DISPLAY; $ISOLUX view '" + results_ + "'");
    EXPECT_EQ(unset.exit_code, 2);
    EXPECT_EQ(
        unset.err,
        "error: isolux view: no window can be opened (DISPLAY is not set). `xvfb-run "
        "isolux view ... --screenshot FILE.png` needs no screen, `--probe x,y,z` alone no "
        "window\n");
    const Ran dead = run_shell("DISPLAY=:4711 $ISOLUX view '" + results_ + "'");
    EXPECT_EQ(dead.exit_code, 2);
    EXPECT_THAT(dead.err, HasSubstr("DISPLAY is :4711, where no X server answers"));
}

TEST_F(ViewVerb, SaysWhatIsWrongWithItsOptions) {
    const Ran camera = view("--camera fisheye");
    EXPECT_EQ(camera.exit_code, 2);
    EXPECT_EQ(camera.err,
              "error: --camera: 'fisheye' is no camera. Known are orbit, plan and section\n");
    const Ran place = view("--probe 1,two,3");
    EXPECT_EQ(place.exit_code, 2);
    EXPECT_EQ(place.err,
              "error: --probe: '1,two,3' is no place (x,y,z in metres is expected). --probe "
              "1.5,2,0.75, for example\n");
    const Ran picture = view("--screenshot office.bmp");
    EXPECT_EQ(picture.exit_code, 2);
    EXPECT_EQ(picture.err,
              "error: --screenshot: 'office.bmp' is no name of a picture. A name that ends in "
              ".png?\n");
    const Ran surface = view("--surface 'office work plan'");
    EXPECT_EQ(surface.exit_code, 2);
    EXPECT_THAT(
        surface.err,
        HasSubstr("there is no calculation surface 'office work plan' in these results. Did "
                  "you mean 'office work plane'?"));
}

/// In a virtual X server, where this machine has one.
class ViewWindow : public ViewVerb {
protected:
    void SetUp() override {
        if (std::system("command -v Xvfb >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "Xvfb is not installed";
        ViewVerb::SetUp();
    }

    /// The server picks a free display itself, so that tests may run side by side.
    [[nodiscard]] Ran view_in_x(const std::string& options) const {
        const std::string display = "'" + folder_.path("display") + "'";
        return run_shell("rm -f " + display
                         + "; Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>"
                         + display + " 2>/dev/null & X=$!; until [ -s " + display
                         + " ]; do kill -0 $X || exit 99; sleep 0.05; done; DISPLAY=:$(cat "
                         + display + ") $ISOLUX view '" + results_ + "' " + options
                         + "; status=$?; kill $X; wait $X 2>/dev/null; exit $status");
    }

    /// Colours in a picture, as ImageMagick counts them.
    static int colours_in(const std::string& png) {
        return std::atoi(run_shell("identify -format %k '" + png + "'").out.c_str());
    }
};

TEST_F(ViewWindow, WritesAPictureFromEveryCamera) {
    std::string last;
    for (const std::string camera : {"orbit", "plan", "section"}) {
        const std::string png = folder_.path(camera + ".png");
        const Ran ran = view_in_x("--camera " + camera + " --screenshot '" + png + "'");
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(ran.out, png + "\n");
        EXPECT_EQ(run_shell("identify -format %wx%h '" + png + "'").out, "1280x800");
        EXPECT_GT(colours_in(png), 50) << camera;
        EXPECT_NE(read_text(png), last) << camera;
        last = read_text(png);
    }
}

TEST_F(ViewWindow, SaysThatThePictureCannotBeWritten) {
    const Ran ran = view_in_x("--screenshot /nowhere/a.png 2>&1");
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_EQ(ran.out,
              "error: /nowhere/a.png: cannot be written (No such file or directory). Does the "
              "folder exist?\n");
}

TEST_F(ViewWindow, SaysWhichFileIsMissing) {
    for (const std::string file : {"photometric-webs.vtp", "room.vtp"}) {
        std::filesystem::remove(results_ + "/" + file);
        const Ran ran = view_in_x("--screenshot '" + folder_.path("a.png") + "' 2>&1");
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_THAT(ran.out, HasSubstr(file + ": there are no "));
        EXPECT_THAT(ran.out, HasSubstr("Calculate the project again with `isolux run`"));
    }
}

} // namespace
} // namespace isolux::test
