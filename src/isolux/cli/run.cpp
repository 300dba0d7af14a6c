#include <chrono>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "isolux/calc/calculate_project.h"
#include "isolux/calc/long_side.h"
#include "isolux/cli/calculation_options.h"
#include "isolux/cli/console.h"
#include "isolux/cli/interrupt.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/run_report.h"
#include "isolux/cli/terminal.h"
#include "isolux/cli/verbs.h"
#include "isolux/cli/verdict_report.h"
#include "isolux/cli/view_files.h"
#include "isolux/io/file_name.h"
#include "isolux/io/results_json.h"
#include "isolux/io/safe_file.h"
#include "isolux/io/xlsx.h"
#include "isolux/report/report_files.h"
#include "isolux/viz/map.h"
#include "isolux/viz/vtk_export.h"
#include "isolux/viz/web_export.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
    CalculationOptions calculation;
    std::string time;
    std::string folder;
    bool has_no_views = false;
    bool is_quiet = false;
};

/// Rays a pixel of the views, which are previews; fewer where the tolerance is reached before.
/// `isolux render` does better pictures.
constexpr std::size_t samples_of_views = 4;

/// Stems of one file a surface, none of which is `reserved`.
std::vector<std::string> surface_stems(const Results& results,
                                       const std::vector<std::string>& reserved) {
    std::vector<std::string> names = reserved;
    for (const SurfaceResult& s : results.surfaces)
        names.push_back(s.surface.name);
    std::vector<std::string> stems = file_stems(names);
    stems.erase(stems.begin(), stems.begin() + static_cast<std::ptrdiff_t>(reserved.size()));
    return stems;
}

void write_vtk(const fs::path& folder, const Scene& scene, const Results& results) {
    write_room_vtp(folder / "room.vtp", scene);
    write_webs_vtp(folder / (std::string(webs_stem) + ".vtp"), scene);
    const std::vector<std::string> stems = surface_stems(results, {"room", webs_stem});
    for (std::size_t i = 0; i < stems.size(); ++i)
        write_surface_vtp(
            folder / (stems[i] + ".vtp"), results.surfaces[i], results.confidence);
}

void write_maps(const fs::path& folder, const ResultsDocument& document) {
    make_folder(folder);
    const Results& results = document.results;
    const Plan& plan = document.plan;
    const MapNotes notes{document.project_name,
                         results.confidence,
                         document.tolerance,
                         document.absolute_tolerance};
    std::vector<CalculationSurface> surfaces;
    for (const SurfaceResult& s : results.surfaces)
        surfaces.push_back(s.surface);
    write_plan_map(folder / "plan", plan, surfaces, document.project_name);
    const std::vector<std::string> stems = surface_stems(results, {"plan"});
    for (std::size_t i = 0; i < stems.size(); ++i)
        write_map(folder / stems[i], results.surfaces[i], plan, notes);
}

/// Now, UTC, as results.json has it.
std::string date_in_words() {
    const std::time_t now = std::time(nullptr);
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

/// Says in the results themselves why they end early.
void note_early_end(Results& results, bool is_by_user, const Settings& settings) {
    if (is_by_user)
        results.notices.push_back(
            {"", "stopped by the user before every point reached the tolerance", ""});
    else if (results.interrupted)
        results.notices.push_back(
            {"",
             fmt::format("the time limit of {} ended the calculation before every point "
                         "reached the tolerance of {:g} %",
                         format_seconds(settings.time_limit->count()),
                         100.0 * settings.tolerance),
             "Allow more time (--time) or a wider tolerance (--tolerance)"});
}

std::string
to_report(const ResultsDocument& document, const Scene& scene, const fs::path& folder) {
    std::vector<LuminairePlacement> placements;
    for (const Luminaire& l : scene.luminaires)
        placements.push_back(l.placement);
    std::string text = document.project_name + "\n\n" + to_summary_table(document.results)
                       + "\n" + to_statistics_notes(document.results)
                       + to_observer_table(document.results) + to_energy_table(document.results)
                       + to_verdict_table(document.results) + to_run_facts(document.results);
    for (const std::string& line : describe_luminaires(scene.luminaire_types, placements))
        text += "luminaires: " + line + "\n";
    text += to_maintenance_line(document.schedule);
    text += to_scene_lines(document.results);
    return text
           + fmt::format("results: {} (results.json, .xlsx, .csv, .vtp), maps and plan: {}\n"
                         "report: {}, {}\n",
                         folder.string(),
                         (folder / "maps").string(),
                         (folder / "report.html").string(),
                         (folder / "report.pdf").string());
}

/// Pictures of an earlier calculation in the same folder would show up in this one's report.
void remove_old_pictures(const fs::path& folder) {
    std::error_code ignored; // no folder, no pictures
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".png" || entry.path().extension() == ".exr")
            old.push_back(entry.path());
    for (const fs::path& file : old)
        remove_file(file);
}

