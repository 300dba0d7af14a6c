#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "isolux/io/project_reader.h"
#include "isolux/io/suggest.h"

namespace isolux {

namespace {

constexpr NumberRange any_level{0.0, 1000.0};

/// Whether a luminaire is meant by its name, or by that of a row of numbered ones.
bool is_named(const LuminairePlacement& l, const std::string& name) {
    return l.name == name
           || (l.name.starts_with(name + " ")
               && l.name.find_first_not_of("0123456789", name.size() + 1) == std::string::npos);
}

/// The luminaires of a group; without such a group those of a type; else those of that name.
std::vector<std::size_t> find_luminaires(const SceneDescription& scene,
                                         const std::string& name) {
    const auto select = [&](const auto& is_meant) {
        std::vector<std::size_t> found;
        for (std::size_t l = 0; l < scene.luminaires.size(); ++l)
            if (is_meant(scene.luminaires[l]))
                found.push_back(l);
        return found;
    };
    std::vector<std::size_t> found =
        select([&](const LuminairePlacement& l) { return l.group == name; });
    if (found.empty())
        found = select([&](const LuminairePlacement& l) {
            return scene.luminaire_types[l.type.index()].name == name;
        });
    if (found.empty())
        found = select([&](const LuminairePlacement& l) { return is_named(l, name); });
    return found;
}

std::vector<std::string> known_names(const SceneDescription& scene) {
    std::set<std::string> names;
    for (const LuminairePlacement& l : scene.luminaires) {
        names.insert(l.name);
        names.insert(scene.luminaire_types[l.type.index()].name);
        if (!l.group.empty())
            names.insert(l.group);
    }
    return {names.begin(), names.end()};
}

/// A share of the luminaire's flux; more than all of it is odd.
std::optional<double> read_level(const JsonNode& node) {
    const std::optional<double> level = read_number(node, any_level);
    if (level && *level > 1.0)
        node.notice(fmt::format("a level of {:.6g} gives the luminaires {:.6g} % of their flux",
                                *level,
                                100.0 * *level),
                    *level >= 2.0 && *level <= 100.0
                        ? fmt::format("Write {:.4g} for {} %?", *level / 100.0, *level)
                        : std::string());
    return level;
}

void set_level(const JsonNode& node,
               const std::string& name,
               const ProjectReader& reader,
               LightScene& light) {
    const SceneDescription& scene = reader.project.scene;
    const std::optional<double> level = read_level(node);
    if (!level)
        return;
    const std::vector<std::size_t> luminaires = find_luminaires(scene, name);
    if (luminaires.empty() && reader.lost_names.contains(name))
        return; // reported where it should have come from
    if (luminaires.empty())
        node.error(fmt::format("unknown luminaires \"{}\" (no group, type or luminaire has "
                               "this name)",
                               name),
                   did_you_mean(name, known_names(scene)));
    for (const std::size_t l : luminaires) {
        if (scene.luminaires[l].scale == 0.0 && *level > 0.0) {
            node.error(
                fmt::format("\"{}\" is off in the project (there is no light to scale)", name),
                "Let the project switch it on and the scenes dim it?");
            return;
        }
        light.factors[l] = *level;
    }
}

} // namespace

void read_scenes(const JsonNode& node, ProjectReader& reader) {
    const SceneDescription& scene = reader.project.scene;
    std::set<std::string> names;
    for (const JsonNode& item : read_list(node)) {
        const JsonObject object(item, "a scene", {"name", "levels", "others"});
        const std::optional<JsonNode> name_node = object.require("name");
        const std::optional<std::string> name =
            name_node ? read_text(*name_node) : std::nullopt;
        if (!name)
            continue;
        if (!names.insert(*name).second)
            name_node->error(fmt::format("the name \"{}\" is taken (scenes are told apart by "
                                         "their names)",
                                         *name));
        LightScene light{*name, {}};
        const std::optional<JsonNode> others = object.find("others");
        light.factors.assign(scene.luminaires.size(),
                             others ? read_level(*others).value_or(1.0) : 1.0);
        if (const std::optional<JsonNode> levels = object.find("levels"))
            for (const JsonMember& m : levels->value().members)
                set_level(levels->member(m.key, m.value), m.key, reader, light);
        reader.project.scenes.push_back(std::move(light));
    }
}

} // namespace isolux
