#include "isolux/calc/luminance.h"

#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "isolux/cli/calculation_options.h"
#include "isolux/cli/console.h"
#include "isolux/cli/dark_points.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/receiver_lines.h"
#include "isolux/cli/verbs.h"

namespace isolux {

namespace {

constexpr std::size_t default_batch = 4096; ///< lines answered together

struct LuminanceOptions {
    CalculationOptions calculation;
    std::string batch;
    bool is_json = false;
    bool is_quiet = false;
};

std::string to_plain_line(const LuminanceResult& r) {
    return fmt::format("{:.6g}\t{:.3g}\n", r.total.mean, r.total.standard_error);
}

std::string to_json_line(const SightLine& line, const LuminanceResult& r, double confidence) {
    const Interval interval = confidence_interval(r.total, confidence);
    const nlohmann::ordered_json object{
        {"eye", {line.eye.x, line.eye.y, line.eye.z}},
        {"direction", {line.direction.x(), line.direction.y(), line.direction.z()}},
        {"value", r.total.mean},
        {"standard_error", r.total.standard_error},
        {"lower", interval.lower},
        {"upper", interval.upper},
        {"luminaires", r.luminaires.mean},
        {"direct", r.direct.mean},
        {"indirect", r.indirect.mean}};
    return object.dump() + "\n";
}

std::size_t batch_size(const LuminanceOptions& options) {
    if (!options.batch.empty())
        return parse_count("--batch", options.batch, 1, 1'000'000);
    // As in sense: whoever types lines wants an answer to each.
    return isatty(STDIN_FILENO) == 1 ? 1 : default_batch;
}

ExitCode luminance(const LuminanceOptions& options) {
    const auto limit = limit_threads(options.calculation);
    const std::size_t batch = batch_size(options);
    (void)apply(options.calculation, {}); // complain about options first
    Project project = load_project(options.calculation.project);
    Settings settings = apply(options.calculation, project.settings);
    settings.time_limit.reset(); // a limit for the whole project says nothing about a batch
    if (!options.is_quiet) {
        for (const Message& notice : project.notices)
            report_notice(notice);
    }
    const SceneSpace space(project.scene);
    const Scene scene = build_scene(std::move(project.scene));
    DarkPoints dark(space, "eyes");
    ReceiverLines reader(std::cin, "stdin", LineForm::sight_line);
    std::vector<SightLine> lines;
    for (;;) {
        lines.clear();
        for (const Receiver& r : reader.read(batch)) {
            lines.push_back({r.point, r.axis});
            dark.count(r.point, Vector3(r.axis));
        }
        if (lines.empty())
            break;
        const LuminanceResults results = estimate_luminances(scene, lines, settings);
        std::string text;
        for (std::size_t i = 0; i < lines.size(); ++i)
            text += options.is_json
                        ? to_json_line(lines[i], results.rays[i], results.confidence)
                        : to_plain_line(results.rays[i]);
        print(text);
        flush_output();
    }
    if (!options.is_quiet)
        dark.report();
    return ExitCode::success;
}

} // namespace

Action add_luminance(CLI::App& verb) {
    verb.description("Answer sight lines from standard input with luminances");
    verb.footer(fmt::format(R"(
Reads lines `x y z dx dy dz` (metres; the eye and the direction it looks in) and writes for
each, in the same order, `L standard_error` in cd/m2, separated by a tab: the luminance that
arrives at the eye from that direction, also through panes and in mirrors. Blanks, tabs or
commas separate numbers; empty lines and what follows # are skipped.

A luminaire looked at has the luminance of its opening; one that is a point in its file has no
opening and is not seen. A line that meets nothing is answered with 0.

Lines are answered in batches of {}; a program that waits for every answer sets --batch 1.

Examples:
  echo "1 1 1.2 1 0 -0.2" | isolux luminance projects/open-office
  isolux luminance office.json < sight-lines.txt > luminance.tsv
  isolux luminance office.json --json --tolerance 5% < sight-lines.txt

Exit status: 0 done; 1 failure; 2 the project, the options or a line of input is wrong.)",
                            default_batch));
    const auto options = std::make_shared<LuminanceOptions>();
    add_calculation_options(verb, options->calculation);
    verb.add_flag(
        "--json", options->is_json, "One JSON object a line, with interval and parts");
    verb.add_option("--batch", options->batch, "Lines answered together")->type_name("N");
    verb.add_flag("--quiet", options->is_quiet, "No notices");
    return [options] { return luminance(*options); };
}

} // namespace isolux
