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
