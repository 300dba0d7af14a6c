#include "isolux/io/results_json.h"

#include <algorithm>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "isolux/calc/judge.h"
#include "isolux/io/installation_json.h"
#include "isolux/io/json_text.h"
#include "isolux/measure/quantity.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json; // members stay in the order a reader expects them

Json to_json(const Vector3& v) { return Json::array({v.x, v.y, v.z}); }

Json to_json(const Point3& p) { return Json::array({p.x, p.y, p.z}); }

Json to_json(const InputFile& f) { return {{"file", f.file}, {"sha256", f.sha256}}; }

Json to_json(const Message& m) {
    return {{"where", m.where}, {"what", m.what}, {"hint", m.hint}};
}

Json to_json(const Estimate& e, double confidence) {
    const Interval interval = confidence_interval(e, confidence);
    return {{"value", e.mean},
            {"standard_error", e.standard_error},
            {"lower", interval.lower},
            {"upper", interval.upper},
            {"replicates", e.samples}};
}

Json to_json(const SurfaceSummary& s, double confidence) {
    Json minimum = to_json(s.minimum, confidence);
    minimum["plug_in"] = s.plug_in_minimum;
    Json maximum = to_json(s.maximum, confidence);
    maximum["plug_in"] = s.plug_in_maximum;
    return {{"mean", to_json(s.mean, confidence)},
            {"minimum", std::move(minimum)},
            {"maximum", std::move(maximum)},
            {"U0", to_json(s.uniformity, confidence)},
            {"Ud", to_json(s.diversity, confidence)}};
}

Json to_json(const GridLayout& g) {
    return {{"columns", g.counts.columns},
            {"rows", g.counts.rows},
            {"origin", to_json(g.frame.origin)},
            {"x", to_json(Vector3(g.frame.x))},
            {"y", to_json(Vector3(g.frame.y))},
            {"width", g.width},
            {"height", g.height},
            {"cells", g.cell_of_point}};
}

Json to_json(const Receiver& r, const PointResult& p, double confidence) {
    Json json{{"position", to_json(r.point)}, {"normal", to_json(Vector3(r.axis))}};
    if (r.kind == IlluminanceKind::semi_cylindrical)
        json["facing"] = to_json(Vector3(r.reference));
    json.update(to_json(p.total, confidence));
    json["direct"] = p.direct.mean;
    json["direct_standard_error"] = p.direct.standard_error;
    json["indirect"] = p.indirect.mean;
    json["indirect_standard_error"] = p.indirect.standard_error;
    Json flags = Json::array();
    if (p.suspicious_replicate)
        flags.push_back("suspicious_replicate");
    if (p.heavy_tail)
        flags.push_back("heavy_tail");
    if (p.near_surface)
        flags.push_back("near_surface");
    json["flags"] = std::move(flags);
    return json;
}

/// Without its points.
Json head_of(const SurfaceResult& s, double confidence) {
    Json json{{"name", s.surface.name},
              {"quantity", quantity_name(s.surface.kind)},
              {"unit", "lx"},
              {"converged", s.converged}};
    if (s.surface.grid)
        json["grid"] = to_json(*s.surface.grid);
    if (!s.surface.outline.empty()) {
        Json& outline = json["outline"] = Json::array();
        for (const Point3& p : s.surface.outline)
            outline.push_back(to_json(p));
    }
    json["summary"] = to_json(s.summary, confidence);
    return json;
}

Json to_json(const Verdict& v) {
    const Requirement& r = v.requirement;
    Json json{{"standard", r.standard},
              {"row", r.row},
              {"clause", r.clause},
              {"task", r.task},
              {"symbol", r.symbol},
              {"name", r.name},
              {"quantity", to_word(r.quantity)},
              {"light", to_word(r.light)},
              {"area", to_word(r.area)},
              {"statistic", to_word(r.statistic)},
              {"sense", to_word(r.sense)},
              {"limit", r.limit},
              {"unit", r.unit},
              {"recommendation", r.is_recommendation},
              {"source", r.source},
              {"recalled", r.is_recalled},
              {"subject", v.subject},
              {"decision", to_word(v.decision)},
              {"reason", v.reason}};
    if (v.decision == Decision::not_judged)
        return json;
    json["value"] = v.value.mean;
    json["standard_error"] = v.value.standard_error;
    json["lower"] = v.interval.lower;
    json["upper"] = v.interval.upper;
    json["replicates"] = v.value.samples;
    json["margin"] = v.margin;
    json["least_margin"] = v.least_margin;
    return json;
}

