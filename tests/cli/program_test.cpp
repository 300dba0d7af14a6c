#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/program.h"

namespace isolux::test {

namespace {

std::string quote(const std::string& word) {
    std::string quoted = "'";
    for (const char c : word) {
        if (c == '\'')
            quoted.append("'\\''");
        else
            quoted.push_back(c);
    }
    quoted.push_back('\'');
    return quoted;
}

} // namespace

TemporaryFolder::TemporaryFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "isolux-cli-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::path(const std::string& name) const {
    return name.empty() ? path_ : path_ + "/" + name;
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
}

std::string read_text(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

Ran run_shell(const std::string& script) {
    const TemporaryFolder folder;
    const std::string command = "ISOLUX=" + quote(ISOLUX_PROGRAM) + "; export ISOLUX; ( "
                                + script + "\n) > " + quote(folder.path("out")) + " 2> "
                                + quote(folder.path("err"));
    const int status = std::system(command.c_str());
    Ran ran;
    ran.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ran.out = read_text(folder.path("out"));
    ran.err = read_text(folder.path("err"));
    return ran;
}

Ran run_program(const std::vector<std::string>& arguments, const std::string& input) {
    const TemporaryFolder folder;
    std::string script = "\"$ISOLUX\"";
    for (const std::string& argument : arguments)
        script.append(" ").append(quote(argument));
    return run_shell(script + " < " + quote(folder.write("in", input)));
}

namespace {

TEST(Program, HasAVersion) {
    const Ran ran = run_program({"--version"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out, "isolux " ISOLUX_VERSION "\n");
    EXPECT_EQ(ran.err, "");
}

TEST(Program, ExplainsItselfWhenAsked) {
    const Ran ran = run_program({"--help"});
    EXPECT_EQ(ran.exit_code, 0);
    for (const char* text :
         {"Usage: isolux [OPTIONS] VERB", "Verbs:", "Examples:", "Exit status:"})
        EXPECT_NE(ran.out.find(text), std::string::npos) << text;
    EXPECT_EQ(ran.err, "");
}

TEST(Program, WithoutArgumentsPrintsHelpAndFails) {
    const Ran ran = run_program({});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, run_program({"--help"}).out);
}

TEST(Program, SuggestsTheVerbThatWasMeant) {
    const Ran ran = run_program({"shcema"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err,
              "error: isolux: 'shcema' is not a verb. Did you mean `isolux schema`?\n");
}

TEST(Program, ListsVerbsToWhoeverTypesSomethingElse) {
    const Ran ran = run_program({"illuminate"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux: 'illuminate' is not a verb. `isolux --help` lists the verbs\n");
}

TEST(Program, TakesAFileInPlaceOfAVerbForAProject) {
    const TemporaryFolder folder;
    const Ran ran = run_program({folder.path()});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux: '" + folder.path() + "' is not a verb. Did you mean `isolux run "
                  + folder.path() + "`?\n");
}

TEST(Program, WantsTheVerbFirst) {
    const Ran ran = run_program({"--quiet", "run"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux: unknown option '--quiet'. The verb comes first, its options "
              "after it: `isolux run --help`\n");
}

TEST(Program, FailsWhenItsOutputCannotBeWritten) {
    const Ran ran = run_shell("\"$ISOLUX\" --help > /dev/full");
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_EQ(ran.err, "error: standard output: No space left on device\n");
}

TEST(Program, IsContentWhenItsReaderLeaves) {
    const Ran ran = run_shell("( sleep 0.2; \"$ISOLUX\" --help; echo $? >&2 ) | true");
    EXPECT_EQ(ran.err, "0\n");
}

} // namespace
} // namespace isolux::test
