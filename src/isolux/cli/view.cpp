#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/cli/console.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/results_path.h"
#include "isolux/cli/suggest.h"
#include "isolux/cli/verbs.h"
#include "isolux/viz/probe.h"
#include "isolux/viz/viewer.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct ViewOptions {
    std::string folder;
    std::string camera = "orbit";
    std::string screenshot;
    std::string probe;
    std::string surface;
};

ViewerCamera parse_camera(const std::string& word) {
    if (word == "orbit")
        return ViewerCamera::orbit;
    if (word == "plan")
        return ViewerCamera::plan;
    if (word == "section")
        return ViewerCamera::section;
    throw InputError("--camera",
                     fmt::format("'{}' is no camera", word),
                     "Known are orbit, plan and section");
}

/// "1,2,0.75".
Point3 parse_place(const std::string& text) {
    std::vector<double> numbers;
    std::size_t start = 0;
    while (start <= text.size()) {
        const std::size_t comma = std::min(text.find(',', start), text.size());
        numbers.push_back(parse_finite_number(text.substr(start, comma - start)));
        start = comma + 1;
    }
    const bool is_whole =
        std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::isfinite(n); });
    if (numbers.size() != 3 || !is_whole)
        throw InputError("--probe",
                         fmt::format("'{}' is no place (x,y,z in metres is expected)", text),
                         "--probe 1.5,2,0.75, for example");
    return {numbers[0], numbers[1], numbers[2]};
}

std::size_t find_surface(const std::string& name, const Results& results) {
    std::vector<std::string> names;
    for (std::size_t s = 0; s < results.surfaces.size(); ++s) {
        names.push_back(results.surfaces[s].surface.name);
        if (names.back() == name)
            return s;
    }
    const auto similar = find_similar(name, names);
    throw InputError("--surface",
                     fmt::format("there is no calculation surface '{}' in these results", name),
                     similar ? fmt::format("Did you mean '{}'?", *similar)
                             : fmt::format("There are {}", fmt::join(names, ", ")));
}

ExitCode view(const ViewOptions& o) {
    ViewerOptions options;
    options.camera = parse_camera(o.camera);
    if (!o.probe.empty())
        options.probe = parse_place(o.probe);
    if (!o.screenshot.empty()) {
        if (fs::path(o.screenshot).extension() != ".png")
            throw InputError("--screenshot",
                             fmt::format("'{}' is no name of a picture", o.screenshot),
                             "A name that ends in .png?");
        options.screenshot = o.screenshot;
    }
    const fs::path results = find_results_file(o.folder);
    const ResultsDocument document = read_results_json(results);
    if (!o.surface.empty())
        options.surface = find_surface(o.surface, document.results);
    if (options.probe) {
        const auto found =
            find_nearest_point(document.results, *options.probe, options.surface);
        if (!found)
            throw InputError(o.folder, "the results hold no point", "");
        print(describe_point(document.results, *found));
        if (!options.screenshot)
            return ExitCode::success;
    }
    view_results(document, results.parent_path(), options);
    if (options.screenshot)
        print(o.screenshot + "\n");
    return ExitCode::success;
}

} // namespace

Action add_view(CLI::App& verb) {
    verb.description("Look at the results of a calculation in space");
    verb.footer(
        "\nShows the room, the luminaires with their C0 arrows and photometric webs, and "
        "the calculation\nsurfaces in false colours with isolux lines.\n\nKeys:\n"
        + viewer_keys() + R"(

Examples:
  isolux view results/open-office
  isolux view results/open-office --camera plan --surface "work plane"
  isolux view results/open-office --screenshot office.png
  isolux view results/open-office --probe 1.5,2,0.75      in words, without a window
  xvfb-run isolux view DIR --screenshot office.png         on a machine without a screen

Exit status: 0 closed or written; 2 no display, or an option or the folder is wrong.)");
    const auto options = std::make_shared<ViewOptions>();
    verb.add_option("DIR", options->folder, "Results folder of `isolux run`")
        ->required()
        ->type_name("");
    verb.add_option("--camera", options->camera, "orbit, plan or section")->type_name("CAMERA");
    verb.add_option("--surface", options->surface, "Show this calculation surface alone")
        ->type_name("NAME");
    verb.add_option("--probe", options->probe, "Print the values of the nearest point, m")
        ->type_name("X,Y,Z");
    verb.add_option("--screenshot", options->screenshot, "Write a picture and end")
        ->type_name("FILE.png");
    return [options] { return view(*options); };
}

} // namespace isolux
