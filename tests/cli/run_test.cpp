#include <filesystem>

#include <gtest/gtest.h>

#include "cli/office.h"
#include "cli/program.h"

namespace isolux::test {
namespace {

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// results.json without its last member, the time.
std::string without_time(const std::string& json) {
    return json.substr(0, json.rfind("\"time\""));
}

class RunVerb : public testing::Test {
protected:
    TemporaryFolder folder_;
    std::string project_ = folder_.write("office.json", office);
    std::string results_ = folder_.path("out");

    [[nodiscard]] Ran run(std::vector<std::string> options) const {
        options.insert(options.begin(), {"run", project_, "-o", results_});
        return run_program(options);
    }

    [[nodiscard]] std::string json() const { return read_text(results_ + "/results.json"); }
};

TEST_F(RunVerb, WritesEveryKindOfResult) {
    const Ran ran = run({"--tolerance", "5%"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    for (const char* file : {"results.json",
                             "contributions.npy",
                             "contributions.json",
                             "office work plane.csv",
                             "office work plane.vtp",
                             "desk_1.csv",
                             "desk_1.vtp",
                             "room.vtp",
                             "maps/plan.svg",
                             "maps/plan.png",
                             "maps/office work plane.svg",
                             "maps/office work plane.png",
                             "maps/desk_1.svg",
                             "maps/desk_1.png"})
        EXPECT_GT(read_text(results_ + "/" + file).size(), 100u) << file;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(results_))
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST_F(RunVerb, PrintsASummary) {
    const Ran ran = run({"--tolerance", "5%"});
    for (const char* text : {"small office\n",
                             "surface            points",
                             "Em [lx]",
                             "office work plane       6",
                             "desk/1                  1",
                             "+- is half the 95 % confidence interval",
                             "flux: 13200 lm emitted = ",
                             "light paths",
                             "luminaires: 4 x linear: 4000 lm each x 0.8 (maintenance, "
                             "dimming), 12800 lm in all as hung; long "
                             "side 1.2 m along world x",
                             "luminaires: 1 x bulb: 500 lm each x 0.8 (maintenance, dimming), "
                             "400 lm in all as hung; no long side",
                             "values are maintained ones: maintenance factor 0.8\n",
                             "all done in ",
                             "results.json"})
        EXPECT_TRUE(contains(ran.out, text)) << text << "\n" << ran.out;
    EXPECT_EQ(ran.err, "");
}

TEST_F(RunVerb, IsQuietWhenAsked) {
    const Ran ran = run({"--tolerance", "5%", "--quiet"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "");
}

TEST_F(RunVerb, NamesTheResultsFolderAfterTheProject) {
    const Ran ran = run_shell("cd '" + folder_.path()
                              + "' && \"$ISOLUX\" run office.json --tolerance 5% --quiet");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_GT(read_text(folder_.path("results/small office/results.json")).size(), 0u);
}

TEST_F(RunVerb, GivesTheSameBitsForAnyNumberOfThreads) {
    std::string first;
    for (const char* threads : {"1", "2", "7"}) {
        EXPECT_EQ(run({"--tolerance", "5%", "--quiet", "--threads", threads}).exit_code, 0);
        if (first.empty())
            first = without_time(json());
        EXPECT_EQ(without_time(json()), first) << threads;
    }
    EXPECT_GT(first.size(), 1000u);
}

TEST_F(RunVerb, TakesSeedAndEstimatorFromTheCommandLine) {
    EXPECT_EQ(run({"--tolerance", "5%", "--quiet", "--seed", "1"}).exit_code, 0);
    const std::string one = without_time(json());
    EXPECT_EQ(run({"--tolerance", "5%", "--quiet", "--seed", "2"}).exit_code, 0);
    EXPECT_NE(without_time(json()), one);
    EXPECT_EQ(run({"--tolerance", "5%", "--quiet", "--estimator", "path-tracing"}).exit_code,
              0);
    EXPECT_TRUE(contains(json(), "path tracing")) << json().substr(0, 800);
}

TEST_F(RunVerb, ExplainsOptionsItCannotRead) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--tolerance", "1"},
         "error: --tolerance: 1 means 100 % (a tolerance is 0.01 % to 50 %). Did you forget "
         "the "
         "percent sign?\n"},
        {{"--time", "soon"},
         "error: --time: 'soon' is not a time. Write a number and s, min or h, such as 60s, "
         "1.5min or 2h\n"},
        {{"--threads", "0"}, "error: --threads: 0 is out of range (1 to 1024)\n"},
        {{"--seed", "one"}, "error: --seed: 'one' is not a whole number\n"},
        {{"--estimator", "pathtracing"},
         "error: --estimator: 'pathtracing' is not an estimator. Did you mean path-tracing?\n"},
        {{"--tolerence", "1%"},
         "error: isolux run: unknown option '--tolerence'. Did you mean --tolerance?\n"}};
    for (const auto& [options, message] : cases) {
        const Ran ran = run(options);
        EXPECT_EQ(ran.exit_code, 2);
        EXPECT_EQ(ran.out, "");
        EXPECT_EQ(ran.err, message);
    }
    EXPECT_FALSE(std::filesystem::exists(results_));
}

TEST_F(RunVerb, AsksForAProject) {
    const Ran ran = run_program({"run"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err, "error: isolux run: PROJECT is required. See `isolux run --help`\n");
}

TEST_F(RunVerb, PrintsEveryErrorOfAProjectOnALineOfItsOwn) {
    const std::string broken = folder_.write(
        "broken.json",
        R"({"isolux": 1, "rooms": [{"size": [6, 4], "height": -3}], "luminaire_types": {},
            "luminaires": [{"type": "panel", "position": [1, 1, 1]}]})");
    const Ran ran = run_program({"run", broken, "-o", results_});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(contains(ran.err, "error: " + broken + ":1: #/rooms/0/height")) << ran.err;
    EXPECT_TRUE(contains(ran.err, "\nerror: " + broken + ":1: #/luminaire")) << ran.err;
    EXPECT_FALSE(std::filesystem::exists(results_));
}

TEST_F(RunVerb, EndsWhenTheTimeIsOver) {
    const Ran ran = run({"--tolerance", "0.01%", "--time", "0.3s"});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(contains(ran.out, "not converged")) << ran.out;
    EXPECT_EQ(
        ran.err,
        "notice: the time limit of 0.3 s ended the calculation before every point reached "
        "the tolerance of 0.01 %. Allow more time (--time) or a wider tolerance "
        "(--tolerance)\n");
    EXPECT_TRUE(contains(json(), "\"converged\": false"));
    EXPECT_TRUE(contains(json(), "\"interrupted\": true"));
    EXPECT_TRUE(contains(json(), "the time limit of 0.3 s"));
}

TEST_F(RunVerb, WritesWhatThereIsAfterCtrlC) {
    const Ran ran = run_shell("\"$ISOLUX\" run '" + project_ + "' -o '" + results_
                              + "' --tolerance 0.01% --time 60s & pid=$!; sleep 1.5; "
                                "kill -INT $pid; wait $pid");
    EXPECT_EQ(ran.exit_code, 1) << ran.err;
    EXPECT_EQ(ran.err,
              "notice: stopped by the user before every point reached the tolerance\n");
    EXPECT_TRUE(contains(ran.out, "not converged")) << ran.out;
    EXPECT_TRUE(contains(json(), "\"converged\": false"));
    EXPECT_TRUE(contains(json(), "\"interrupted\": true"));
}

TEST_F(RunVerb, ShowsProgressOnATerminalAndWipesIt) {
    // script(1) gives the program a terminal; its output is what the terminal saw.
    if (run_shell("script -qec true /dev/null < /dev/null").exit_code != 0)
        GTEST_SKIP() << "no pseudo-terminal to be had here (is /dev/pts mounted?)";
    const Ran ran = run_shell("TERM=xterm script -qec \"'$ISOLUX' run '" + project_ + "' -o '"
                              + results_ + "' --tolerance 0.5%\" /dev/null < /dev/null");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_TRUE(contains(ran.out, "\rpilot")) << ran.out;
    EXPECT_FALSE(contains(ran.out, "\x1b")) << "escape sequences";
    const Ran quiet =
        run_shell("TERM=xterm script -qec \"'$ISOLUX' run '" + project_ + "' -o '" + results_
                  + "' --tolerance 0.5% --quiet\" /dev/null < /dev/null");
    EXPECT_EQ(quiet.out, "");
}

TEST_F(RunVerb, SaysWhichFileItCannotWrite) {
    const std::string file = folder_.write("occupied", "");
    const Ran ran = run_program({"run", project_, "-o", file + "/results"});
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_TRUE(contains(ran.err, "error: " + file)) << ran.err;
}

TEST_F(RunVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"run", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text : {"Usage: isolux run [OPTIONS] PROJECT",
                             "--tolerance",
                             "--time",
                             "--threads",
                             "--seed",
                             "--estimator",
                             "--quiet",
                             "-o,--output",
                             "Examples:",
                             "Exit status:"})
        EXPECT_TRUE(contains(ran.out, text)) << text << "\n" << ran.out;
}

} // namespace
} // namespace isolux::test
