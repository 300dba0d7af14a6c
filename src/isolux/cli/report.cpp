#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/cli/console.h"
#include "isolux/cli/results_path.h"
#include "isolux/cli/verbs.h"
#include "isolux/io/results_json.h"
#include "isolux/report/report_files.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct ReportOptions {
    std::string folder;
    std::string output;
};

ExitCode write(const ReportOptions& o) {
    const fs::path results = find_results_file(o.folder);
    const fs::path folder = results.parent_path();
    const ResultsDocument document = read_results_json(results);
    if (o.output.empty()) {
        report::write_reports(folder, document);
        print(fmt::format(
            "{}\n{}\n", (folder / "report.html").string(), (folder / "report.pdf").string()));
    } else {
        report::write_report(o.output, document, folder);
        print(fmt::format("{}\n", o.output));
    }
    return ExitCode::success;
}

} // namespace

Action add_report(CLI::App& verb) {
    verb.description("Write the report of a calculation from its results folder");
    verb.footer(R"(
Everything comes from results.json in DIR (and DIR/views, and DIR/selftest.json of
`isolux selftest -o DIR`), so that a report can be written long after the project is gone. The
HTML file needs nothing beside it and no network.

Examples:
  isolux report results/open-office               report.html and report.pdf in the folder
  isolux report results/open-office -o office.pdf
  isolux report results/open-office -o office.html)");
    const auto options = std::make_shared<ReportOptions>();
    verb.add_option("DIR", options->folder, "Results folder of `isolux run`")->required();
    verb.add_option("-o,--output",
                    options->output,
                    "Report: .html or .pdf (default both, in the results folder)")
        ->type_name("FILE");
    return [options] { return write(*options); };
}

} // namespace isolux
