#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/base/parallel.h"
#include "isolux/calc/denoise_experiment.h"
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

struct DenoiseOptions {
    std::string size = "64";
    std::string samples = "4";
    std::string steps = "14";
    std::string seeds = "10";
    std::string reference = "100";
    std::string seed = "1";
    std::string threads;
    std::string folder;
    bool is_json = false;
    bool is_quiet = false;
};

ExitCode run_denoise_experiment(const DenoiseOptions& o) {
    DenoiseTask task;
    const std::size_t side = parse_count("--size", o.size, 16, 2048);
    task.step_samples = parse_count("--spp", o.samples, 2, 1024);
    task.steps = parse_count("--steps", o.steps, 2, 1000);
    task.seeds = parse_count("--seeds", o.seeds, 1, 1000);
    task.reference_factor = parse_count("--reference", o.reference, 1, 10000);
    task.seed = parse_count("--seed", o.seed, 0, UINT32_MAX);
    const ThreadLimit limit(o.threads.empty() ? 0
                                              : parse_count("--threads", o.threads, 1, 1024));
    if (!o.folder.empty())
        make_folder(o.folder); // a folder that cannot be made is better known now
    Project project = make_experiment_project("cornell box", side);
    const View view = project.views.front();
    const Scene scene = build_scene(std::move(project.scene));
    DenoiseStudy study;
    {
        ProgressLine line(!o.is_quiet && is_progress_wanted());
        study = study_denoising(scene, view, task, [&](double share) {
            Progress progress;
            progress.stage = "rendering";
            progress.fraction = share;
            progress.seconds_left = -1.0;
            line.show(progress);
        });
    }
    const std::string json = to_json(study);
    if (!o.folder.empty()) {
        const fs::path folder(o.folder);
        write_file_safely(folder / "denoise.json", json);
        write_file_safely(folder / "denoise.csv", to_csv(study));
        write_drawing(folder / "denoise", draw(study));
    }
    print(o.is_json ? json : to_text(study));
    if (!o.folder.empty() && !o.is_json)
        print(fmt::format("\nfiles: {}/denoise.json, .csv, .svg, .png\n", o.folder));
    return ExitCode::success;
}

} // namespace

Action add_denoise_experiment(CLI::App& experiment) {
    experiment.description("Noisy and denoised pictures of the Cornell box as samples grow");
    experiment.footer(R"(
An earlier study compared noisy pictures with their own denoised versions, and denoised ones with
each other. Here are these two numbers, and beside them what they do not tell: how far noisy and
denoised pictures are from a converged reference of other seeds. Intel Open Image Denoise takes
part where the machine has it. METHODS 12.7.

Examples:
  isolux experiment denoise
  isolux experiment denoise --size 256 -o results/denoise
  isolux experiment denoise --steps 4 --seeds 3 --json)");
    const auto o = std::make_shared<DenoiseOptions>();
    experiment.add_option("--size", o->size, "Pixels a side")->capture_default_str();
    experiment.add_option("--spp", o->samples, "Rays a pixel that a step adds")
        ->capture_default_str();
    experiment.add_option("--steps", o->steps, "Steps")->capture_default_str();
    experiment.add_option("--seeds", o->seeds, "Repetitions, for the spread")
        ->capture_default_str();
    experiment
        .add_option("--reference", o->reference, "Rays of the reference, times the last step's")
        ->capture_default_str();
    experiment.add_option("--seed", o->seed, "The first seed")->capture_default_str();
    experiment.add_option("--threads", o->threads, "Threads to use (default: all)")
        ->type_name("N");
    experiment
        .add_option("-o,--output",
                    o->folder,
                    "Folder for denoise.json, .csv, .svg and .png (default: none)")
        ->type_name("DIR");
    experiment.add_flag("--json", o->is_json, "Print JSON with all digits");
    experiment.add_flag("--quiet", o->is_quiet, "No progress line");
    return [o] { return run_denoise_experiment(*o); };
}

} // namespace isolux
