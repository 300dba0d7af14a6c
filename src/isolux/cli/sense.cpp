#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "isolux/calc/calculate.h"
#include "isolux/cli/calculation_options.h"
#include "isolux/cli/console.h"
#include "isolux/cli/dark_points.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/receiver_lines.h"
#include "isolux/cli/verbs.h"

namespace isolux {

namespace {

constexpr std::size_t default_batch = 4096; ///< lines answered together

struct SenseOptions {
    CalculationOptions calculation;
    std::string batch;
    bool is_json = false;
    bool is_quiet = false;
};

std::string to_plain_line(const PointResult& p) {
    return fmt::format("{:.6g}\t{:.3g}\n", p.total.mean, p.total.standard_error);
}

std::string to_json_line(const Receiver& receiver, const PointResult& p, double confidence) {
    const Interval interval = confidence_interval(p.total, confidence);
    const nlohmann::ordered_json line{
        {"position", {receiver.point.x, receiver.point.y, receiver.point.z}},
        {"normal", {receiver.axis.x(), receiver.axis.y(), receiver.axis.z()}},
        {"value", p.total.mean},
        {"standard_error", p.total.standard_error},
        {"lower", interval.lower},
        {"upper", interval.upper},
        {"direct", p.direct.mean},
        {"indirect", p.indirect.mean}};
    return line.dump() + "\n";
}

std::size_t batch_size(const SenseOptions& options) {
    if (!options.batch.empty())
        return parse_count("--batch", options.batch, 1, 1'000'000);
    // Whoever types lines wants an answer to each. Into a pipe the size is fixed, so that
    // answers do not depend on how fast the lines arrive.
    return isatty(STDIN_FILENO) == 1 ? 1 : default_batch;
}

ExitCode sense(const SenseOptions& options) {
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
    DarkPoints dark(space, "points");
    ReceiverLines lines(std::cin, "stdin");
    CalculationSurface surface;
    surface.name = "stdin";
    while (!(surface.receivers = lines.read(batch)).empty()) {
        for (const Receiver& r : surface.receivers)
            dark.count(r.point);
        const Results results = calculate(scene, {&surface, 1}, settings);
        std::string text;
        for (std::size_t i = 0; i < surface.receivers.size(); ++i) {
            const PointResult& p = results.surfaces[0].points[i];
            text += options.is_json ? to_json_line(surface.receivers[i], p, results.confidence)
                                    : to_plain_line(p);
        }
        print(text);
        flush_output();
    }
    if (!options.is_quiet)
        dark.report();
    return ExitCode::success;
}

} // namespace

Action add_sense(CLI::App& verb) {
    verb.description("Answer points from standard input with illuminances");
    verb.footer(fmt::format(R"(
Reads lines `x y z nx ny nz` (metres; position and normal) and writes for each, in the same
order, `E standard_error` in lx, separated by a tab. Blanks, tabs or commas separate numbers;
empty lines and what follows # are skipped. The project's own surfaces are not calculated.

Lines are answered in batches of {}, so that input of any length fits into memory; a program
that waits for every answer sets --batch 1. On a terminal every line is answered at once.

Examples:
  echo "2 3 0.75 0 0 1" | isolux sense projects/open-office
  isolux sense office.json < points.txt > illuminance.tsv
  isolux sense office.json --json --tolerance 5% < points.txt

Exit status: 0 done; 1 failure; 2 the project, the options or a line of input is wrong.)",
                            default_batch));
    const auto options = std::make_shared<SenseOptions>();
    add_calculation_options(verb, options->calculation);
    verb.add_flag(
        "--json", options->is_json, "One JSON object a line, with interval and parts");
    verb.add_option("--batch", options->batch, "Lines answered together")->type_name("N");
    verb.add_flag("--quiet", options->is_quiet, "No notices");
    return [options] { return sense(*options); };
}

} // namespace isolux
