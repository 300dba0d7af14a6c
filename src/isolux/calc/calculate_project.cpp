#include "isolux/calc/calculate_project.h"

#include <algorithm>
#include <iterator>

#include "isolux/calc/energy_of.h"
#include "isolux/calc/judge.h"
#include "isolux/calc/light_scenes.h"
#include "isolux/calc/observers.h"

namespace isolux {

namespace {

/// Keeps the first `points` points of a table.
Contributions first_points(const Contributions& all, std::size_t points) {
    Contributions kept{all.sources, all.replicates, points, {}, {}};
    for (std::size_t s = 0; s < all.sources.size(); ++s)
        for (std::size_t r = 0; r < all.replicates; ++r) {
            const auto direct = all.row(LightPart::direct, s, r).first(points);
            const auto indirect = all.row(LightPart::indirect, s, r).first(points);
            kept.direct.insert(kept.direct.end(), direct.begin(), direct.end());
            kept.indirect.insert(kept.indirect.end(), indirect.begin(), indirect.end());
        }
    return kept;
}

/// Power of a scene, if power is proportional to light and the project's own dimming is.
std::optional<double>
power_of(const Project& project, const Scene& scene, const LightScene& light) {
    double watts = 0.0;
    for (std::size_t l = 0; l < scene.luminaires.size(); ++l) {
        const LuminairePlacement& placement = scene.luminaires[l].placement;
        const ScheduleEntry& entry = project.schedule[placement.type.index()];
        if (!entry.watts)
            return std::nullopt;
        const double dimming = placement.scale / entry.maintenance.value;
        watts += *entry.watts * dimming * light.factors[l];
    }
    return watts;
}

/// Settings that keep the light of the sources apart as finely as the scenes need.
Settings with_sources(Settings settings, const Scene& scene, const Project& project) {
    if (!project.scenes.empty() && settings.contributions == SourceSplit::automatic)
        settings.contributions = split_for(scene, project.scenes);
    return settings;
}

void evaluate_scenes(const Project& project,
                     const Scene& scene,
                     const Settings& settings,
                     Results& results) {
    for (const LightScene& light : project.scenes) {
        std::optional<SceneResult> found;
        if (results.contributions)
            found = evaluate_scene(*results.contributions,
                                   light,
                                   results,
                                   project.requirements,
                                   settings.confidence);
        if (found) {
            found->watts = power_of(project, scene, light);
            results.scenes.push_back(std::move(*found));
            continue;
        }
        results.notices.push_back(
            {"scene " + light.name,
             results.contributions ? "it dims luminaires of one group differently, and their "
                                     "light was not told apart"
                                   : "the light of the luminaires was not told apart",
             "Ask for contributions by luminaire?"});
    }
}

} // namespace

Results calculate_project(const Scene& scene,
                          const Project& project,
                          const Settings& settings,
                          const Control& control) {
    // What the observers need is measured beside the surfaces, and set apart afterwards.
    std::vector<CalculationSurface> all = project.surfaces;
    const std::vector<CalculationSurface> eyes = observer_surfaces(project.observers);
    all.insert(all.end(), eyes.begin(), eyes.end());
    Results results = calculate(scene, all, with_sources(settings, scene, project), control);
    const auto first =
        results.surfaces.begin() + static_cast<std::ptrdiff_t>(project.surfaces.size());
    const std::vector<SurfaceResult> at_the_eyes(
        std::make_move_iterator(first), std::make_move_iterator(results.surfaces.end()));
    results.surfaces.erase(first, results.surfaces.end());
    if (results.contributions && !eyes.empty()) {
        std::size_t points = 0;
        for (const SurfaceResult& surface : results.surfaces)
            points += surface.points.size();
        results.contributions = first_points(*results.contributions, points);
    }
    if (results.replicates > 0)
        results.observers = rate_observers(scene, project, at_the_eyes, results.surfaces);
    results.modelling = find_modelling(results);
    results.energy = energy_of(project, scene, results);
    evaluate_scenes(project, scene, settings, results);
    results.verdicts = judge(project, results, settings.confidence);
    return results;
}

} // namespace isolux
