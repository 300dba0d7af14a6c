#include <algorithm>
#include <map>
#include <sstream>

#include <gmock/gmock.h>

#include "support/photometric_files.h"

namespace isolux {
namespace {

struct Verdict {
    std::string verdict; ///< error, warning or ok
    std::string line;

    bool operator==(const Verdict&) const = default;
};

struct Row {
    std::string file;
    std::string problem;
    Verdict expected;
};

std::vector<Row> read_manifest() {
    std::istringstream stream(corpus::read_bytes(corpus::root() / "broken" / "MANIFEST.tsv"));
    std::vector<Row> rows;
    std::string text;
    std::getline(stream, text);
    while (std::getline(stream, text)) {
        std::istringstream columns(text);
        Row row;
        std::getline(columns, row.file, '\t');
        std::getline(columns, row.problem, '\t');
        std::getline(columns, row.expected.verdict, '\t');
        std::getline(columns, row.expected.line, '\t');
        rows.push_back(row);
    }
    return rows;
}

/// Where the manifest leaves a choice and the reader takes the other one.
const std::map<std::string, Verdict> argued{
    // the count of tilt pairs stands on line 7 and is what cannot be; the end of the file is
    // fine
    {"ies-tilt-include-missing-block.ies", {"error", "7"}},
    // complete EULUMDAT content is read as such whatever the file is called
    {"ies-is-ldt.ies", {"warning", "1"}}};

bool stands_on(const Message& message, const Row& row, const std::string& line) {
    return message.where == row.file + ':' + line;
}

TEST(BrokenFiles, GetTheVerdictAndTheLineOfTheManifest) {
    ISOLUX_NEEDS_CORPUS();
    const auto rows = read_manifest();
    ASSERT_GE(rows.size(), 50U);
    for (const Row& row : rows) {
        SCOPED_TRACE(row.file + ": " + row.problem);
        const auto other = argued.find(row.file);
        const Verdict expected = other == argued.end() ? row.expected : other->second;
        try {
            const auto parsed = corpus::read("broken", row.file);
            EXPECT_EQ(expected.verdict, parsed.notices.empty() ? "ok" : "warning")
                << (parsed.notices.empty() ? "" : to_string(parsed.notices.front()));
            if (expected.verdict == "warning") {
                EXPECT_TRUE(std::ranges::any_of(parsed.notices, [&](const Message& m) {
                    return stands_on(m, row, expected.line);
                })) << to_string(parsed.notices.front());
            }
        } catch (const InputError& error) {
            EXPECT_EQ(expected.verdict, "error") << error.what();
            EXPECT_TRUE(stands_on(error.messages().front(), row, expected.line))
                << error.what();
        }
    }
}

} // namespace
} // namespace isolux
