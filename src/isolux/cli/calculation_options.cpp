#include "isolux/cli/calculation_options.h"

#include <cstdint>
#include <utility>

#include <CLI/CLI.hpp>

#include "isolux/base/error.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/project_path.h"
#include "isolux/io/project_json.h"
#include "isolux/measure/inspect_places.h"

namespace isolux {

void add_calculation_options(CLI::App& verb, CalculationOptions& options) {
    verb.add_option("PROJECT", options.project, "A project file, or a folder with project.json")
        ->required()
        ->type_name("");
    verb.add_option("--tolerance",
                    options.tolerance,
                    "Half width of the interval over its value, 1% or 0.01")
        ->type_name("SHARE");
    verb.add_option("--estimator",
                    options.estimator,
                    "How reflected light is calculated: auto, mis, path-tracing, local, "
                    "head, bounded, bidirectional")
        ->type_name("NAME");
    verb.add_option("--seed", options.seed, "Seed of the random numbers")->type_name("N");
    verb.add_option("--threads", options.threads, "Threads to use (default: all)")
        ->type_name("N");
}

Settings apply(const CalculationOptions& options, Settings settings) {
    if (!options.tolerance.empty())
        settings.tolerance = parse_tolerance("--tolerance", options.tolerance);
    if (!options.seed.empty())
        settings.seed = parse_count("--seed", options.seed, 0, UINT64_MAX);
    if (!options.estimator.empty())
        settings.estimator = parse_estimator("--estimator", options.estimator);
    return settings;
}

std::unique_ptr<ThreadLimit> limit_threads(const CalculationOptions& options) {
    if (options.threads.empty())
        return nullptr;
    return std::make_unique<ThreadLimit>(parse_count("--threads", options.threads, 1, 1024));
}

Project load_project(const std::string& argument) {
    Project project = read_project(find_project_file(argument));
    for (Message& notice : inspect_scene(project.scene))
        project.notices.push_back(std::move(notice));
    for (Message& notice :
         inspect_places(project.scene, project.surfaces, project.observers, project.views))
        project.notices.push_back(std::move(notice));
    return project;
}

} // namespace isolux
