#include <algorithm>
#include <variant>

#include "isolux/calc/plan.h"
#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

std::optional<double> beam(const LuminairePhotometry& table, Angle plane) {
    const auto extent = find_beam(table.distribution, plane, 0.5);
    return extent ? std::optional(extent->full().in_degrees()) : std::nullopt;
}

std::string lamps_in_words(const LuminairePhotometry& table) {
    if (table.lamp_set >= table.lamp_sets.size())
        return {};
    const LampSet& set = table.lamp_sets[table.lamp_set];
    const int lamps = set.lamps < 0 ? -set.lamps : set.lamps;
    std::string words = set.type;
    for (const std::string& part : {set.colour, set.colour_rendering})
        if (!part.empty())
            words += (words.empty() ? "" : ", ") + part;
    if (lamps > 1)
        words = std::to_string(lamps) + " × " + (words.empty() ? "lamp" : words);
    return words;
}

void add_table(PlanType& facts, const LuminairePhotometry& table, double flux_scale) {
    facts.format = to_string(table.format);
    facts.manufacturer = table.manufacturer;
    facts.product = table.name;
    facts.catalogue_number = table.catalogue_number;
    facts.lamps = lamps_in_words(table);
    facts.symmetry = table.symmetry;
    facts.watts = table.input_watts;
    facts.light_output_ratio = light_output_ratio(table);
    facts.downward_share = downward_fraction(table.distribution);
    const MaximumIntensity most = find_maximum(table.distribution);
    facts.maximum = flux_scale * in_candela(most.value);
    facts.maximum_c = most.plane.in_degrees();
    facts.maximum_gamma = most.gamma.in_degrees();
    facts.beam_c0 = beam(table, degrees(0));
    facts.beam_c90 = beam(table, degrees(90));
}

} // namespace

PlanType make_plan_type(const LuminaireType& type) {
    PlanType facts;
    facts.name = type.name;
    facts.flux = in_lumen(luminous_flux(type));
    facts.file = type.file;
    facts.reference_flux = reference_flux(type);
    facts.opening = type.opening;
    facts.body = visible_body(type);
    facts.long_side = find_long_side(type);
    facts.curves = sample_polar_curves(type);
    if (const auto* table = std::get_if<LuminairePhotometry>(&type.source)) {
        add_table(facts, *table, type.flux_scale);
        return facts;
    }
    const bool is_point = std::holds_alternative<IsotropicSource>(type.source);
    facts.symmetry = is_point ? "the same in all directions" : "Lambertian";
    const bool is_upright = type.opening.shape == OpeningShape::vertical_ellipse;
    facts.downward_share = is_point || is_upright ? 0.5 : 1.0;
    facts.maximum_gamma = is_upright ? 90.0 : 0.0;
    facts.maximum = in_candela(luminous_intensity(
        type,
        is_upright ? UnitVector3::from_unit({1, 0, 0}) : UnitVector3::from_unit({0, 0, -1})));
    if (!is_point && !is_upright)
        facts.beam_c0 = facts.beam_c90 = 120.0;
    return facts;
}

void mark_aligned(Plan& plan, std::span<const std::string> types) {
    for (PlanType& t : plan.types)
        t.align_length_axis = std::find(types.begin(), types.end(), t.name) != types.end();
}

} // namespace isolux
