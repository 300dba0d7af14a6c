#include "isolux/calc/contributions.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "isolux/base/check.h"

namespace isolux {

namespace {

/// The source a luminaire belongs to, without members yet.
LightSource source_of(const Scene& scene, const Luminaire& luminaire, SourceSplit split) {
    const LuminairePlacement& placement = luminaire.placement;
    if (split == SourceSplit::luminaires)
        return {placement.name, SourceKind::luminaire, 0.0, {}};
    if (!placement.group.empty())
        return {placement.group, SourceKind::group, 0.0, {}};
    return {scene.type_of(luminaire).name, SourceKind::type, 0.0, {}};
}

/// Appends what it takes to tell the sources' names apart.
void make_names_differ(std::vector<LightSource>& sources) {
    std::set<std::string> groups;
    for (const LightSource& s : sources)
        if (s.kind == SourceKind::group)
            groups.insert(s.name);
    std::map<std::string, std::size_t> seen;
    for (LightSource& s : sources) {
        if (s.kind == SourceKind::type && groups.contains(s.name))
            s.name += " (no group)";
        if (const std::size_t n = ++seen[s.name]; n > 1)
            s.name += " #" + std::to_string(n);
    }
}

void add(const Contributions& c,
         LightPart part,
         std::span<const double> levels,
         std::size_t first_point,
         ReplicateTable& table) {
    for (std::size_t s = 0; s < c.sources.size(); ++s)
        for (std::size_t r = 0; r < c.replicates; ++r) {
            const auto row = c.row(part, s, r).subspan(first_point, table.points);
            for (std::size_t p = 0; p < table.points; ++p)
                table.values[r * table.points + p] += levels[s] * static_cast<double>(row[p]);
        }
}

ReplicateTable empty_table(const Contributions& c,
                           [[maybe_unused]] std::span<const double> levels,
                           [[maybe_unused]] std::size_t first_point,
                           std::size_t points) {
    ISOLUX_EXPECT(levels.size() == c.sources.size());
    ISOLUX_EXPECT(first_point + points <= c.points);
    return {c.replicates, points, std::vector<double>(c.replicates * points, 0.0)};
}

} // namespace

std::vector<LightSource> find_light_sources(const Scene& scene, SourceSplit split) {
    std::vector<LightSource> sources;
    std::map<std::pair<SourceKind, std::string>, std::size_t> known;
    for (std::size_t l = 0; l < scene.luminaires.size(); ++l) {
        LightSource own = source_of(scene, scene.luminaires[l], split);
        std::size_t at = sources.size();
        if (own.kind != SourceKind::luminaire)
            at = known.try_emplace({own.kind, own.name}, at).first->second;
        if (at == sources.size())
            sources.push_back(std::move(own));
        sources[at].luminaires.push_back(l);
        sources[at].flux += in_lumen(scene.luminaires[l].flux);
    }
    make_names_differ(sources);
    return sources;
}

std::vector<std::uint32_t> source_of_luminaires(std::span<const LightSource> sources,
                                                std::size_t luminaires) {
    std::vector<std::uint32_t> of(luminaires, 0);
    for (std::size_t s = 0; s < sources.size(); ++s)
        for (const std::size_t l : sources[s].luminaires)
            of[l] = static_cast<std::uint32_t>(s);
    return of;
}

ReplicateTable combine(const Contributions& contributions,
                       std::span<const double> levels,
                       std::size_t first_point,
                       std::size_t points) {
    ReplicateTable table = empty_table(contributions, levels, first_point, points);
    add(contributions, LightPart::direct, levels, first_point, table);
    add(contributions, LightPart::indirect, levels, first_point, table);
    return table;
}

ReplicateTable combine(const Contributions& contributions,
                       LightPart part,
                       std::span<const double> levels,
                       std::size_t first_point,
                       std::size_t points) {
    ReplicateTable table = empty_table(contributions, levels, first_point, points);
    add(contributions, part, levels, first_point, table);
    return table;
}

} // namespace isolux