/// Without its points.
Json head_of(const ModellingResult& m, const Results& r) {
    return {{"cylindrical", r.surfaces[m.cylindrical].surface.name},
            {"horizontal", r.surfaces[m.horizontal].surface.name},
            {"mean", to_json(m.mean, r.confidence)},
            {"minimum", to_json(m.minimum, r.confidence)},
            {"maximum", to_json(m.maximum, r.confidence)}};
}

Json to_json(const ScheduleEntry& e) {
    Json json{{"type", e.type},
              {"file", e.file},
              {"manufacturer", e.manufacturer},
              {"product", e.product},
              {"count", e.count},
              {"flux", e.flux}};
    if (e.watts)
        json["watts"] = *e.watts;
    if (e.colour_rendering)
        json["colour_rendering"] = *e.colour_rendering;
    json["maintenance_factor"] = e.maintenance.value;
    if (e.maintenance.has_parts)
        json["maintenance_parts"] = {{"LLMF", e.maintenance.lamp_flux},
                                     {"LSF", e.maintenance.lamp_survival},
                                     {"LMF", e.maintenance.luminaire},
                                     {"RSMF", e.maintenance.room_surface}};
    return json;
}

Json to_json(const GlareRating& g, const SightLine& line, double confidence) {
    Json json{{"sources", g.sources},
              {"position", to_json(line.eye)},
              {"direction", to_json(Vector3(line.direction))},
              {"source_sum", g.source_sum},
              {"reason", g.reason}};
    json["background"] = g.background.mean;
    json["background_standard_error"] = g.background.standard_error;
    if (g.value.samples > 0)
        json.update(to_json(g.value, confidence));
    return json;
}

Json to_json(const ObserverGroupResult& o, double confidence) {
    const ObserverGroup& g = o.group;
    Json json{{"name", g.name},
              {"rating", g.scale == GlareScale::unified ? "UGR" : "GR"},
              {"sources", g.sources == GlareSources::in_front ? "in front" : "in table"},
              {"room", g.room}};
    if (o.worst)
        json["worst"] = *o.worst;
    if (o.by_table)
        json["by_table"] = *o.by_table;
    json["table_note"] = o.table_note;
    Json& observers = json["observers"] = Json::array();
    for (std::size_t i = 0; i < o.ratings.size(); ++i)
        observers.push_back(to_json(o.ratings[i], g.sight_lines[i], confidence));
    return json;
}

Json to_json(const EnergyResult& e, double confidence) {
    Json json{{"room", e.room}, {"floor_area", e.floor_area}, {"reason", e.reason}};
    if (!e.watts)
        return json;
    json["watts"] = *e.watts;
    json["density"] = e.density;
    json["surface"] = e.surface;
    if (e.density_per_100_lux.samples > 0)
        json["density_per_100_lux"] = to_json(e.density_per_100_lux, confidence);
    if (e.leni)
        json["leni"] = *e.leni;
    return json;
}

Json to_json(const SceneResult& scene, const Results& r) {
    Json json{{"name", scene.name}, {"factors", scene.factors}};
    if (scene.watts)
        json["watts"] = *scene.watts;
    json["verdict"] = to_word(overall(scene.verdicts));
    Json& surfaces = json["surfaces"] = Json::array();
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
        surfaces.push_back({{"name", r.surfaces[s].surface.name},
                            {"summary", to_json(scene.surfaces[s], r.confidence)}});
    Json& verdicts = json["verdicts"] = Json::array();
    for (const Verdict& v : scene.verdicts)
        verdicts.push_back(to_json(v));
    return json;
}

