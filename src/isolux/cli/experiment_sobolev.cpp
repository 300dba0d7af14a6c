#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/base/error.h"
#include "isolux/base/parallel.h"
#include "isolux/calc/sobolev_experiment.h"
#include "isolux/cli/console.h"
#include "isolux/cli/experiment_sobolev_report.h"
#include "isolux/cli/experiments.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/terminal.h"
#include "isolux/io/safe_file.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

/// Beyond this many separations the rim of the traced plates would be seen.
constexpr double farthest = 10.0;

struct SobolevOptions {
    std::string rho1 = "0.5";
    std::string rho2 = "0.5";
    std::string h1 = "0.5";
    std::string separation = "1";
    std::string flux = "12566.37";
    std::string radii = "0,0.25,0.5,1,2,3,5";
    std::string ring_width = "0.1";
    std::string work = "1";
    std::string seed = "1";
    std::string threads;
    std::string folder;
    bool is_json = false;
    bool is_quiet = false;
};

double read_number(const std::string& option, std::string_view text) {
    const double value = parse_finite_number(text);
    if (std::isnan(value))
        throw InputError(option, fmt::format("'{}' is not a number", text));
    return value;
}

double read_between(const std::string& option,
                    const std::string& text,
                    double low,
                    double high,
                    const char* why) {
    const double value = read_number(option, text);
    if (!(value > low && value < high))
        throw InputError(
            option, fmt::format("{} is not between {:g} and {:g} ({})", text, low, high, why));
    return value;
}

SobolevTask read_task(const SobolevOptions& o) {
    SobolevTask task;
    SobolevProblem& p = task.problem;
    const char* const absorbed = "light that nothing or everything absorbs has no walk";
    p.reflectance_1 = read_between("--rho1", o.rho1, 0.0, 1.0, absorbed);
    p.reflectance_2 = read_between("--rho2", o.rho2, 0.0, 1.0, absorbed);
    p.separation = Metre(read_between("--separation", o.separation, 1e-3, 1e3, "metres"));
    p.source_height =
        Metre(read_between("--h1", o.h1, 0.0, in_metre(p.separation), "metres, inside"));
    p.flux = Lumen(read_between("--flux", o.flux, 0.0, 1e12, "lumens"));
    task.radii.clear();
    const std::string_view list = o.radii;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        const double r = read_number("--r", list.substr(begin, end - begin));
        if (r < 0.0 || r > farthest * in_metre(p.separation))
            throw InputError("--r",
                             fmt::format("{:g} m is not between 0 and {:g} separations (the "
                                         "traced planes are finite)",
                                         r,
                                         farthest));
        task.radii.push_back(r);
        begin = end + 1;
    }
    task.ring_width =
        read_between("--ring-width", o.ring_width, 0.0, 2.0 * in_metre(p.separation), "metres");
    task.work = read_between("--work", o.work, 1e-4, 1e4, "a multiple of the usual work");
    task.seed = parse_count("--seed", o.seed, 0, UINT64_MAX);
    return task;
}

ExitCode run_experiment(const SobolevOptions& o) {
    const SobolevTask task = read_task(o);
    const ThreadLimit limit(o.threads.empty() ? 0
                                              : parse_count("--threads", o.threads, 1, 1024));
    if (!o.folder.empty())
        make_folder(o.folder); // a folder that cannot be made is better known now
    SobolevComparison comparison;
    {
        ProgressLine line(!o.is_quiet && is_progress_wanted());
        comparison = compare_sobolev(task, [&](const std::string& name, double share) {
            Progress progress;
            progress.stage = name.c_str();
            progress.fraction = share;
            progress.seconds_left = -1.0;
            line.show(progress);
        });
    }
    const std::string json = to_json(comparison);
    if (!o.folder.empty()) {
        const fs::path folder(o.folder);
        write_file_safely(folder / "sobolev.json", json);
        write_file_safely(folder / "sobolev.csv", to_csv(comparison));
        write_drawing(folder / "sobolev", draw(comparison));
    }
    print(o.is_json ? json : to_text(comparison));
    if (!o.folder.empty() && !o.is_json)
        print(fmt::format("\nfiles: {}/sobolev.json, .csv, .svg, .png\n", o.folder));
    return ExitCode::success;
}

} // namespace

Action add_sobolev_experiment(CLI::App& experiment) {
    experiment.description(
        "Every method on an isotropic source between two infinite planes, beside the series");
    experiment.footer(R"(
The closed series, direct simulation (flux counted on rings), local estimation, LE-MIS and path
tracing: values with errors, and the CPU seconds each needs for the same error. The values
depend on the options alone, the seconds on the machine.

Examples:
  isolux experiment sobolev
  isolux experiment sobolev -o results/sobolev          table and plots as files
  isolux experiment sobolev --rho1 0.7 --rho2 0.7 --h1 0.3 --ring-width 0.05
  isolux experiment sobolev --work 0.1 --json           a tenth of the work)");
    const auto o = std::make_shared<SobolevOptions>();
    experiment.add_option("--rho1", o->rho1, "Reflectance of plane 1")->capture_default_str();
    experiment.add_option("--rho2", o->rho2, "Reflectance of plane 2")->capture_default_str();
    experiment.add_option("--h1", o->h1, "Distance of the source from plane 1, m")
        ->capture_default_str();
    experiment.add_option("--separation", o->separation, "Distance of the planes, m")
        ->capture_default_str();
    experiment.add_option("--flux", o->flux, "Flux of the source, lm")->capture_default_str();
    experiment.add_option("--r", o->radii, "Distances from the foot of the source, m")
        ->capture_default_str();
    experiment.add_option("--ring-width", o->ring_width, "Width of the counting rings, m")
        ->capture_default_str();
    experiment.add_option("--work", o->work, "Multiplies the work of every method")
        ->capture_default_str();
    experiment.add_option("--seed", o->seed, "Seed of the random numbers")
        ->capture_default_str();
    experiment.add_option("--threads", o->threads, "Threads to use (default: all)")
        ->type_name("N");
    experiment
        .add_option("-o,--output",
                    o->folder,
                    "Folder for sobolev.json, .csv, .svg and .png (default: none)")
        ->type_name("DIR");
    experiment.add_flag("--json", o->is_json, "Print JSON with all digits");
    experiment.add_flag("--quiet", o->is_quiet, "No progress line");
    return [o] { return run_experiment(*o); };
}

} // namespace isolux
