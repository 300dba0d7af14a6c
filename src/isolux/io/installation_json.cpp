#include "isolux/io/installation_json.h"

#include <array>
#include <utility>

#include <nlohmann/json.hpp>

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> half_planes{"c0", "c90", "c180", "c270"};

Json to_json(const Vector3& v) { return Json::array({v.x, v.y, v.z}); }

Json to_json(const LuminousOpening& o) {
    return {{"shape", to_string(o.shape)},
            {"x_m", in_metre(o.extent_x)},
            {"y_m", in_metre(o.extent_y)},
            {"z_m", in_metre(o.extent_z)}};
}

Json to_json(const PlanType& t) {
    Json json{{"name", t.name},
              {"file", t.file},
              {"format", t.format},
              {"manufacturer", t.manufacturer},
              {"product", t.product},
              {"catalogue_number", t.catalogue_number},
              {"lamps", t.lamps},
              {"symmetry", t.symmetry},
              {"flux_lm", t.flux},
              {"reference_flux_lm", t.reference_flux},
              {"watts", t.watts}};
    if (t.light_output_ratio)
        json["light_output_ratio"] = *t.light_output_ratio;
    json["downward_share"] = t.downward_share;
    json["max_candela"] = t.maximum;
    json["max_at"] = {{"c", t.maximum_c}, {"gamma", t.maximum_gamma}};
    if (t.beam_c0)
        json["beam_c0"] = *t.beam_c0;
    if (t.beam_c90)
        json["beam_c90"] = *t.beam_c90;
    json["opening"] = to_json(t.opening);
    json["body"] = to_json(t.body);
    json["align_length_axis"] = t.align_length_axis;
    if (t.long_side)
        json["long_side"] = {{"axis", t.long_side->is_along_y ? "y" : "x"},
                             {"length_m", t.long_side->length}};
    Json& curves = json["curves"] = {{"gamma", t.curves[0].gamma}};
    for (std::size_t k = 0; k < half_planes.size(); ++k)
        curves[half_planes[k]] = t.curves[k].candela;
    return json;
}

Json to_json(const PlanLuminaire& l, const Plan& plan) {
    return {{"name", l.name},
            {"type", plan.types[l.type].name},
            {"position", Json::array({l.position.x, l.position.y, l.position.z})},
            {"c0", to_json(l.frame.x)},
            {"c90", to_json(l.frame.y)},
            {"up", to_json(l.frame.z)},
            {"scale", l.scale},
            {"group", l.group}};
}

Json to_json(const std::vector<Polyline>& lines) {
    Json json = Json::array();
    for (const Polyline& line : lines) {
        Json& flat = json.emplace_back(Json::array());
        for (const Point2& p : line) {
            flat.push_back(p.x);
            flat.push_back(p.y);
        }
    }
    return json;
}

Json to_json(const std::vector<PlanOutline>& outlines) {
    Json json = Json::array();
    for (const PlanOutline& o : outlines)
        json.push_back({{"name", o.name},
                        {"lower", o.lower},
                        {"upper", o.upper},
                        {"lines", to_json(o.lines)},
                        {"faces", to_json(o.faces)}});
    return json;
}

constexpr std::array<const char*, 3> states{"open", "closed", "glazed"};

Json to_json(const SceneOpening& o) {
    return {{"room", o.room},
            {"name", o.name},
            {"from", Json::array({o.from.x, o.from.y})},
            {"to", Json::array({o.to.x, o.to.y})},
            {"sill", o.sill},
            {"height", o.height},
            {"state", states[static_cast<std::size_t>(o.state)]}};
}

Json to_json(const PlanFinish& f) {
    return {{"of", f.owner},
            {"part", f.part},
            {"is_room", f.is_room},
            {"material", f.material},
            {"area_m2", f.area},
            {"reflectance", f.reflectance},
            {"mirror", f.mirror},
            {"transmittance", f.transmittance}};
}

Point2 to_point2(const ResultsNode& node) {
    const std::vector<double> xy = node.numbers();
    if (xy.size() != 2)
        node.fail("not a pair of numbers");
    return {xy[0], xy[1]};
}

SceneOpening to_scene_opening(const ResultsNode& node) {
    SceneOpening o{node.at("room").text(),
                   node.at("name").text(),
                   to_point2(node.at("from")),
                   to_point2(node.at("to")),
                   node.at("sill").number(),
                   node.at("height").number()};
    const std::string word = node.at("state").text();
    for (std::size_t k = 0; k < states.size(); ++k)
        if (word == states[k]) {
            o.state = static_cast<OpeningState>(k);
            return o;
        }
    node.at("state").fail("unknown state '" + word + "'");
}

PlanFinish to_finish(const ResultsNode& node) {
    return {node.at("of").text(),
            node.at("part").text(),
            node.at("material").text(),
            node.at("area_m2").number(),
            node.at("reflectance").number(),
            node.at("mirror").number(),
            node.at("transmittance").number(),
            node.at("is_room").boolean()};
}

LuminousOpening to_opening(const ResultsNode& node) {
    const std::string word = node.at("shape").text();
    for (int k = 0; k <= static_cast<int>(OpeningShape::vertical_ellipse); ++k)
        if (const auto shape = static_cast<OpeningShape>(k); to_string(shape) == word)
            return {shape,
                    Metre(node.at("x_m").number()),
                    Metre(node.at("y_m").number()),
                    Metre(node.at("z_m").number())};
    node.at("shape").fail("unknown shape '" + word + "'");
}

