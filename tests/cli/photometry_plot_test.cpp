#include <gtest/gtest.h>

#include "cli/program.h"
#include "support/source_dir.h"

namespace isolux::test {
namespace {

const std::string luminaire =
    isolux::test::source_dir().string() + "/luminaires/batwing-linear.ldt";

TEST(PhotometryPlot, WritesThePictureItIsAskedFor) {
    const TemporaryFolder folder;
    for (const auto& [name, start] : {std::pair{"a.svg", "<?xml"},
                                      std::pair{"a.png", "\x89PNG"},
                                      std::pair{"a.pdf", "%PDF"}}) {
        const std::string file = folder.path(name);
        const Ran ran = run_program({"photometry", "plot", luminaire, "-o", file});
        EXPECT_EQ(ran.exit_code, 0) << ran.err;
        EXPECT_EQ(ran.out, file + "\n");
        EXPECT_TRUE(read_text(file).starts_with(start)) << name;
    }
}

TEST(PhotometryPlot, ShowsOneDiagramPerKilolumenWhereAsked) {
    const TemporaryFolder folder;
    const std::string file = folder.path("a.svg");
    const Ran ran = run_program(
        {"photometry", "plot", luminaire, "-o", file, "--kind", "polar", "--scale", "cd/klm"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const std::string svg = read_text(file);
    EXPECT_NE(svg.find("cd per 1000 lm"), std::string::npos);
    EXPECT_EQ(svg.find("Cartesian"), std::string::npos);
}

TEST(PhotometryPlot, ExplainsOptionsItDoesNotKnow) {
    const auto error_of = [](std::vector<std::string> options) {
        options.insert(options.begin(), {"photometry", "plot", luminaire});
        const Ran ran = run_program(options);
        EXPECT_EQ(ran.exit_code, 2);
        return ran.err;
    };
    EXPECT_EQ(error_of({"-o", "a.svg", "--kind", "polr"}),
              "error: --kind: 'polr' is not known. Did you mean polar?\n");
    EXPECT_EQ(error_of({"-o", "a.svg", "--scale", "lumen"}),
              "error: --scale: 'lumen' is not known. Choose one of cd, cd/klm\n");
    EXPECT_EQ(error_of({"-o", "a.jpg"}),
              "error: a.jpg: no picture format goes by this name. A name that ends in .svg, "
              ".png or .pdf?\n");
}

} // namespace
} // namespace isolux::test
