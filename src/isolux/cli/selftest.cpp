#include "isolux/calc/selftest.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/base/parallel.h"
#include "isolux/cli/console.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/terminal.h"
#include "isolux/cli/text_table.h"
#include "isolux/cli/verbs.h"
#include "isolux/io/safe_file.h"

namespace isolux {

namespace {

struct SelftestOptions {
    bool is_json = false;
    bool is_quiet = false;
    std::string seed = "1";
    std::string threads;
    std::string only;
    std::string folder;
};

/// The cases whose names contain `only`, upper and lower case alike.
std::vector<SelftestCase> choose_cases(const std::string& only) {
    const auto lower = [](std::string text) {
        for (char& c : text)
            c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        return text;
    };
    std::vector<SelftestCase> cases;
    std::string known;
    for (SelftestCase& selftest : make_selftest_cases()) {
        known += (known.empty() ? "" : "; ") + selftest.name;
        if (lower(selftest.name).find(lower(only)) != std::string::npos)
            cases.push_back(std::move(selftest));
    }
    if (cases.empty())
        throw InputError(
            "--only", fmt::format("no case is called '{}'", only), "Cases: " + known);
    return cases;
}

/// Runs all cases, one after the other; progress counts cases.
std::vector<SelftestRow>
run_cases(const std::vector<SelftestCase>& cases, std::uint64_t seed, ProgressLine& line) {
    std::size_t rows_in_all = 0;
    for (const SelftestCase& selftest : cases)
        rows_in_all += selftest.answers.size();
    std::vector<SelftestRow> rows;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Control control;
        control.progress = [&](const Progress& inside) {
            Progress overall = inside;
            const double share = static_cast<double>(i) + inside.fraction;
            overall.fraction = share / static_cast<double>(cases.size());
            overall.seconds_left = -1.0;
            overall.stage = cases[i].name.c_str();
            line.show(overall);
        };
        // Every case has numbers of its own: shared ones would make them fail together.
        const Results results = calculate(cases[i], seed + i, control);
        for (const KnownAnswer& answer : cases[i].answers)
            rows.push_back(judge(cases[i], answer, answer.computed(results), rows_in_all));
    }
    return rows;
}

bool is_statistical(const SelftestRow& row) noexcept { return row.z_limit > 0.0; }

std::string to_table(const std::vector<SelftestRow>& rows) {
    TextTable table({{"case", Align::left},
                     {"quantity", Align::left},
                     {"computed", Align::right},
                     {"std. error", Align::right},
                     {"reference", Align::right},
                     {"unit", Align::left},
                     {"z", Align::right},
                     {"pass", Align::left}});
    const std::string* last = nullptr;
    for (const SelftestRow& row : rows) {
        table.add_row(
            {last != nullptr && *last == row.name ? "" : row.name,
             row.quantity,
             fmt::format("{:.6g}", row.computed.mean),
             is_statistical(row) ? fmt::format("{:.2g}", row.computed.standard_error) : "exact",
             fmt::format("{:.6g}", row.reference),
             row.unit,
             is_statistical(row) ? fmt::format("{:.2f}", row.z) : "",
             row.passed ? "yes" : "NO"});
        last = &row.name;
    }
    return table.text();
}

std::string summary_of(const std::vector<SelftestRow>& rows, double seconds) {
    std::size_t failed = 0;
    double widest = 0.0;
    for (const SelftestRow& row : rows) {
        failed += row.passed ? 0U : 1U;
        widest = std::max(widest, row.z_limit);
    }
    const SelftestCriteria criteria;
    return fmt::format(
        "\nA row passes if |z| is below {:.1f} and its standard error below {:g} % of the "
        "reference,\nor, where there is no chance involved, if it agrees to {:g}. A sound "
        "program fails by chance in one run of {:.0f}.\n{} of {} rows passed in {}.\n",
        widest,
        100.0 * criteria.largest_error,
        criteria.deterministic_tolerance,
        1.0 / criteria.false_alarm,
        rows.size() - failed,
        rows.size(),
        format_seconds(seconds));
}

std::string to_json(const std::vector<SelftestRow>& rows, std::uint64_t seed, bool passed) {
    nlohmann::ordered_json document{
        {"isolux_selftest", 1}, {"version", ISOLUX_VERSION}, {"seed", seed}};
    document["passed"] = passed;
    document["rows"] = nlohmann::ordered_json::array();
    for (const SelftestRow& row : rows) {
        nlohmann::ordered_json j{{"case", row.name},
                                 {"quantity", row.quantity},
                                 {"unit", row.unit},
                                 {"computed", row.computed.mean},
                                 {"standard_error", row.computed.standard_error},
                                 {"reference", row.reference}};
        j["z"] = is_statistical(row) ? nlohmann::ordered_json(row.z) : nullptr;
        j["z_limit"] = is_statistical(row) ? nlohmann::ordered_json(row.z_limit) : nullptr;
        j["pass"] = row.passed;
        document["rows"].push_back(std::move(j));
    }
    return document.dump(2) + "\n";
}

ExitCode run_selftest(const SelftestOptions& options) {
    if (!options.folder.empty() && !options.only.empty())
        throw InputError(
            "--output", "some cases alone are no self-test to quote", "Leave --only out.");
    const std::uint64_t seed = parse_count("--seed", options.seed, 0, UINT64_MAX);
    const ThreadLimit limit(
        options.threads.empty() ? 0 : parse_count("--threads", options.threads, 1, 1024));
    if (!options.folder.empty())
        make_folder(options.folder); // a folder that cannot be made is better known now
    const auto start = std::chrono::steady_clock::now();
    std::vector<SelftestRow> rows;
    {
        ProgressLine line(!options.is_quiet && is_progress_wanted());
        rows = run_cases(choose_cases(options.only), seed, line);
    }
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const bool passed = std::all_of(
        rows.begin(), rows.end(), [](const SelftestRow& row) { return row.passed; });
    const std::string json = to_json(rows, seed, passed);
    if (!options.folder.empty())
        write_file_safely(std::filesystem::path(options.folder) / "selftest.json", json);
    print(options.is_json ? json : to_table(rows) + summary_of(rows, seconds));
    return passed ? ExitCode::success : ExitCode::failure;
}

} // namespace

Action add_selftest(CLI::App& verb) {
    verb.description("Compare this program with closed-form answers, on this machine");
    verb.footer(R"(
Sobolev's problem, integrating spheres, furnaces, the cube of CIE 171:2006 test 5.8, inverse
square and cosine law, Lambertian shapes, flux balance. Takes less than a minute.

Examples:
  isolux selftest                 a table of all rows
  isolux selftest --json          the same for programs
  isolux selftest --seed 2        with other random numbers
  isolux selftest --only sobolev  one kind of case
  isolux selftest -o results/open-office && isolux report results/open-office
                                  the outcome in the report's page on the method

Exit status: 0 every row passed; 1 some row failed; 2 wrong options.)");
    const auto options = std::make_shared<SelftestOptions>();
    verb.add_flag("--json", options->is_json, "Print JSON");
    verb.add_option("--seed", options->seed, "Seed of the random numbers (default 1)")
        ->type_name("N");
    verb.add_option("--threads", options->threads, "Threads to use (default: all)")
        ->type_name("N");
    verb.add_option("--only", options->only, "Only cases whose name contains TEXT")
        ->type_name("TEXT");
    verb.add_option("-o,--output",
                    options->folder,
                    "Folder for selftest.json; a report of that folder quotes it")
        ->type_name("DIR");
    verb.add_flag("--quiet", options->is_quiet, "No progress line");
    return [options] { return run_selftest(*options); };
}

} // namespace isolux
