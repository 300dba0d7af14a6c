#include "isolux/cli/luminaire_json.h"

#include <cstdlib>

#include <nlohmann/json.hpp>

#include "isolux/cli/photometry_verbs.h"
#include "isolux/photometry/bug_rating.h"
#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json messages_to_json(const std::vector<Message>& messages) {
    Json list = Json::array();
    for (const Message& m : messages)
        list.push_back(
            {{"line", line_of(m)}, {"text", m.hint.empty() ? m.what : m.what + ". " + m.hint}});
    return list;
}

Json body_to_json(const LuminousOpening& body) {
    return {{"shape", to_string(body.shape)},
            {"x_m", in_metre(body.extent_x)},
            {"y_m", in_metre(body.extent_y)},
            {"z_m", in_metre(body.extent_z)}};
}

Json lamp_sets_to_json(const LuminairePhotometry& l) {
    Json list = Json::array();
    for (const LampSet& set : l.lamp_sets)
        list.push_back({{"lamps", std::abs(set.lamps)},
                        {"type", set.type},
                        {"flux_lm", set.flux.value() > 0.0 ? Json(set.flux.value()) : Json()},
                        {"colour", set.colour},
                        {"colour_rendering", set.colour_rendering},
                        {"watts", set.watts}});
    return list;
}

Json flux_to_json(const LuminairePhotometry& l) {
    const auto lamps = rated_lamp_flux(l);
    return {{"trapezoid", in_lumen(l.distribution.flux_trapezoid())},
            {"interpolant", in_lumen(l.distribution.flux())},
            {"declared", l.declared_flux ? Json(in_lumen(*l.declared_flux)) : Json()},
            {"lamps", lamps ? Json(in_lumen(*lamps)) : Json()}};
}

Json beams_to_json(const IntensityDistribution& d, double share) {
    Json angles;
    for (const int c : {0, 90}) {
        const auto beam = find_beam(d, degrees(c), share);
        angles["c" + std::to_string(c)] = beam ? Json(beam->full().in_degrees()) : Json();
    }
    return angles;
}

Json luminance_to_json(const LuminairePhotometry& l) {
    Json list = Json::array();
    for (const int c : {0, 90, 180, 270})
        for (int gamma = 45; gamma <= 85; gamma += 5) {
            const auto luminance = mean_luminance(l, degrees(c), degrees(gamma));
            list.push_back({{"c", c},
                            {"gamma", gamma},
                            {"cd_m2", luminance ? Json(luminance->value()) : Json()}});
        }
    return list;
}

void add_derived(Json& j, const LuminairePhotometry& l) {
    const IntensityDistribution& d = l.distribution;
    j["light_output_ratio"] = or_null(light_output_ratio(l));
    j["downward_light_output_ratio"] = or_null(downward_light_output_ratio(l));
    j["efficacy_lm_per_w"] = or_null(luminous_efficacy(l));
    j["beam_angle"] = beams_to_json(d, 0.5);
    j["field_angle"] = beams_to_json(d, 0.1);
    j["cie_flux_code"] = cie_flux_code(l);
    Json zones = Json::array();
    for (const Lumen zone : zonal_flux(d))
        zones.push_back(in_lumen(zone));
    j["zonal_lumens"] = std::move(zones);
    j["luminance"] = luminance_to_json(l);
    const BugZones bug = bug_zones(d, street_side_by_convention(l.format));
    j["bug"] = {{"asymmetric", to_string(rate(bug, LateralType::asymmetric))},
                {"symmetric", to_string(rate(bug, LateralType::symmetric))}};
}

Json to_json(const std::string& file, const Parsed<LuminairePhotometry>& parsed) {
    const LuminairePhotometry& l = parsed.value;
    const MaximumIntensity peak = find_maximum(l.distribution);
    Json j{{"file", file},
           {"format", to_string(l.format)},
           {"type", std::string(1, l.photometric_type)},
           {"symmetry", l.symmetry},
           {"planes", l.planes_in_file},
           {"gammas", l.gammas_in_file},
           {"manufacturer", l.manufacturer},
           {"name", l.name},
           {"catalogue_number", l.catalogue_number},
           {"report", l.report},
           {"laboratory", l.laboratory},
           {"date", l.date},
           {"contained_file", l.contained_file},
           {"absolute", l.is_absolute},
           {"max_candela", peak.value.value()},
           {"max_at", {{"c", peak.plane.in_degrees()}, {"gamma", peak.gamma.in_degrees()}}},
           {"flux_lm", flux_to_json(l)},
           {"downward_fraction", downward_fraction(l.distribution)},
           {"lamps",
            l.lamp_set < l.lamp_sets.size() ? std::abs(l.lamp_sets[l.lamp_set].lamps) : 0},
           {"lamp_set", l.lamp_set + 1},
           {"lamp_sets", lamp_sets_to_json(l)},
           {"input_watts", l.input_watts},
           {"opening", body_to_json(l.opening)},
           {"housing", body_to_json(l.housing)}};
    add_derived(j, l);
    j["notices"] = messages_to_json(parsed.notices);
    return j;
}

} // namespace

std::string to_json_text(std::span<const ReadLuminaire> luminaires) {
    Json list = Json::array();
    for (const ReadLuminaire& l : luminaires)
        list.push_back(l.parsed
                           ? to_json(l.file, *l.parsed)
                           : Json{{"file", l.file}, {"errors", messages_to_json(l.errors)}});
    const Json& top = luminaires.size() == 1 ? list.front() : list;
    constexpr auto replace = Json::error_handler_t::replace; // bytes that are no UTF-8
    return top.dump(2, ' ', false, replace) + "\n";
}

} // namespace isolux
