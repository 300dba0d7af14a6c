#include <gtest/gtest.h>

#include "cli/program.h"
#include "support/source_dir.h"

namespace isolux::test {
namespace {

TEST(SchemaVerb, PrintsTheProjectSchemaByDefault) {
    const Ran ran = run_program({"schema"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out,
              read_text(isolux::test::source_dir().string() + "/schema/project.schema.json"));
    EXPECT_EQ(ran.out, run_program({"schema", "project"}).out);
}

TEST(SchemaVerb, PrintsTheResultsSchema) {
    const Ran ran = run_program({"schema", "results"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out,
              read_text(isolux::test::source_dir().string() + "/schema/results.schema.json"));
}

TEST(SchemaVerb, PrintsTheSchemaOfStandards) {
    const Ran ran = run_program({"schema", "standard"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_EQ(ran.out,
              read_text(isolux::test::source_dir().string() + "/schema/standard.schema.json"));
}

TEST(SchemaVerb, ListsSchemasToWhoeverWantsAnother) {
    const Ran ran = run_program({"schema", "luminaire"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(
        ran.err,
        "error: isolux schema: there is no schema 'luminaire'. Known are project, results, "
        "standard\n");
}

TEST(SchemaVerb, SuggestsTheSchemaThatWasMeant) {
    const Ran ran = run_program({"schema", "projects"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux schema: there is no schema 'projects'. Did you mean project?\n");
}

TEST(SchemaVerb, HasHelpWithExamples) {
    const Ran ran = run_program({"schema", "--help"});
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_NE(ran.out.find("Usage: isolux schema [OPTIONS] [NAME]"), std::string::npos)
        << ran.out;
    EXPECT_NE(ran.out.find("Examples:"), std::string::npos);
}

TEST(SchemaVerb, RejectsWhatItDoesNotKnow) {
    const Ran ran = run_program({"schema", "project", "results", "--hlep", "--zzz=1"});
    EXPECT_EQ(ran.exit_code, 2);
    EXPECT_EQ(ran.err,
              "error: isolux schema: 'results' is one argument too many\n"
              "error: isolux schema: unknown option '--hlep'. Did you mean --help?\n"
              "error: isolux schema: unknown option '--zzz'. `isolux schema --help` lists the "
              "options\n");
}

} // namespace
} // namespace isolux::test