/// What comes before the surfaces.
Json head_of(const ResultsDocument& d) {
    const Results& r = d.results;
    Json json{{"isolux_results", 1}, {"version", d.version}};
    json["project"] = {
        {"name", d.project_name}, {"file", d.project.file}, {"sha256", d.project.sha256}};
    if (!d.description.empty())
        json["project"]["description"] = d.description;
    Json& inputs = json["inputs"] = Json::array();
    for (const InputFile& f : d.inputs)
        inputs.push_back(to_json(f));
    json["seed"] = d.seed;
    json["tolerance"] = d.tolerance;
    json["absolute_tolerance"] = d.absolute_tolerance;
    json["confidence"] = d.confidence;
    json["interval_confidence"] = r.confidence;
    json["converged"] = r.converged;
    json["interrupted"] = r.interrupted;
    json["estimator"] = r.estimator;
    json["replicates"] = r.replicates;
    json["units"] = r.units;
    json["looks"] = r.looks;
    json["paths"] = r.paths;
    json["verdict"] = to_word(overall(r.verdicts));
    Json& verdicts = json["verdicts"] = Json::array();
    for (const Verdict& v : r.verdicts)
        verdicts.push_back(to_json(v));
    Json& schedule = json["schedule"] = Json::array();
    for (const ScheduleEntry& e : d.schedule)
        schedule.push_back(to_json(e));
    return json;
}

/// What comes after the points of surfaces and of modelling.
Json tail_of(const ResultsDocument& d) {
    const Results& r = d.results;
    Json json;
    Json& observers = json["observers"] = Json::array();
    for (const ObserverGroupResult& o : r.observers)
        observers.push_back(to_json(o, r.confidence));
    Json& energy = json["energy"] = Json::array();
    for (const EnergyResult& e : r.energy)
        energy.push_back(to_json(e, r.confidence));
    Json& scenes = json["scenes"] = Json::array();
    for (const SceneResult& scene : r.scenes)
        scenes.push_back(to_json(scene, r));
    json["flux_balance"] = {{"emitted", to_json(r.flux_balance.emitted, r.confidence)},
                            {"absorbed", to_json(r.flux_balance.absorbed, r.confidence)},
                            {"escaped", to_json(r.flux_balance.escaped, r.confidence)}};
    json["rays"] = r.rays.path + r.rays.shadow + r.rays.gather;
    json["rays_by_kind"] = {
        {"path", r.rays.path}, {"shadow", r.rays.shadow}, {"gather", r.rays.gather}};
    json["installation"] = Json::parse(to_installation_json(d.plan));
    Json& notices = json["notices"] = Json::array();
    for (const Message& m : r.notices)
        notices.push_back(to_json(m));
    json["time"] = {{"wall_s", r.wall_seconds}, {"cpu_s", r.cpu_seconds}};
    if (!d.date.empty())
        json["time"]["date"] = d.date;
    return json;
}

void write(JsonText& json, const SurfaceResult& s, double confidence) {
    json.begin('{');
    json.members(head_of(s, confidence));
    json.list(Json("points"), s.points.size(), [&](std::size_t i) {
        json.value(to_json(s.surface.receivers[i], s.points[i], confidence));
    });
    json.end('}');
}

void write(JsonText& json, const ModellingResult& m, const Results& r) {
    json.begin('{');
    json.members(head_of(m, r));
    json.list(Json("points"), m.points.size(), [&](std::size_t i) {
        json.value(to_json(m.points[i], r.confidence));
    });
    json.end('}');
}

} // namespace

std::string to_results_json(const ResultsDocument& document) {
    const Results& r = document.results;
    JsonText json;
    json.begin('{');
    json.members(head_of(document));
    json.list(Json("surfaces"), r.surfaces.size(), [&](std::size_t i) {
        write(json, r.surfaces[i], r.confidence);
    });
    json.list(Json("modelling"), r.modelling.size(), [&](std::size_t i) {
        write(json, r.modelling[i], r);
    });
    json.members(tail_of(document));
    json.end('}');
    return std::move(json).finish();
}

} // namespace isolux
