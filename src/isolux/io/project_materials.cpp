#include "isolux/io/project_materials.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "isolux/io/suggest.h"

namespace isolux {

namespace {

const Opaque black{};

bool is_absorber(std::string_view name) { return name == "black" || name == "open"; }

std::optional<Rgb> read_reflectance(const JsonNode& node) {
    if (node.is(JsonValue::Kind::array)) {
        const auto rgb = read_numbers(node, 3, 3, "[red, green, blue]", any_share);
        return rgb ? std::optional(Rgb{(*rgb)[0], (*rgb)[1], (*rgb)[2]}) : std::nullopt;
    }
    const std::optional<double> grey = read_number(node, any_share);
    return grey ? std::optional(Rgb::grey(*grey)) : std::nullopt;
}

std::string name_of(const Rgb& c) {
    return is_grey(c) ? fmt::format("reflectance {}", c.r)
                      : fmt::format("reflectance [{}, {}, {}]", c.r, c.g, c.b);
}

/// Transmittance of the glass itself from that of the pane at normal incidence, METHODS eq.
/// (36).
double internal_transmittance(double pane, double refractive_index) {
    const double root = (refractive_index - 1.0) / (refractive_index + 1.0);
    const double r = root * root;
    const double enter = (1.0 - r) * (1.0 - r);
    return 2.0 * pane / (enter + std::sqrt(enter * enter + 4.0 * pane * pane * r * r));
}

ClearPane read_pane(const JsonNode& node) {
    const JsonObject object(node, "a pane", {"transmittance", "refractive_index"});
    ClearPane pane;
    pane.refractive_index = object.number("refractive_index", {1.0, 4.0}, 1.52);
    const std::optional<JsonNode> given = object.find("transmittance");
    if (!given)
        return pane;
    const std::optional<double> transmittance = read_number(*given, {0.0, 1.0, true});
    if (!transmittance)
        return pane;
    const double tau = internal_transmittance(*transmittance, pane.refractive_index);
    const double clearest = evaluate_slab({pane.refractive_index, 1.0}, 1.0).transmittance;
    constexpr double rounding = 1e-3; // data sheets give three digits
    if (tau > 1.0 + rounding)
        given->error(fmt::format("{} is more than a pane of index {} can transmit (its two "
                                 "surfaces leave {:.3f})",
                                 *transmittance,
                                 pane.refractive_index,
                                 clearest),
                     "Leave the key out for clear glass?");
    pane.internal_transmittance = std::min(tau, 1.0);
    return pane;
}

} // namespace

void MaterialTable::define(const JsonNode& definitions) {
    if (!definitions.is(JsonValue::Kind::object)) {
        definitions.error(fmt::format("materials is an object {{...}} with a member for each "
                                      "material (found {})",
                                      kind_in_words(definitions.value())));
        return;
    }
    check_repeated_keys(definitions);
    for (const JsonMember& member : definitions.value().members)
        definitions_.emplace(
            member.key, Definition{definitions.member(member.key, member.value), {}, {}, {}});
    for (auto& [name, definition] : definitions_)
        read(definition, name);
}

void MaterialTable::read(Definition& definition, const std::string& name) {
    if (definition.state != State::unread)
        return;
    definition.state = State::reading;
    if (definition.node.is(JsonValue::Kind::object)) {
        definition.material = read_object(definition.node);
    } else if (definition.node.is(JsonValue::Kind::text)) {
        definition.node.error(
            "a number, [red, green, blue] or an object {...} is expected here "
            "(found text)",
            "Write {\"like\": \"" + definition.node.value().text + "\"}?");
    } else if (const std::optional<Rgb> diffuse = read_reflectance(definition.node)) {
        definition.material.scattering = Opaque{*diffuse, 0.0};
    }
    definition.material.name = name;
    definition.state = State::read;
}

std::optional<Material> MaterialTable::material_named(const JsonNode& node) {
    const std::optional<std::string> name = read_text(node);
    if (!name)
        return std::nullopt;
    if (const auto own = definitions_.find(*name); own != definitions_.end()) {
        if (own->second.state == State::reading) {
            node.error(fmt::format("\"{}\" is like itself, directly or through others (where "
                                   "would its values come from?)",
                                   *name));
            return std::nullopt;
        }
        read(own->second, own->first);
        return own->second.material;
    }
    if (const Material* everyday = find_everyday_material(*name))
        return *everyday;
    if (is_absorber(*name))
        return Material{*name, black, Sides::both};
    std::string hint = did_you_mean(*name, known_names());
    if (const std::optional<double> share = percentage_in(*name))
        hint = fmt::format("Write {:.4g} for {:.4g} %?", *share, 100.0 * *share);
    else if (double value = 0.0;
             std::from_chars(name->data(), name->data() + name->size(), value).ptr
                 == name->data() + name->size()
             && std::isfinite(value))
        hint = fmt::format("Write {} without quotes?", value);
    node.error(fmt::format("unknown material \"{}\" (neither one of the project nor an "
                           "everyday one)",
                           *name),
               hint);
    return std::nullopt;
}

Material MaterialTable::read_object(const JsonNode& node) {
    const JsonObject object(
        node, "a material", {"like", "reflectance", "mirror", "pane", "sides"});
    Material material;
    material.scattering = black;
    if (const std::optional<JsonNode> like = object.find("like"))
        material = material_named(*like).value_or(material);
    object.exclude("pane", {"reflectance", "mirror"});
    if (const std::optional<JsonNode> pane = object.find("pane")) {
        material.scattering = read_pane(*pane);
    } else if (object.has("reflectance") || object.has("mirror")) {
        Opaque opaque = std::holds_alternative<Opaque>(material.scattering)
                            ? std::get<Opaque>(material.scattering)
                            : black;
        if (const std::optional<JsonNode> reflectance = object.find("reflectance"))
            opaque.diffuse = read_reflectance(*reflectance).value_or(opaque.diffuse);
        opaque.mirror = object.number("mirror", any_share, opaque.mirror);
        constexpr double rounding = 1e-9;
        if (const double sum = max_channel(opaque.diffuse) + opaque.mirror;
            sum > 1.0 + rounding)
            node.error(
                fmt::format("diffuse reflectance and mirror share add up to {:.4g} (more "
                            "light would leave than arrives)",
                            sum),
                "Reduce one of the two");
        material.scattering = opaque;
    }
    if (const std::optional<JsonNode> sides = object.find("sides")) {
        constexpr std::array<std::string_view, 2> words{"both", "front"};
        material.sides = read_choice(*sides, words) == 1U ? Sides::front : Sides::both;
        if (material.sides == Sides::front
            && std::holds_alternative<ClearPane>(material.scattering))
            sides->error("a pane has no dark side (light passes it both ways)",
                         "Remove \"sides\"");
    }
    return material;
}

MaterialId MaterialTable::add(Material material) {
    materials_.push_back(std::move(material));
    return MaterialId(materials_.size() - 1);
}

MaterialId MaterialTable::grey(double reflectance) { return coloured(Rgb::grey(reflectance)); }

MaterialId MaterialTable::coloured(const Rgb& diffuse) {
    const auto [known, is_new] = others_.try_emplace(name_of(diffuse));
    if (is_new)
        known->second = add({name_of(diffuse), Opaque{diffuse, 0.0}, Sides::both});
    return known->second;
}

std::optional<MaterialId> MaterialTable::find(std::string_view name) {
    if (const auto own = definitions_.find(name); own != definitions_.end()) {
        if (!own->second.id)
            own->second.id = add(own->second.material);
        return own->second.id;
    }
    if (const auto known = others_.find(name); known != others_.end())
        return known->second;
    std::optional<Material> material;
    if (const Material* everyday = find_everyday_material(name))
        material = *everyday;
    else if (is_absorber(name))
        material = Material{std::string(name), black, Sides::both};
    if (!material)
        return std::nullopt;
    return others_.emplace(std::string(name), add(std::move(*material))).first->second;
}

MaterialId MaterialTable::resolve(const JsonNode& finish) {
    if (finish.is(JsonValue::Kind::text)) {
        if (const std::optional<MaterialId> id = find(finish.value().text))
            return *id;
        static_cast<void>(material_named(finish)); // reports why not
        return grey(0.0);
    }
    if (!finish.is(JsonValue::Kind::number) && !finish.is(JsonValue::Kind::array)) {
        finish.error(
            fmt::format("a reflectance, [red, green, blue] or the name of a material is "
                        "expected here (found {})",
                        kind_in_words(finish.value())));
        return grey(0.0);
    }
    return coloured(read_reflectance(finish).value_or(Rgb{}));
}

bool MaterialTable::is_pane(MaterialId id) const noexcept {
    return std::holds_alternative<ClearPane>(materials_[id.index()].scattering);
}

std::vector<std::string> MaterialTable::known_names() const {
    std::vector<std::string> names{"black", "open"};
    for (const auto& [name, definition] : definitions_)
        names.push_back(name);
    for (const Material& material : everyday_materials())
        names.push_back(material.name);
    return names;
}

} // namespace isolux
