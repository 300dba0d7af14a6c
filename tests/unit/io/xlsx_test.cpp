#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Xlsx, HasMoreSheetsThanAProcessMayOpenFiles) {
    ResultsDocument document = make_document();
    document.results.surfaces.resize(1100, document.results.surfaces.front());
    const test::TemporaryFolder folder;
    write_xlsx(folder.path() / "a.xlsx", document);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.xlsx"});
}

TEST(Xlsx, SaysWhereItCannotBeWritten) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_xlsx(folder.path() / "none" / "a.xlsx", make_document()), WriteError);
}

} // namespace
} // namespace isolux
