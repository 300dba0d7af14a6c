#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/contributions_file.h"
#include "isolux/io/safe_file.h"
#include "isolux/io/text_file.h"

#include "support/sample_results.h"
#include "support/temporary_folder.h"

namespace isolux {
namespace {

/// Two sources over the points of the made-up results.
Results make_results_with_contributions() {
    Results r = test::make_results();
    Contributions c;
    c.sources = {{"row \"1\" 机", SourceKind::group, 1234.5, {0, 2}},
                 {"panel", SourceKind::type, 0.1, {1}}};
    c.replicates = 3;
    for (const SurfaceResult& s : r.surfaces)
        c.points += s.points.size();
    for (std::size_t i = 0; i < 2 * c.replicates * c.points; ++i) {
        c.direct.push_back(0.1F * static_cast<float>(i));
        c.indirect.push_back(-1.0F / (1.0F + static_cast<float>(i)));
    }
    r.contributions = c;
    return r;
}

std::string error_of(const std::filesystem::path& folder) {
    try {
        static_cast<void>(read_contributions(folder));
        return "";
    } catch (const InputError& error) {
        return to_string(error.messages().front());
    }
}

TEST(ContributionsFile, ReadsBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    const Results results = make_results_with_contributions();
    write_contributions(folder.path(), results);
    const ContributionsDocument d = read_contributions(folder.path());
    const Contributions& expected = *results.contributions;
    EXPECT_EQ(d.contributions.direct, expected.direct);
    EXPECT_EQ(d.contributions.indirect, expected.indirect);
    EXPECT_EQ(d.contributions.replicates, expected.replicates);
    EXPECT_EQ(d.contributions.points, expected.points);
    ASSERT_EQ(d.contributions.sources.size(), 2U);
    EXPECT_EQ(d.contributions.sources[0].name, expected.sources[0].name);
    EXPECT_EQ(d.contributions.sources[0].kind, SourceKind::group);
    EXPECT_EQ(d.contributions.sources[0].luminaires, expected.sources[0].luminaires);
    EXPECT_EQ(d.contributions.sources[1].kind, SourceKind::type);
    EXPECT_EQ(d.contributions.sources[1].flux, 0.1);
    ASSERT_EQ(d.surfaces.size(), results.surfaces.size());
    EXPECT_EQ(d.surfaces[1],
              (SurfacePoints{results.surfaces[1].surface.name,
                             results.surfaces[0].points.size(),
                             results.surfaces[1].points.size()}));
}

/// The format's own rules: magic, version, length of the description, numbers at a multiple of
/// 64, then little-endian floats.
TEST(ContributionsFile, IsANumPyArrayOfFloats) {
    const Results results = make_results_with_contributions();
    const std::string bytes = to_npy(*results.contributions);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t length =
        static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    EXPECT_EQ((10 + length) % 64, 0U);
    EXPECT_EQ(bytes[9 + length], '\n');
    const std::string description = bytes.substr(10, length);
    EXPECT_EQ(description.substr(0, description.find_last_not_of(" \n") + 1),
              "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 3, "
                  + std::to_string(results.contributions->points) + "), }");
    // 0.1F is 0x3dcccccd
    EXPECT_EQ(bytes.substr(10 + length + 4, 4), std::string("\xcd\xcc\xcc\x3d"));
    EXPECT_EQ(bytes.size(), 10 + length + 8 * results.contributions->direct.size());
}

TEST(ContributionsFile, SaysThatThereIsNone) {
    const test::TemporaryFolder folder;
    EXPECT_NE(error_of(folder.path()).find("contributions.json"), std::string::npos);
}

TEST(ContributionsFile, RefusesATableThatIsNotTheIndexs) {
    const test::TemporaryFolder folder;
    Results results = make_results_with_contributions();
    write_contributions(folder.path(), results);
    results.contributions->direct[0] = 7.0F;
    write_file_safely(folder.path() / contributions_table, to_npy(*results.contributions));
    EXPECT_EQ(
        error_of(folder.path()),
        (folder.path() / contributions_table).string()
            + ": this table does not belong to contributions.json (another calculation's, "
              "or changed since). Run the calculation again?");
}

TEST(ContributionsFile, RefusesAnIndexThatIsNone) {
    const test::TemporaryFolder folder;
    write_contributions(folder.path(), make_results_with_contributions());
    const auto index = folder.path() / contributions_index;
    const std::string good = read_file_bytes(index, FileLimits::results);
    for (const auto& [from, to] :
         {std::pair{"\"isolux_contributions\": 1", "\"isolux_contributions\": 2"},
          std::pair{"\"kind\": \"type\"", "\"kind\": \"kind\""},
          std::pair{"\"first_point\": 0", "\"first_point\": 1"},
          std::pair{"\"replicates\": 3", "\"replicates\": \"3\""},
          std::pair{"{", "["}}) {
        std::string bad = good;
        ASSERT_NE(bad.find(from), std::string::npos) << from;
        bad.replace(bad.find(from), std::string(from).size(), to);
        write_file_safely(index, bad);
        EXPECT_EQ(error_of(folder.path())
                      .find(index.string() + ": this is no index of contributions ("),
                  0U)
            << from;
    }
}

TEST(ContributionsFile, OfAnEarlierRunCanBeRemoved) {
    const test::TemporaryFolder folder;
    write_contributions(folder.path(), make_results_with_contributions());
    remove_contributions(folder.path());
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    remove_contributions(folder.path()); // nothing there is no error
}

} // namespace
} // namespace isolux
