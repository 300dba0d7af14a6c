#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/base/parallel.h"
#include "isolux/calc/filter_experiment.h"
#include "isolux/cli/console.h"
#include "isolux/cli/experiment_filter_report.h"
#include "isolux/cli/experiment_scenes.h"
#include "isolux/cli/experiments.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/terminal.h"
#include "isolux/io/safe_file.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct FilterOptions {
    std::string scene; ///< of make_experiment_project
    std::string verb;
    std::string size = "128";
    std::string samples = "16";
    std::string seeds = "3";
    std::string reference = "8";
    std::string seed = "1";
    std::string threads;
    std::string folder;
    bool is_json = false;
    bool is_quiet = false;
};

/// The window of SSIM and the filter's tests need some room.
constexpr std::uint64_t least_side = 16;
constexpr std::uint64_t most_side = 2048;

/// Beyond a tenth the reference's own noise decides, METHODS 12.5.
constexpr double most_noise = 0.1;

ExitCode run_filter_experiment(const FilterOptions& o) {
    FilterTask task;
    const std::size_t side = parse_count("--size", o.size, least_side, most_side);
    task.samples = parse_count("--spp", o.samples, 4, 4096);
    task.seeds = parse_count("--seeds", o.seeds, 1, 1000);
    task.reference_factor = parse_count("--reference", o.reference, 1, 10000);
    task.seed = parse_count("--seed", o.seed, 0, UINT32_MAX);
    task.direct_only = o.scene == "soft shadow";
    const ThreadLimit limit(o.threads.empty() ? 0
                                              : parse_count("--threads", o.threads, 1, 1024));
    if (!o.folder.empty())
        make_folder(o.folder); // a folder that cannot be made is better known now
    Project project = make_experiment_project(o.scene, side);
    const View view = project.views.front();
    const Scene scene = build_scene(std::move(project.scene));
    FilterComparison comparison;
    {
        ProgressLine line(!o.is_quiet && is_progress_wanted());
        comparison = compare_filter(scene, view, task, [&](double share) {
            Progress progress;
            progress.stage = "rendering";
            progress.fraction = share;
            progress.seconds_left = -1.0;
            line.show(progress);
        });
    }
    if (comparison.reference_noise > most_noise)
        throw InputError("--reference",
                         fmt::format("the reference's own noise may be {:.0f} % of the "
                                     "smallest error (more than a tenth says nothing)",
                                     100.0 * comparison.reference_noise),
                         fmt::format("--reference {}", 4 * task.reference_factor));
    const std::string json = to_json(comparison, o.verb);
    if (!o.folder.empty()) {
        const fs::path folder(o.folder);
        write_file_safely(folder / (o.verb + ".json"), json);
        write_file_safely(folder / (o.verb + ".csv"), to_csv(comparison));
        write_drawing(folder / o.verb, draw(comparison, o.verb));
    }
    print(o.is_json ? json : to_text(comparison, o.verb));
    if (!o.folder.empty() && !o.is_json)
        print(fmt::format("\nfiles: {}/{}.json, .csv, .svg, .png\n", o.folder, o.verb));
    return ExitCode::success;
}

Action add_filter_experiment(CLI::App& experiment,
                             const char* scene,
                             const char* verb,
                             const char* description) {
    experiment.description(description);
    experiment.footer(fmt::format(R"(
Renders the view filtered, and unfiltered at 1/2, 1, 2 and 4 times the samples, for several
seeds, and says how many times the samples and the CPU seconds the unfiltered picture needs for
the filtered one's relMSE. The reference's own noise is removed. The errors depend on the
options alone, the seconds on the machine.

Examples:
  isolux experiment {0}
  isolux experiment {0} --size 512 -o results/{0}
  isolux experiment {0} --size 32 --spp 8 --seeds 2 --json)",
                                  verb));
    const auto o = std::make_shared<FilterOptions>();
    o->scene = scene;
    o->verb = verb;
    experiment.add_option("--size", o->size, "Pixels a side")->capture_default_str();
    experiment.add_option("--spp", o->samples, "Rays a pixel of the filtered picture")
        ->capture_default_str();
    experiment.add_option("--seeds", o->seeds, "Repetitions, for the spread")
        ->capture_default_str();
    experiment
        .add_option("--reference", o->reference, "Rays of a half of the reference, times --spp")
        ->capture_default_str();
    experiment.add_option("--seed", o->seed, "The first seed")->capture_default_str();
    experiment.add_option("--threads", o->threads, "Threads to use (default: all)")
        ->type_name("N");
    experiment
        .add_option(
            "-o,--output",
            o->folder,
            fmt::format("Folder for {}.json, .csv, .svg and .png (default: none)", verb))
        ->type_name("DIR");
    experiment.add_flag("--json", o->is_json, "Print JSON with all digits");
    experiment.add_flag("--quiet", o->is_quiet, "No progress line");
    return [o] { return run_filter_experiment(*o); };
}

} // namespace

Action add_soft_shadow_experiment(CLI::App& experiment) {
    return add_filter_experiment(experiment,
                                 "soft shadow",
                                 "soft-shadow",
                                 "What the filter is worth for shadows of an area luminaire");
}

Action add_indirect_experiment(CLI::App& experiment) {
    return add_filter_experiment(experiment,
                                 "indirect",
                                 "indirect",
                                 "What the filter is worth in a box lit by its ceiling");
}

Action add_lens_experiment(CLI::App& experiment) {
    return add_filter_experiment(
        experiment, "lens", "lens", "What the filter is worth through a lens, out of focus");
}

} // namespace isolux
