#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "cli/office.h"
#include "cli/program.h"

namespace isolux::test {
namespace {

class SenseVerb : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string project_ = folder_.write("office.json", office);

    [[nodiscard]] Ran sense(const std::string& input,
                            std::vector<std::string> options = {}) const {
        options.insert(options.begin(), {"sense", project_, "--tolerance", "5%"});
        return run_program(options, input);
    }
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

TEST_F(SenseVerb, AnswersEveryLineInOrder) {
    const Ran ran = sense("3 2 0.75 0 0 1\n# under the table\n\n3,2,0.75,0,0,-1\n");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const auto lines = lines_of(ran.out);
    ASSERT_EQ(lines.size(), 2u) << ran.out;
    for (const std::string& line : lines) {
        const std::size_t tab = line.find('\t');
        ASSERT_NE(tab, std::string::npos) << line;
        EXPECT_GT(std::atof(line.c_str()), 0.0);
        EXPECT_GE(std::atof(line.c_str() + tab), 0.0);
    }
    EXPECT_GT(std::atof(lines[0].c_str()), 2.0 * std::atof(lines[1].c_str()));
    EXPECT_EQ(ran.err, "");
}

TEST_F(SenseVerb, TellsOnceOfPointsWithoutLight) {
    const std::string input = "3 2 0.75 0 0 1\n7 2 0.75 0 0 1\n-1 2 0.75 0 0 1\n";
    const Ran ran = sense(input, {"--batch", "1"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(
        ran.err,
        "notice: stdin: 2 of 3 points outside every room (no light of a room gets there). "
        "Room \"office\" reaches from (0, 0, 0) to (6, 4, 3)\n");
    EXPECT_EQ(sense(input, {"--quiet"}).err, "");
}

TEST_F(SenseVerb, TellsOfPointsInsideObjects) {
    std::string text = office;
    text.insert(text.find("\"luminaire_types\""),
                R"("objects": [{"box": [1, 1, 0.76], "position": [3, 2, 0]}], )");
    const std::string project = folder_.write("desk.json", text);
    const Ran ran = run_program({"sense", project, "--tolerance", "5%"}, "3 2 0.5 0 0 1\n");
    EXPECT_EQ(ran.out, "0\t0\n");
    EXPECT_EQ(ran.err, "notice: stdin: 1 of 1 points inside an object (they get no light)\n");
}

TEST_F(SenseVerb, PrintsJsonLines) {
    const Ran ran = sense("3 2 0.75 0 0 1\n1 1 1 0 0 -2\n", {"--json"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const auto lines = lines_of(ran.out);
    ASSERT_EQ(lines.size(), 2u) << ran.out;
    EXPECT_TRUE(
        lines[1].starts_with(R"({"position":[1.0,1.0,1.0],"normal":[0.0,0.0,-1.0],"value":)"))
        << lines[1];
    for (const char* key : {"standard_error", "lower", "upper", "direct", "indirect"})
        EXPECT_NE(lines[1].find("\"" + std::string(key) + "\":"), std::string::npos) << key;
}

TEST_F(SenseVerb, AnswersInBatches) {
    std::string input;
    for (int i = 0; i < 10; ++i)
        input += "1 1 1 0 0 1\n";
    EXPECT_EQ(lines_of(sense(input, {"--batch", "4"}).out).size(), 10u);
    EXPECT_EQ(sense("").out, "");
    EXPECT_EQ(sense("").exit_code, 0);
}

TEST_F(SenseVerb, AnswersALineWhileTheNextIsStillToCome) {
    const Ran ran = run_shell("mkfifo '" + folder_.path("pipe")
                              + "'; (echo 1 1 1 0 0 1; sleep 3; echo x) | \"$ISOLUX\" sense '"
                              + project_ + "' --tolerance 5% --batch 1 > '"
                              + folder_.path("answers") + "' 2> /dev/null & sleep 2; wc -l < '"
                              + folder_.path("answers") + "'; wait");
    EXPECT_EQ(std::atoi(ran.out.c_str()), 1) << ran.out;
}

TEST_F(SenseVerb, StopsWhenItsReaderLeaves) {
    const Ran ran = run_shell("yes '1 1 1 0 0 1' | timeout 60 \"$ISOLUX\" sense '" + project_
                              + "' --tolerance 5% --batch 2 | head -n 1 | wc -l");
    EXPECT_EQ(std::atoi(ran.out.c_str()), 1);
    EXPECT_EQ(ran.err, "");
}

TEST_F(SenseVerb, NamesTheLineItCannotRead) {
    const Ran ran = sense("1 1 1 0 0 1\n1 1 1 0 0\n1 1 one 0 0 1\n");
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err,
              "error: stdin:2: 5 numbers in place of 6. A line is x y z nx ny nz, in metres\n"
              "error: stdin:3: 'one' is not a number. A line is x y z nx ny nz, in metres\n");
}

TEST_F(SenseVerb, RejectsAnEmptyBatch) {
    const Ran ran = sense("", {"--batch", "0"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err, "error: --batch: 0 is out of range (1 to 1000000)\n");
}

TEST_F(SenseVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"sense", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"Usage: isolux sense", "--json", "--batch", "Examples:", "echo"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text;
}

} // namespace
} // namespace isolux::test