std::optional<double> to_optional(const ResultsNode& node, const char* key) {
    const auto member = node.find(key);
    return member ? std::optional(member->number()) : std::nullopt;
}

PolarCurves to_curves(const ResultsNode& node) {
    PolarCurves curves;
    for (std::size_t k = 0; k < curves.size(); ++k) {
        curves[k] = {node.at("gamma").numbers(), node.at(half_planes[k]).numbers()};
        if (curves[k].gamma.size() != curves[k].candela.size())
            node.at(half_planes[k]).fail("as many values as gammas are needed");
    }
    return curves;
}

PlanType to_type(const ResultsNode& node) {
    PlanType t;
    t.name = node.at("name").text();
    t.file = node.at("file").text();
    t.format = node.at("format").text();
    t.manufacturer = node.at("manufacturer").text();
    t.product = node.at("product").text();
    t.catalogue_number = node.at("catalogue_number").text();
    t.lamps = node.at("lamps").text();
    t.symmetry = node.at("symmetry").text();
    t.flux = node.at("flux_lm").number();
    t.reference_flux = node.at("reference_flux_lm").number();
    t.watts = node.at("watts").number();
    t.light_output_ratio = to_optional(node, "light_output_ratio");
    t.downward_share = node.at("downward_share").number();
    t.maximum = node.at("max_candela").number();
    t.maximum_c = node.at("max_at").at("c").number();
    t.maximum_gamma = node.at("max_at").at("gamma").number();
    t.beam_c0 = to_optional(node, "beam_c0");
    t.beam_c90 = to_optional(node, "beam_c90");
    t.opening = to_opening(node.at("opening"));
    t.body = to_opening(node.at("body"));
    t.align_length_axis = node.at("align_length_axis").boolean();
    if (const auto side = node.find("long_side"))
        t.long_side = LongSide{side->at("axis").text() == "y", side->at("length_m").number()};
    t.curves = to_curves(node.at("curves"));
    return t;
}

PlanLuminaire to_luminaire(const ResultsNode& node, const Plan& plan) {
    const std::string type = node.at("type").text();
    std::size_t index = 0;
    while (index < plan.types.size() && plan.types[index].name != type)
        ++index;
    if (index == plan.types.size())
        node.at("type").fail("there is no luminaire type '" + type + "'");
    const Frame frame{node.at("position").point(),
                      node.at("c0").direction(),
                      node.at("c90").direction(),
                      node.at("up").direction()};
    PlanLuminaire l =
        make_plan_luminaire(node.at("name").text(), index, plan.types[index].body, frame);
    l.scale = node.at("scale").number();
    l.group = node.at("group").text();
    return l;
}

std::vector<Polyline> to_lines(const ResultsNode& node) {
    std::vector<Polyline> lines;
    for (const ResultsNode& line : node.items()) {
        const std::vector<double> flat = line.numbers();
        if (flat.size() % 2 != 0)
            line.fail("not pairs of numbers");
        Polyline& points = lines.emplace_back();
        for (std::size_t k = 0; k + 1 < flat.size(); k += 2)
            points.push_back({flat[k], flat[k + 1]});
    }
    return lines;
}

std::vector<PlanOutline> to_outlines(const ResultsNode& node) {
    std::vector<PlanOutline> outlines;
    for (const ResultsNode& o : node.items())
        outlines.push_back({o.at("name").text(),
                            to_lines(o.at("lines")),
                            to_lines(o.at("faces")),
                            o.at("lower").number(),
                            o.at("upper").number()});
    return outlines;
}

} // namespace

std::string to_installation_json(const Plan& plan) {
    Json json{{"luminaire_types", Json::array()}, {"luminaires", Json::array()}};
    for (const PlanType& t : plan.types)
        json["luminaire_types"].push_back(to_json(t));
    for (const PlanLuminaire& l : plan.luminaires)
        json["luminaires"].push_back(to_json(l, plan));
    json["rooms"] = to_json(plan.rooms);
    json["objects"] = to_json(plan.objects);
    json["openings"] = Json::array();
    for (const SceneOpening& o : plan.openings)
        json["openings"].push_back(to_json(o));
    json["finishes"] = Json::array();
    for (const PlanFinish& f : plan.finishes)
        json["finishes"].push_back(to_json(f));
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Plan parse_installation(const ResultsNode& node) {
    Plan plan;
    plan.rooms = to_outlines(node.at("rooms"));
    plan.objects = to_outlines(node.at("objects"));
    if (const auto openings = node.find("openings")) // results of 0.1.0 before November 2026
        for (const ResultsNode& o : openings->items())
            plan.openings.push_back(to_scene_opening(o));
    if (const auto finishes = node.find("finishes"))
        for (const ResultsNode& f : finishes->items())
            plan.finishes.push_back(to_finish(f));
    for (const ResultsNode& t : node.at("luminaire_types").items())
        plan.types.push_back(to_type(t));
    for (const ResultsNode& l : node.at("luminaires").items())
        plan.luminaires.push_back(to_luminaire(l, plan));
    return plan;
}

} // namespace isolux
