#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/cli/console.h"
#include "isolux/cli/results_path.h"
#include "isolux/cli/run_report.h"
#include "isolux/cli/text_table.h"
#include "isolux/cli/verbs.h"
#include "isolux/io/results_diff.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

ResultsDocument read_folder(const std::string& argument) {
    return read_results_json(find_results_file(argument));
}

std::string to_text(const ResultsDiff& diff, double confidence) {
    std::string text;
    for (const std::string& line : diff.inputs)
        text += "input: " + line + "\n";
    for (const std::string& line : diff.missing)
        text += line + "\n";
    if (!diff.values.empty()) {
        TextTable table({{"where", Align::left},
                         {"what", Align::left},
                         {"first", Align::right},
                         {"second", Align::right},
                         {"change", Align::right},
                         {"", Align::left}});
        for (const ValueChange& v : diff.values)
            table.add_row({v.where,
                           v.what,
                           format_estimate(v.before, confidence),
                           format_estimate(v.after, confidence),
                           v.before.mean != 0.0 ? fmt::format(
                               "{:+.2f} %", 100.0 * (v.after.mean / v.before.mean - 1.0))
                                                : fmt::format("{:+.4g}", v.after.mean),
                           v.unit == "1" ? "" : v.unit});
        text += table.text();
    }
    if (!diff.verdicts.empty()) {
        TextTable table({{"verdict", Align::left},
                         {"where", Align::left},
                         {"first", Align::left},
                         {"second", Align::left}});
        for (const VerdictChange& v : diff.verdicts)
            table.add_row({v.what, v.where, v.before, v.after});
        text += table.text();
    }
    return text
           + fmt::format("{} numbers compared, {}\n",
                         diff.compared,
                         diff.has_changes() ? "some changed beyond their errors"
                                            : "none changed beyond its error");
}

ExitCode diff_results(const std::string& first, const std::string& second, bool is_strict) {
    const ResultsDocument before = read_folder(first);
    const ResultsDocument after = read_folder(second);
    const ResultsDiff diff = compare_results(before, after);
    print(to_text(diff, before.results.confidence));
    const bool differs = diff.has_changes() || (is_strict && !diff.inputs.empty());
    return differs ? ExitCode::failure : ExitCode::success;
}

} // namespace

Action add_diff(CLI::App& verb) {
    verb.description("Say what changed between two results: inputs, values, verdicts");
    verb.footer(R"(
Values count as changed where they differ by more than both errors allow, at 95 % for all of them
together: two runs with different seeds are equal. Verdicts count as changed when their word does.

Examples:
  isolux diff results/office-a results/office-b
  isolux diff old/results.json new/results.json && echo unchanged

Exit status: 0 nothing changed but, perhaps, inputs; 1 something changed; 2 a file is wrong.)");

    struct Options {
        std::string first;
        std::string second;
        bool is_strict = false;
    };

    const auto options = std::make_shared<Options>();
    verb.add_option("DIR_A", options->first, "A results folder, or its results.json")
        ->required()
        ->type_name("");
    verb.add_option("DIR_B", options->second, "Another one")->required()->type_name("");
    verb.add_flag("--strict", options->is_strict, "Changed inputs alone give exit status 1");
    return
        [options] { return diff_results(options->first, options->second, options->is_strict); };
}

} // namespace isolux