/// The project's views, within what is left of the time. @return a line about each
std::vector<std::string> render_views_of(const Scene& scene,
                                         const std::vector<View>& views,
                                         const Settings& settings,
                                         double seconds_used,
                                         const fs::path& folder,
                                         const RunOptions& options,
                                         std::stop_token stop) {
    remove_old_pictures(folder);
    if (views.empty() || options.has_no_views)
        return {};
    make_folder(folder);
    RenderSettings render;
    render.samples = samples_of_views;
    render.is_preview = true;
    render.tolerance = settings.tolerance;
    render.seed = settings.seed;
    render.direct_only = settings.direct_only;
    if (settings.time_limit)
        render.time_limit = *settings.time_limit - std::chrono::duration<double>(seconds_used);
    return render_views(
        {scene, views, render, folder, false, !options.is_quiet && is_progress_wanted()},
        std::move(stop));
}

ExitCode run_project(const RunOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const InterruptGuard interrupt; // before the first worker thread starts
    const auto limit = limit_threads(options.calculation);
    Settings settings = apply(options.calculation, {}); // complain before the long work
    if (!options.time.empty())
        settings.time_limit = parse_duration("--time", options.time);
    Project project = load_project(options.calculation.project);
    const auto time_limit =
        settings.time_limit ? settings.time_limit : project.settings.time_limit;
    settings = apply(options.calculation, project.settings);
    settings.time_limit = time_limit;
    const fs::path folder = options.folder.empty()
                                ? fs::path("results") / file_stem(project.name)
                                : fs::path(options.folder);
    make_folder(folder); // a folder that cannot be made is better known now

    const Scene scene = build_scene(std::move(project.scene));
    ProgressLine line(!options.is_quiet && is_progress_wanted());
    Results results =
        calculate_project(scene, project, settings, {interrupt.token(), [&](const Progress& p) {
                                                         line.show(p);
                                                     }});
    line.clear();
    const bool is_by_user = results.interrupted && interrupt.is_interrupted();
    note_early_end(results, is_by_user, settings);
    ResultsDocument document = make_results_document(project, settings, std::move(results));
    document.plan = make_plan(scene);
    mark_aligned(document.plan, project.length_aligned);
    document.date = date_in_words();
    write_results(folder, document);
    write_xlsx(folder / "results.xlsx", document);
    write_vtk(folder, scene, document.results);
    write_maps(folder / "maps", document);

    if (!options.is_quiet)
        print(to_report(document, scene, folder));
    const std::vector<std::string> pictures = render_views_of(scene,
                                                              project.views,
                                                              settings,
                                                              document.results.wall_seconds,
                                                              folder / "views",
                                                              options,
                                                              interrupt.token());
    report::write_reports(folder, document); // which shows the views
    if (!options.is_quiet && !pictures.empty()) {
        for (const std::string& picture : pictures)
            print(picture + "\n");
        print("pictures: " + (folder / "views").string() + "\n");
    }
    if (!options.is_quiet)
        print(
            "all done in "
            + format_seconds(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count())
            + "\n");
    flush_output();
    for (const Message& notice : document.results.notices)
        report_notice(notice);
    return is_by_user ? ExitCode::failure : ExitCode::success;
}

} // namespace

Action add_run(CLI::App& verb) {
    verb.description("Calculate everything in a project");
    verb.footer(R"(
Writes into DIR: results.json and results.xlsx; for each calculation surface a .csv and a .vtp
(ParaView); room.vtp; maps/ with false-colour maps and the plan as .svg and .png; views/ with
the project's views as .exr and .png (quick ones: `isolux render` does better; those of an
earlier run are removed); report.html and report.pdf. Prints a summary.

Ctrl-C stops and writes what there is, marked as not converged; a second Ctrl-C ends at once.

Examples:
  isolux run projects/open-office
  isolux run office.json -o results/draft --tolerance 5%
  isolux run office.json --time 2min --threads 4
  isolux run office.json --estimator path-tracing --seed 7     a second opinion

Exit status: 0 results written, also when the time limit ended the calculation; 1 stopped by
Ctrl-C (results written) or failed; 2 the project or the options are wrong; 130 second Ctrl-C.)");
    const auto options = std::make_shared<RunOptions>();
    add_calculation_options(verb, options->calculation);
    verb.add_option("-o,--output",
                    options->folder,
                    "Folder for the results (default results/ and the project's name)")
        ->type_name("DIR");
    verb.add_option("--time", options->time, "Stop after this time: 60s, 1.5min, 2h")
        ->type_name("TIME");
    verb.add_flag("--no-views", options->has_no_views, "Leave out the pictures of the views");
    verb.add_flag("--quiet", options->is_quiet, "No progress, no summary; notices remain");
    return [options] { return run_project(*options); };
}

} // namespace isolux
