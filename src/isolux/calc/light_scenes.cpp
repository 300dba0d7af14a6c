#include "isolux/calc/light_scenes.h"

#include <algorithm>

#include "isolux/base/parallel.h"
#include "isolux/calc/judge.h"

namespace isolux {

namespace {

/// First point of each surface in the table.
std::vector<std::size_t> first_points(const Results& results) {
    std::vector<std::size_t> first;
    std::size_t next = 0;
    for (const SurfaceResult& s : results.surfaces) {
        first.push_back(next);
        next += s.surface.receivers.size();
    }
    return first;
}

/// Points that are combined together: few enough for their sums to stay near the processor.
constexpr std::size_t chunk = 512;

/// One part of a surface's light under other levels.
ReplicateTable combine_part(const Contributions& contributions,
                            LightPart part,
                            std::span<const double> levels,
                            std::size_t first,
                            std::size_t points) {
    const std::size_t replicates = contributions.replicates;
    ReplicateTable all{replicates, points, std::vector<double>(replicates * points)};
    for_each_index((points + chunk - 1) / chunk, 1, [&](std::size_t c) {
        const std::size_t begin = c * chunk;
        const std::size_t count = std::min(chunk, points - begin);
        const ReplicateTable some = combine(contributions, part, levels, first + begin, count);
        for (std::size_t r = 0; r < replicates; ++r)
            std::ranges::copy(some.row(r),
                              all.values.begin()
                                  + static_cast<std::ptrdiff_t>(r * points + begin));
    });
    return all;
}

/// A surface as it is under other levels, without its points' own estimates.
SurfaceResult relit(const SurfaceResult& surface,
                    std::size_t first,
                    const Contributions& contributions,
                    std::span<const double> levels) {
    SurfaceResult s;
    s.surface = surface.surface;
    s.converged = surface.converged;
    const std::size_t points = surface.surface.receivers.size();
    s.direct = combine_part(contributions, LightPart::direct, levels, first, points);
    s.replicates = combine_part(contributions, LightPart::indirect, levels, first, points);
    for (std::size_t i = 0; i < s.replicates.values.size(); ++i)
        s.replicates.values[i] += s.direct.values[i];
    s.summary = summarise(s.replicates);
    return s;
}

/// Why a requirement has no verdict in a scene; empty where it has one.
std::string why_not_in_scenes(const Requirement& r) {
    const std::string not_judged = r.symbol + " is not judged in scenes: ";
    switch (r.quantity) {
    case RequiredQuantity::unified_glare_rating:
    case RequiredQuantity::glare_rating:
        return not_judged + "what reaches the eyes is not kept apart by luminaire";
    case RequiredQuantity::colour_rendering:
        return not_judged + "it is that of the run";
    case RequiredQuantity::power_density:
        return not_judged + "the power of dimmed luminaires is not stated";
    case RequiredQuantity::illuminance:
    case RequiredQuantity::cylindrical_illuminance:
    case RequiredQuantity::modelling:
        break;
    }
    return {};
}

} // namespace

std::optional<std::vector<double>> source_levels(std::span<const LightSource> sources,
                                                 std::span<const double> factors) {
    std::vector<double> levels;
    for (const LightSource& source : sources) {
        std::optional<double> level;
        for (const std::size_t l : source.luminaires) {
            if (l >= factors.size() || (level && *level != factors[l]))
                return std::nullopt;
            level = factors[l];
        }
        levels.push_back(level.value_or(1.0));
    }
    return levels;
}

SourceSplit split_for(const Scene& scene, std::span<const LightScene> scenes) {
    if (scenes.empty())
        return SourceSplit::automatic;
    const std::vector<LightSource> groups = find_light_sources(scene, SourceSplit::groups);
    const bool groups_do = std::ranges::all_of(scenes, [&](const LightScene& s) {
        return source_levels(groups, s.factors).has_value();
    });
    return groups_do ? SourceSplit::groups : SourceSplit::luminaires;
}

std::optional<SceneResult> evaluate_scene(const Contributions& contributions,
                                          const LightScene& scene,
                                          const Results& results,
                                          std::span<const ProjectRequirement> requirements,
                                          double confidence) {
    const auto levels = source_levels(contributions.sources, scene.factors);
    if (!levels)
        return std::nullopt;
    Results lit;
    lit.replicates = contributions.replicates;
    lit.looks = results.looks;
    lit.confidence = results.confidence;
    lit.surfaces.resize(results.surfaces.size());
    const std::vector<std::size_t> first = first_points(results);
    for_each_index(results.surfaces.size(), 1, [&](std::size_t s) {
        lit.surfaces[s] = relit(results.surfaces[s], first[s], contributions, *levels);
    });
    lit.modelling = find_modelling(lit);
    SceneResult result;
    result.name = scene.name;
    result.factors = scene.factors;
    for (const SurfaceResult& s : lit.surfaces)
        result.surfaces.push_back(s.summary);
    Project asked;
    asked.requirements.assign(requirements.begin(), requirements.end());
    for (ProjectRequirement& r : asked.requirements)
        if (r.reason.empty())
            r.reason = why_not_in_scenes(r.requirement);
    result.verdicts = judge(asked, lit, confidence);
    return result;
}

} // namespace isolux
