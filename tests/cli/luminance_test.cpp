#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "cli/office.h"
#include "cli/program.h"

namespace isolux::test {
namespace {

class LuminanceVerb : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string project_ = folder_.write("office.json", office);

    [[nodiscard]] Ran look(const std::string& input,
                           std::vector<std::string> options = {}) const {
        options.insert(options.begin(), {"luminance", project_, "--tolerance", "10%"});
        return run_program(options, input);
    }
};

TEST_F(LuminanceVerb, AnswersEveryLineInOrder) {
    // up at the first luminaire: 4000 lm x 0.8 over pi x 1.2 m x 0.3 m; then at the floor
    const Ran ran = look("1.5 1 1 0 0 1\n# the floor\n\n1.5,1,1,0,0,-1\n");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    std::istringstream in(ran.out);
    double up = 0.0;
    double up_error = 0.0;
    double down = 0.0;
    double down_error = 0.0;
    ASSERT_TRUE(in >> up >> up_error >> down >> down_error) << ran.out;
    EXPECT_NEAR(up, 2829.42, 0.01);
    EXPECT_GT(down, 1.0);
    EXPECT_LT(down, up);
    EXPECT_GT(down_error, 0.0);
}

TEST_F(LuminanceVerb, PrintsJsonLines) {
    const Ran ran = look("1.5 1 1 0 0 2\n", {"--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(
        ran.out.starts_with(R"({"eye":[1.5,1.0,1.0],"direction":[0.0,0.0,1.0],"value":2829.)"))
        << ran.out;
    for (const char* key :
         {"standard_error", "lower", "upper", "luminaires", "direct", "indirect"})
        EXPECT_NE(ran.out.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
}

TEST_F(LuminanceVerb, TellsEyesThatNoLightReaches) {
    const std::string lines = "1.5 1 1 0 0 -1\n1.5 1 -2 1 0 0\n";
    const Ran ran = look(lines);
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_TRUE(ran.err.starts_with(
        "notice: stdin: 1 of 2 eyes outside every room (no light of a room gets there)"))
        << ran.err;
    EXPECT_EQ(look(lines, {"--quiet"}).err, "");
}

TEST_F(LuminanceVerb, NamesTheLineItCannotRead) {
    const Ran ran = look("1 1 1 0 0 1\n1 1 1 0 0\n1 1 1 0 0 0\n");
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err,
              "error: stdin:2: 5 numbers in place of 6. A line is x y z dx dy dz, in metres\n"
              "error: stdin:3: the direction is zero (it points nowhere). 0 0 -1 looks down\n");
}

TEST_F(LuminanceVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"luminance", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"Usage: isolux luminance", "--json", "--batch", "cd/m2", "echo"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text;
}

} // namespace
} // namespace isolux::test
