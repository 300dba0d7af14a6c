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
#include "isolux/cli/results_path.h"
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

/// A share or a percentage; more than all of the light is odd.
double parse_level(const std::string& word, const std::string& text) {
    double level = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), level);
    const std::string_view unit(end, text.data() + text.size());
    if (unit == "%")
        level /= 100.0;
    if (error != std::errc() || !(unit.empty() || unit == "%") || !(level >= 0.0)
        || level > 1000.0)
        throw InputError(
            "isolux scenes",
            fmt::format("'{}' is no level (NAME=LEVEL, 0 is off, 1 as calculated)", word),
            "board=0.3 or board=30%, for example");
    if (level > 1.0)
        report_notice(
            {"isolux scenes",
             fmt::format(
                 "'{}' is {:.6g} % of the light that was calculated", word, 100.0 * level),
             level >= 2.0 && level <= 100.0 && unit.empty()
                 ? fmt::format("{:.6g} or {:.6g}% for {:.6g} %?", level / 100.0, level, level)
                 : std::string()});
    return level;
}

std::vector<std::string> names_of(const Contributions& c) {
    std::vector<std::string> names;
    for (const LightSource& s : c.sources)
        names.push_back(s.name);
    return names;
}

/// What the project calls by this name, if anything.
const char* kind_of_name(const std::string& name, const Plan& plan) {
    const auto has_name = [&](const auto& thing) { return thing.name == name; };
    if (std::ranges::any_of(plan.types, has_name))
        return "luminaire type";
    if (std::ranges::any_of(plan.luminaires, has_name))
        return "luminaire";
    const auto is_in_group = [&](const PlanLuminaire& l) { return l.group == name; };
    return std::ranges::any_of(plan.luminaires, is_in_group) ? "group" : nullptr;
}

/// Why a name is not among the sources. A type or a luminaire may be there and yet not kept
/// apart.
[[noreturn]] void
throw_unknown_source(const std::string& name, const Contributions& c, const Plan& plan) {
    const std::vector<std::string> names = names_of(c);
    const bool is_by_luminaire = std::ranges::all_of(
        c.sources, [](const LightSource& s) { return s.kind == SourceKind::luminaire; });
    if (const char* kind = kind_of_name(name, plan))
        throw InputError(
            "isolux scenes",
            fmt::format("the light in these results is not kept apart by {}, as '{}' asks (it "
                        "is kept by {}; names: {})",
                        kind,
                        name,
                        is_by_luminaire ? "luminaire" : "group",
                        fmt::join(names, ", ")),
            is_by_luminaire
                ? ""
                : "\"contributions\": \"luminaires\" in the project's settings keeps every "
                  "luminaire apart");
    const auto similar = find_similar(name, names);
    throw InputError("isolux scenes",
                     fmt::format("there is no light source '{}' in these results", name),
                     similar ? fmt::format("Did you mean '{}'?", *similar)
                             : fmt::format("There are {}", fmt::join(names, ", ")));
}

/// The scene that the command line describes.
LightScene parse_scene(const ScenesOptions& options, const Contributions& c, const Plan& plan) {
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
        bool is_known = false;
        for (const LightSource& s : c.sources) {
            if (s.name != name)
                continue;
            is_known = true;
            for (const std::size_t l : s.luminaires)
                scene.factors[l] = level;
        }
        if (!is_known)
            throw_unknown_source(name, c, plan);
    }
    return scene;
}

bool is_of_a_surface(RequiredQuantity q) {
    return q == RequiredQuantity::illuminance || q == RequiredQuantity::cylindrical_illuminance
           || q == RequiredQuantity::modelling;
}

/// What was required in the run, to be asked of the scene, too.
std::vector<ProjectRequirement> requirements_in(const Results& results) {
    std::vector<ProjectRequirement> asked;
    for (const Verdict& v : results.verdicts) {
        ProjectRequirement r{v.requirement, v.subject, {}, {}};
        if (is_of_a_surface(v.requirement.quantity))
            for (std::size_t s = 0; s < results.surfaces.size(); ++s)
                if (results.surfaces[s].surface.name == v.subject)
                    r.surface = s;
        if (!r.surface && v.decision == Decision::not_judged)
            r.reason = v.reason;
        asked.push_back(std::move(r));
    }
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
    const fs::path results = find_results_file(options.folder);
    const fs::path folder = results.parent_path();
    const ResultsDocument document = read_results_json(results);
    const ContributionsDocument table = read_contributions(folder);
    std::vector<LightScene> scenes;
    if (!options.levels.empty() || !options.others.empty()) {
        scenes.push_back(parse_scene(options, table.contributions, document.plan));
    } else {
        for (const SceneResult& s : document.results.scenes)
            scenes.push_back({s.name, s.factors});
    }
    std::string text;
    for (const LightScene& scene : scenes)
        text += to_text(evaluate(table, scene, document), document.results) + "\n";
    if (options.levels.empty() && options.others.empty()) {
        text += scenes.empty() ? "no scene is named in the project; levels can be set for\n"
                               : "levels can be set for\n";
        for (const LightSource& s : table.contributions.sources)
            text += fmt::format("  {} ({} luminaire{}, {:.4g} lm)\n",
                                s.name,
                                s.luminaires.size(),
                                s.luminaires.size() == 1 ? "" : "s",
                                s.flux);
    }
    print(text);
    return ExitCode::success;
}

} // namespace

Action add_scenes(CLI::App& verb) {
    verb.description("Recombine the light of a finished calculation: dimming, failures");
    verb.footer(R"(
DIR holds the results of `isolux run`, with contributions.npy. Without levels, the project's own
scenes are shown and the names that levels can be set for. A level is a share of the light that
was calculated, 0.3 or 30%: 0 is off, 1 as it was. No ray is traced; intervals are those of a run with these
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
