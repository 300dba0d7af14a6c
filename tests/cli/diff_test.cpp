#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/io/results_json.h"

#include "cli/program.h"
#include "support/sample_results.h"

namespace isolux::test {
namespace {

using testing::HasSubstr;

void write(const std::filesystem::path& folder, double shift) {
    Project project;
    project.name = "Office";
    project.file = {"office.json", std::string(64, shift == 0.0 ? 'a' : 'b')};
    Results r = make_results();
    r.surfaces[0].summary.mean.mean += shift;
    write_results(folder, make_results_document(project, {}, r));
}

TEST(DiffVerb, EndsWithZeroWhereNothingButInputsChanged) {
    const TemporaryFolder folder;
    write(folder.path("a"), 0.0);
    write(folder.path("b"), 1e-7);
    const std::string a = folder.path("a");
    const std::string b = folder.path("b");
    Ran ran = run_program({"diff", a, b});
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("input: project file: contents differ\n"));
    EXPECT_THAT(ran.out, HasSubstr("none changed beyond its error\n"));
    ran = run_program({"diff", "--strict", a, b});
    EXPECT_EQ(ran.exit_code, 1);
}

TEST(DiffVerb, AndOthersTellAProjectFromResults) {
    const TemporaryFolder folder;
    write(folder.path("a"), 0.0);
    const std::string file = folder.write("project.json", R"({"isolux": 1})");
    const auto complaint = [&](const std::string& argument) {
        return "error: " + argument + ": that is a project, not its results. Run `isolux run "
               + argument + "` first and name the folder it writes\n";
    };

    for (const char* verb : {"report", "scenes", "view"})
        for (const std::string& argument : {folder.path(), file}) {
            const Ran ran = run_program({verb, argument});
            EXPECT_EQ(ran.exit_code, 2) << verb;
            EXPECT_EQ(ran.err, complaint(argument)) << verb;
        }
    EXPECT_EQ(run_program({"diff", folder.path("a"), file}).err, complaint(file));
    const std::string empty = folder.path("empty");
    std::filesystem::create_directories(empty);
    EXPECT_EQ(run_program({"diff", empty, empty}).err,
              "error: " + empty
                  + ": no results.json in this folder. `isolux run PROJECT -o DIR` writes "
                    "results into DIR\n");
}

TEST(DiffVerb, EndsWithOneWhereAValueChanged) {
    const TemporaryFolder folder;
    write(folder.path("a"), 0.0);
    write(folder.path("b"), 100.0);
    const Ran ran = run_program({"diff", folder.path("a"), folder.path("b/results.json")});
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.out, HasSubstr("Em"));
    EXPECT_THAT(ran.out, HasSubstr("some changed beyond their errors"));
}

TEST(DiffVerb, EndsWithTwoWhereAResultIsMissing) {
    const TemporaryFolder folder;
    const Ran ran = run_program({"diff", folder.path(), folder.path("b")});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_THAT(ran.err, HasSubstr("results.json"));
}

} // namespace
} // namespace isolux::test
