#include <csignal>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "isolux/io/safe_file.h"
#include "isolux/io/xlsx.h"

#include "support/sample_results.h"
#include "support/temporary_folder.h"

namespace isolux {
namespace {

ResultsDocument make_document() {
    Project project;
    project.name = "Office";
    project.file = {"office.json", std::string(64, 'a')};
    project.schedule = {{"panel", "a.ies", "Maker", "Panel", 9, 3600.0, 36.0, 80.0, {}}};
    return make_results_document(project, {}, test::make_results());
}

TEST(SheetNames, AreShortAllowedAndAllDifferent) {
    const std::vector<std::string> names{
        "desk", "Desk", "a/b:c", "", std::string(40, 'x'), std::string(41, 'x'), "summary"};
    const std::vector<std::string> reserved{"Summary"};
    const auto sheets = sheet_names(names, reserved);
    EXPECT_EQ(sheets,
              (std::vector<std::string>{"desk",
                                        "Desk (2)",
                                        "a_b_c",
                                        "sheet",
                                        std::string(31, 'x'),
                                        std::string(27, 'x') + " (2)",
                                        "summary (2)"}));
}

TEST(Xlsx, IsAZipArchiveAndEqualForEqualResults) {
    const test::TemporaryFolder folder;
    write_xlsx(folder.path() / "a.xlsx", make_document());
    write_xlsx(folder.path() / "b.xlsx", make_document());
    const std::string bytes = test::read_bytes(folder.path() / "a.xlsx");
    ASSERT_GT(bytes.size(), 1000U);
    EXPECT_EQ(bytes.substr(0, 2), "PK");
    EXPECT_TRUE(bytes == test::read_bytes(folder.path() / "b.xlsx"));
    EXPECT_EQ(folder.names().size(), 2U); // no draft is left behind
}

/// So many rows wait in files while there are files to spare, else in memory.
TEST(Xlsx, HasManyRowsOnMoreSheetsThanAProcessMayOpenFiles) {
    ResultsDocument document = make_document();
    SurfaceResult& first = document.results.surfaces.front();
    first.points.resize(10000, first.points.front());
    first.surface.receivers.resize(10000, first.surface.receivers.front());
    SurfaceResult small = first;
    small.points.resize(1);
    small.surface.receivers.resize(1);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit few = before;
    few.rlim_cur = 64;
    for (const std::size_t sheets : {1U, 200U, 201U, 1100U})
        for (const rlimit& limit : {before, few}) {
            document.results.surfaces.resize(sheets, small);
            const test::TemporaryFolder folder;
            ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &limit), 0);
            EXPECT_NO_THROW(write_xlsx(folder.path() / "a.xlsx", document)) << sheets;
            ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
            EXPECT_EQ(folder.names(), std::vector<std::string>{"a.xlsx"}) << sheets;
        }
}

/// The disk is full when rows that wait in files are to be written, but has room for what is
/// left of them.
TEST(Xlsx, LosesNoRowsInSilence) {
    ResultsDocument document = make_document();
    SurfaceResult& first = document.results.surfaces.front();
    first.points.resize(20000, first.points.front());
    first.surface.receivers.resize(20000, first.surface.receivers.front());
    const test::TemporaryFolder folder;
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit little = before;
    little.rlim_cur = 1U << 20U;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    EXPECT_THROW(write_xlsx(folder.path() / "a.xlsx", document), WriteError);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_TRUE(folder.names().empty());
}

TEST(Xlsx, SaysWhereItCannotBeWritten) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_xlsx(folder.path() / "none" / "a.xlsx", make_document()), WriteError);
}

} // namespace
} // namespace isolux
