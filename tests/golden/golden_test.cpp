#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/calculate.h"
#include "isolux/io/project_json.h"
#include "isolux/io/safe_file.h"

#include "golden/expected_table.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

/// Every shipped project is also a test: projects/<name>/expected.csv holds the summary of each
/// surface with its standard error, and a quick calculation with another seed must agree with
/// it within the errors of both.
///
///     golden_test                                       compares
///     golden_test --update [--gtest_filter=*.gallery]   writes expected.csv anew
///
/// Expected values come from the project's own tolerance, the comparison from a coarser one, so
/// that a better sampler breaks nothing and a bias does.
namespace isolux {
namespace {

namespace fs = std::filesystem;
using namespace test; // tables and their comparison

constexpr std::uint64_t expected_seed = 20260101;
constexpr std::uint64_t compared_seed = 7;
constexpr double compared_tolerance = 0.05;

bool is_update = false;

Results calculate_project(const fs::path& folder, std::uint64_t seed, double coarsest) {
    Project project = read_project(folder / "project.json");
    Settings settings = project.settings;
    settings.seed = seed;
    settings.tolerance = std::max(settings.tolerance, coarsest);
    settings.time_limit.reset();
    const Scene scene = build_scene(std::move(project.scene));
    return calculate(scene, project.surfaces, settings);
}

/// What is emitted is absorbed or escapes.
void expect_flux_balance(const FluxBalance& flux) {
    const double error = std::hypot(flux.absorbed.standard_error, flux.escaped.standard_error);
    EXPECT_LE(std::abs(flux.absorbed.mean + flux.escaped.mean - flux.emitted.mean),
              error_limit(flux.absorbed.samples) * error + 1e-9 * flux.emitted.mean)
        << flux.emitted.mean << " lm emitted, " << flux.absorbed.mean << " +- "
        << flux.absorbed.standard_error << " absorbed, " << flux.escaped.mean << " +- "
        << flux.escaped.standard_error << " escaped";
}

class GoldenProject : public testing::Test {
public:
    explicit GoldenProject(fs::path folder) : folder_(std::move(folder)) {}

    void TestBody() override {
        const fs::path file = folder_ / "expected.csv";
        if (is_update) {
            const Results results = calculate_project(folder_, expected_seed, 0.0);
            ASSERT_TRUE(results.converged);
            write_file_safely(file, to_summary_csv(results));
            std::printf("%s written\n", file.c_str());
            return;
        }
        ASSERT_TRUE(fs::exists(file))
            << folder_.filename() << " lacks its expected.csv: run this program with --update";
        compare(read_table(read_bytes(file), file.string()));
    }

private:
    void compare(const Table& expected) const {
        const Results results = calculate_project(folder_, compared_seed, compared_tolerance);
        EXPECT_TRUE(results.converged);
        expect_flux_balance(results.flux_balance);
        const Table found = read_table(to_summary_csv(results), "this run");
        for (const std::string& text : disagreements(found, expected))
            ADD_FAILURE() << text;
    }

    fs::path folder_;
};

void register_projects() {
    std::vector<fs::path> folders;
    std::error_code missing;
    const fs::path projects = isolux::test::source_dir() / "projects";
    for (const auto& entry : fs::directory_iterator(projects, missing))
        if (fs::exists(entry.path() / "project.json"))
            folders.push_back(entry.path());
    std::ranges::sort(folders);
    for (const fs::path& folder : folders) {
        // In a test filter "-" would begin what to leave out.
        std::string name = folder.filename().string();
        std::ranges::replace(name, '-', '_');
        testing::RegisterTest(
            "Golden",
            name.c_str(),
            nullptr,
            nullptr,
            __FILE__,
            __LINE__,
            [folder]() -> testing::Test* { return new GoldenProject(folder); });
    }
}

} // namespace
} // namespace isolux

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    for (int i = 1; i < argc; ++i)
        isolux::is_update = isolux::is_update || std::string_view(argv[i]) == "--update";
    isolux::register_projects();
    return RUN_ALL_TESTS();
}
