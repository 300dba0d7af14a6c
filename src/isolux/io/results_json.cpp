#include "isolux/io/results_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "isolux/io/contributions_file.h"
#include "isolux/io/csv.h"
#include "isolux/io/file_name.h"
#include "isolux/io/installation_json.h"
#include "isolux/io/safe_file.h"
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

Json to_json(const SurfaceResult& s, double confidence) {
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
    Json& points = json["points"] = Json::array();
    for (std::size_t i = 0; i < s.points.size(); ++i)
        points.push_back(to_json(s.surface.receivers[i], s.points[i], confidence));
    return json;
}

Json to_json(const ResultsDocument& d) {
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
    json["paths"] = r.paths;
    Json& surfaces = json["surfaces"] = Json::array();
    for (const SurfaceResult& s : r.surfaces)
        surfaces.push_back(to_json(s, r.confidence));
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

/// A value that fits on one line: no members but plain values and lists of plain values.
bool is_one_line(const Json& json) {
    return std::ranges::all_of(json, [](const Json& member) {
        return member.is_primitive()
               || (member.is_array() && std::ranges::all_of(member, [](const Json& m) {
                       return m.is_primitive();
                   }));
    });
}

void append(std::string& text, const Json& json, std::size_t indent) {
    // Names the user gave may hold any bytes; what is no UTF-8 becomes U+FFFD.
    const auto dump = [](const Json& j) {
        return j.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    if (json.is_primitive() || is_one_line(json)) {
        text += dump(json);
        return;
    }
    text += json.is_object() ? '{' : '[';
    bool is_first = true;
    for (const auto& [key, value] : json.items()) {
        text += is_first ? "\n" : ",\n";
        is_first = false;
        text.append(indent + 1, ' ');
        if (json.is_object()) {
            text += dump(Json(key));
            text += ": ";
        }
        append(text, value, indent + 1);
    }
    text += '\n';
    text.append(indent, ' ');
    text += json.is_object() ? '}' : ']';
}

} // namespace

std::string_view isolux_version() noexcept { return ISOLUX_VERSION; }

ResultsDocument
make_results_document(const Project& project, const Settings& settings, Results results) {
    results.notices.insert(
        results.notices.begin(), project.notices.begin(), project.notices.end());
    ResultsDocument document{std::string(isolux_version()),
                             project.name,
                             project.file,
                             project.inputs,
                             settings.seed,
                             settings.tolerance,
                             settings.confidence,
                             std::move(results)};
    document.description = project.description;
    document.absolute_tolerance = settings.absolute_tolerance;
    return document;
}

std::string to_results_json(const ResultsDocument& document) {
    std::string text;
    append(text, to_json(document), 0);
    text += '\n';
    return text;
}

void write_results(const std::filesystem::path& folder, const ResultsDocument& document) {
    make_folder(folder);
    std::vector<std::string> names{"sensitivities"}; // a surface must not take its name
    for (const SurfaceResult& s : document.results.surfaces)
        names.push_back(s.surface.name);
    const std::vector<std::string> stems = file_stems(names);
    for (std::size_t i = 1; i < stems.size(); ++i)
        write_file_safely(
            folder / (stems[i] + ".csv"),
            to_csv(document.results.surfaces[i - 1], document.results.confidence));
    // Those of an earlier run would speak of other lights.
    remove_contributions(folder);
    remove_file(folder / sensitivities_table);
    if (document.results.contributions)
        write_contributions(folder, document.results);
    if (document.results.sensitivities)
        write_file_safely(folder / sensitivities_table, to_sensitivities_csv(document.results));
    write_file_safely(folder / "results.json", to_results_json(document));
}

} // namespace isolux
