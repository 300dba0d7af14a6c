#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/cli/calculation_options.h"
#include "isolux/cli/console.h"
#include "isolux/cli/interrupt.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/project_path.h"
#include "isolux/cli/suggest.h"
#include "isolux/cli/terminal.h"
#include "isolux/cli/verbs.h"
#include "isolux/cli/view_files.h"
#include "isolux/io/file_name.h"
#include "isolux/io/safe_file.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct RenderOptions {
    std::string project;
    std::string view;
    std::string folder;
    std::string spp;
    std::string tolerance;
    std::string time;
    std::string filter;
    std::string quantity;
    std::string seed;
    std::string threads;
    bool is_preview = false;
    bool is_quiet = false;
};

/// Rays a pixel where neither --spp, --tolerance nor --time says.
constexpr std::size_t usual_samples = 16;
constexpr std::size_t preview_samples = 2;
constexpr std::size_t most_samples = 65535;

std::size_t
choose(const char* option, const std::string& text, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i] == text)
            return i;
    const auto similar = find_similar(text, words);
    throw InputError(option,
                     fmt::format("'{}' is not known", text),
                     similar ? fmt::format("Did you mean {}?", *similar)
                             : fmt::format("Known are {}", fmt::join(words, ", ")));
}

RenderSettings to_settings(const RenderOptions& options) {
    RenderSettings s;
    s.is_preview = options.is_preview;
    s.samples = options.is_preview ? preview_samples : usual_samples;
    if (!options.tolerance.empty())
        s.tolerance = parse_tolerance("--tolerance", options.tolerance);
    if (!options.time.empty())
        s.time_limit = parse_duration("--time", options.time);
    if (s.tolerance || s.time_limit)
        s.samples = most_samples;
    if (!options.spp.empty())
        s.samples = parse_count("--spp", options.spp, 2, most_samples);
    if (!options.filter.empty())
        s.filter = static_cast<PictureFilter>(
            choose("--filter", options.filter, {"none", "axis-aligned", "oidn"}));
    if (!options.seed.empty())
        s.seed = parse_count("--seed", options.seed, 0, UINT64_MAX);
    return s;
}

std::vector<View> wanted_views(const RenderOptions& options, const Project& project) {
    if (project.views.empty())
        throw InputError(project.file.file + ":1",
                         "the project has no views (nothing says where to look from)",
                         R"(Add "views": [{"name": "door", "position": [x, y, z], "target": )"
                         R"([x, y, z]}]?)");
    if (options.view.empty())
        return project.views;
    std::vector<std::string> names;
    for (const View& v : project.views) {
        if (v.name == options.view)
            return {v};
        names.push_back(v.name);
    }
    const auto similar = find_similar(options.view, names);
    throw InputError("--view",
                     fmt::format("the project has no view \"{}\"", options.view),
                     similar ? fmt::format("Did you mean \"{}\"?", *similar)
                             : fmt::format("Its views are: {}", fmt::join(names, ", ")));
}

ExitCode render_project(const RenderOptions& options) {
    const InterruptGuard interrupt; // before the first worker thread starts
    CalculationOptions calculation;
    calculation.threads = options.threads;
    const auto limit = limit_threads(calculation);
    RenderSettings settings = to_settings(options); // complain before the long work
    const bool with_illuminance =
        !options.quantity.empty()
        && choose("--quantity", options.quantity, {"luminance", "illuminance"}) == 1;
    Project project = load_project(options.project);
    if (options.seed.empty())
        settings.seed = project.settings.seed;
    settings.direct_only = project.settings.direct_only;
    const std::vector<View> views = wanted_views(options, project);
    const fs::path folder = options.folder.empty()
                                ? fs::path("results") / file_stem(project.name)
                                : fs::path(options.folder);
    make_folder(folder);
    if (!options.is_quiet)
        for (const Message& notice : project.notices)
            report_notice(notice);
    const Scene scene = build_scene(std::move(project.scene));
    const std::vector<std::string> lines =
        render_views({scene,
                      views,
                      settings,
                      folder,
                      with_illuminance,
                      !options.is_quiet && is_progress_wanted()},
                     interrupt.token());
    if (!options.is_quiet) {
        for (const std::string& line : lines)
            print(line + "\n");
        print("pictures: " + folder.string() + "\n");
    }
    flush_output();
    return interrupt.is_interrupted() ? ExitCode::failure : ExitCode::success;
}

} // namespace

Action add_render(CLI::App& verb) {
    verb.description("Render a project's views: pictures in cd/m2");
    verb.footer(R"(
Writes for each view into DIR: VIEW.exr (OpenEXR: luminance and colour in cd/m2, raw and
filtered, with error, parts, geometry), VIEW.png (tone-mapped; the exposure is printed) and
VIEW-luminance.png (false colours with a legend). --quantity illuminance adds
VIEW-illuminance.png: illuminance on the visible surfaces with isolux lines.

Noise is filtered along the surfaces (--filter axis-aligned, the default), not at all (none) or
by Intel Open Image Denoise (oidn), where the machine has it. Values in the .exr's raw layers
are never filtered.

Ctrl-C keeps the picture so far; a second Ctrl-C ends at once.

Examples:
  isolux render projects/open-office --view corner
  isolux render projects/open-office --view corner --preview
  isolux render office.json --spp 64 --filter none -o pictures
  isolux render office.json --tolerance 5% --time 2min
  isolux render office.json --view desk --quantity illuminance

Exit status: 0 pictures written, also when time ended them; 1 stopped by Ctrl-C (pictures
written) or failed; 2 the project or the options are wrong; 130 second Ctrl-C.)");
    const auto options = std::make_shared<RenderOptions>();
    verb.add_option(
            "PROJECT", options->project, "A project file, or a folder with project.json")
        ->required()
        ->type_name("");
    verb.add_option("--view", options->view, "The view to render (default: all)")
        ->type_name("NAME");
    verb.add_option("-o,--output",
                    options->folder,
                    "Folder for the pictures (default results/ and the project's name)")
        ->type_name("DIR");
    verb.add_option("--spp", options->spp, "Rays a pixel (default 16; with --preview 2)")
        ->type_name("N");
    verb.add_option("--tolerance",
                    options->tolerance,
                    "Render until the raw picture's relative error is below, 5% or 0.05")
        ->type_name("SHARE");
    verb.add_option("--time", options->time, "Render for this time: 60s, 1.5min, 2h")
        ->type_name("TIME");
    verb.add_option("--filter", options->filter, "axis-aligned, none or oidn")
        ->type_name("NAME");
    verb.add_flag("--preview", options->is_preview, "A first look in a second or two");
    verb.add_option("--quantity",
                    options->quantity,
                    "What false colours show: luminance, or illuminance as well")
        ->type_name("NAME");
    verb.add_option("--seed", options->seed, "Seed of the random numbers")->type_name("N");
    verb.add_option("--threads", options->threads, "Threads to use (default: all)")
        ->type_name("N");
    verb.add_flag("--quiet", options->is_quiet, "No progress, no report");
    return [options] { return render_project(*options); };
}

} // namespace isolux
