#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/calc/judge.h"
#include "isolux/calc/light_scenes.h"
#include "isolux/cli/console.h"
#include "isolux/cli/run_report.h"
#include "isolux/cli/suggest.h"
#include "isolux/cli/verbs.h"
#include "isolux/cli/verdict_report.h"
#include "isolux/io/contributions_file.h"
#include "isolux/io/results_json.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

struct ScenesOptions {
    std::string folder;
    std::vector<std::string> levels; ///< "board=0.3"
    std::string others;
};

std::size_t luminaires_in(const Contributions& c) {
    std::size_t count = 0;
    for (const LightSource& s : c.sources)
        for (const std::size_t l : s.luminaires)
            count = std::max(count, l + 1);
    return count;
}

double parse_level(const std::string& word, const std::string& text) {
    double level = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), level);
    if (error != std::errc() || end != text.data() + text.size() || !(level >= 0.0)
        || level > 1000.0)
        throw InputError(
            "isolux scenes",
            fmt::format("'{}' is no level (NAME=LEVEL, 0 is off, 1 as calculated)", word),
            "board=0.3, for example");
    return level;
}

/// The scene that the command line describes.
LightScene parse_scene(const ScenesOptions& options, const Contributions& c) {
    LightScene scene{fmt::format("{}", fmt::join(options.levels, " ")), {}};
    const double others =
        options.others.empty() ? 1.0 : parse_level(options.others, options.others);
    scene.factors.assign(luminaires_in(c), others);
    for (const std::string& word : options.levels) {
        const std::size_t equals = word.rfind('=');
        if (equals == std::string::npos)
            throw InputError("isolux scenes",
                             fmt::format("'{}' is no level (NAME=LEVEL is expected)", word),
                             "board=0.3, for example");
        const std::string name = word.substr(0, equals);
        const double level = parse_level(word, word.substr(equals + 1));
        std::vector<std::string> names;
        bool is_known = false;
        for (const LightSource& s : c.sources) {
            names.push_back(s.name);
            if (s.name != name)
                continue;
            is_known = true;
            for (const std::size_t l : s.luminaires)
                scene.factors[l] = level;
        }
        if (is_known)
            continue;
        const auto similar = find_similar(name, names);
        throw InputError("isolux scenes",
                         fmt::format("there is no light source '{}' in these results", name),
                         similar ? fmt::format("Did you mean '{}'?", *similar)
                                 : fmt::format("There are {}", fmt::join(names, ", ")));
    }
    return scene;
}

/// What was required of the run's surfaces, to be asked of the scene, too.
std::vector<ProjectRequirement> requirements_in(const Results& results) {
    std::vector<ProjectRequirement> asked;
    for (const Verdict& v : results.verdicts)
        for (std::size_t s = 0; s < results.surfaces.size(); ++s)
            if (results.surfaces[s].surface.name == v.subject)
                asked.push_back({v.requirement, v.subject, s, {}});
    return asked;
}

std::string to_text(const SceneResult& scene, const Results& results) {
    Results shown;
    shown.confidence = results.confidence;
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
        SurfaceResult surface = results.surfaces[s];
        surface.summary = scene.surfaces[s];
        shown.surfaces.push_back(std::move(surface));
    }
    shown.verdicts = scene.verdicts;
    return fmt::format("scene: {}\n", scene.name) + to_summary_table(shown) + "\n"
           + to_verdict_table(shown);
}

SceneResult evaluate(const ContributionsDocument& table,
                     const LightScene& scene,
                     const ResultsDocument& document) {
    auto result = evaluate_scene(table.contributions,
                                 scene,
                                 document.results,
                                 requirements_in(document.results),
                                 document.confidence);
    if (!result)
        throw InputError("isolux scenes",
                         fmt::format("scene '{}' dims luminaires of one group differently (the "
                                     "stored contributions hold groups only)",
                                     scene.name),
                         "Run the project with contributions by luminaire?");
    return std::move(*result);
}

ExitCode show_scenes(const ScenesOptions& options) {
    const fs::path folder(options.folder);
    const ResultsDocument document = read_results_json(folder / "results.json");
    const ContributionsDocument table = read_contributions(folder);
    std::vector<LightScene> scenes;
    if (!options.levels.empty() || !options.others.empty()) {
        scenes.push_back(parse_scene(options, table.contributions));
    } else {
        for (const SceneResult& s : document.results.scenes)
            scenes.push_back({s.name, s.factors});
        if (scenes.empty()) {
            std::string text = "no scene is named in the project; light sources are\n";
            for (const LightSource& s : table.contributions.sources)
                text += fmt::format(
                    "  {} ({} luminaires, {:.4g} lm)\n", s.name, s.luminaires.size(), s.flux);
            print(text);
            return ExitCode::success;
        }
    }
    std::string text;
    for (const LightScene& scene : scenes)
        text += to_text(evaluate(table, scene, document), document.results) + "\n";
    print(text);
    return ExitCode::success;
}

} // namespace

Action add_scenes(CLI::App& verb) {
    verb.description("Recombine the light of a finished calculation: dimming, failures");
    verb.footer(R"(
DIR holds the results of `isolux run`, with contributions.npy. Without levels, the project's own
scenes are shown, or the names that levels can be set for. A level is a share of the light that
was calculated: 0 is off, 1 as it was. No ray is traced; intervals are those of a run with these
levels.

Examples:
  isolux scenes results/classroom
  isolux scenes results/classroom board=1 pupils=0.3
  isolux scenes results/classroom board=1 --others 0     only the board

Exit status: 0 shown; 2 the results hold no contributions, or a name or level is wrong.)");
    const auto options = std::make_shared<ScenesOptions>();
    verb.add_option("DIR", options->folder, "Results of `isolux run`")
        ->required()
        ->type_name("");
    verb.add_option("LEVEL", options->levels, "NAME=LEVEL of groups, types or luminaires")
        ->type_name("");
    verb.add_option("--others", options->others, "Level of everything not named (default 1)")
        ->type_name("LEVEL");
    return [options] { return show_scenes(*options); };
}

} // namespace isolux
