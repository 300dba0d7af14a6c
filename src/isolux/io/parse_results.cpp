#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "isolux/io/installation_json.h"
#include "isolux/io/results_json.h"
#include "isolux/io/results_node.h"
#include "isolux/io/text_file.h"
#include "isolux/measure/quantity.h"

namespace isolux {

namespace {

using Json = nlohmann::json;

using Node = ResultsNode;

InputFile to_input_file(const Node& node) {
    return {node.at("file").text(), node.at("sha256").text()};
}

Message to_message(const Node& node) {
    return {node.at("where").text(), node.at("what").text(), node.at("hint").text()};
}

GridLayout to_grid(const Node& node) {
    GridLayout g;
    g.frame.origin = node.at("origin").point();
    g.frame.x = node.at("x").direction();
    g.frame.y = node.at("y").direction();
    g.frame.z = UnitVector3(cross(g.frame.x, g.frame.y));
    g.width = node.at("width").number();
    g.height = node.at("height").number();
    g.counts = {node.at("columns").count(), node.at("rows").count()};
    for (const Node& cell : node.at("cells").items()) {
        if (cell.count() / g.counts.columns >= g.counts.rows)
            cell.fail("beyond the last cell");
        g.cell_of_point.push_back(cell.count());
    }
    return g;
}

PointResult to_point(const Node& node) {
    PointResult p;
    p.total = node.estimate();
    p.direct = {
        node.at("direct").number(), node.at("direct_standard_error").number(), p.total.samples};
    p.indirect = {node.at("indirect").number(),
                  node.at("indirect_standard_error").number(),
                  p.total.samples};
    for (const Node& flag : node.at("flags").items()) {
        const std::string word = flag.text();
        p.suspicious_replicate |= word == "suspicious_replicate";
        p.heavy_tail |= word == "heavy_tail";
        p.near_surface |= word == "near_surface";
    }
    return p;
}

SurfaceSummary to_summary(const Node& node) {
    return {node.at("mean").estimate(),
            node.at("minimum").estimate(),
            node.at("maximum").estimate(),
            node.at("U0").estimate(),
            node.at("Ud").estimate(),
            node.at("minimum").at("plug_in").number(),
            node.at("maximum").at("plug_in").number()};
}

SurfaceResult to_surface(const Node& node) {
    SurfaceResult s;
    s.surface.name = node.at("name").text();
    const Node quantity = node.at("quantity");
    const std::optional<IlluminanceKind> kind = find_quantity(quantity.text());
    if (!kind)
        quantity.fail("unknown quantity '" + quantity.text() + "'");
    s.surface.kind = *kind;
    s.converged = node.at("converged").boolean();
    if (const std::optional<Node> outline = node.find("outline"))
        for (const Node& p : outline->items())
            s.surface.outline.push_back(p.point());
    s.summary = to_summary(node.at("summary"));
    for (const Node& p : node.at("points").items()) {
        Receiver r{p.at("position").point(), p.at("normal").direction(), *kind};
        if (const std::optional<Node> facing = p.find("facing"))
            r.reference = facing->direction();
        s.surface.receivers.push_back(r);
        s.points.push_back(to_point(p));
    }
    if (const std::optional<Node> grid = node.find("grid")) {
        s.surface.grid = to_grid(*grid);
        if (s.surface.grid->cell_of_point.size() != s.points.size())
            grid->at("cells").fail("as many cells as points are needed");
    }
    return s;
}

template <class Word> Word to_enumerator(const Node& node) {
    if (const std::optional<Word> word = find_word<Word>(node.text()))
        return *word;
    node.fail("unknown word '" + node.text() + "'");
}

Requirement to_requirement(const Node& n) {
    return {n.at("standard").text(),
            n.at("row").text(),
            n.at("clause").text(),
            n.at("task").text(),
            n.at("symbol").text(),
            n.at("name").text(),
            to_enumerator<RequiredQuantity>(n.at("quantity")),
            to_enumerator<LightShare>(n.at("light")),
            to_enumerator<RequiredArea>(n.at("area")),
            to_enumerator<Statistic>(n.at("statistic")),
            to_enumerator<Sense>(n.at("sense")),
            n.at("limit").number(),
            n.at("unit").text(),
            n.at("recommendation").boolean(),
            n.at("source").text(),
            n.at("recalled").boolean()};
}

Verdict to_verdict(const Node& n) {
    Verdict v;
    v.requirement = to_requirement(n);
    v.subject = n.at("subject").text();
    v.decision = to_enumerator<Decision>(n.at("decision"));
    v.reason = n.at("reason").text();
    if (v.decision == Decision::not_judged)
        return v;
    v.value = n.estimate();
    v.interval = {n.at("lower").number(), n.at("upper").number()};
    v.margin = n.at("margin").number();
    v.least_margin = n.at("least_margin").number();
    return v;
}

std::size_t surface_named(const Node& name, const Results& r) {
    for (std::size_t s = 0; s < r.surfaces.size(); ++s)
        if (r.surfaces[s].surface.name == name.text())
            return s;
    name.fail("there is no surface '" + name.text() + "'");
}

ModellingResult to_modelling(const Node& n, const Results& r) {
    ModellingResult m{surface_named(n.at("cylindrical"), r),
                      surface_named(n.at("horizontal"), r),
                      {},
                      n.at("mean").estimate(),
                      n.at("minimum").estimate(),
                      n.at("maximum").estimate()};
    for (const Node& p : n.at("points").items())
        m.points.push_back(p.estimate());
    return m;
}

GlareRating to_rating(const Node& n) {
    GlareRating g;
    g.sources = n.at("sources").count();
    g.source_sum = n.at("source_sum").number();
    g.reason = n.at("reason").text();
    if (n.find("value"))
        g.value = n.estimate();
    g.background = {n.at("background").number(),
                    n.at("background_standard_error").number(),
                    g.value.samples};
    return g;
}

ObserverGroupResult to_observers(const Node& n) {
    ObserverGroupResult o;
    o.group.name = n.at("name").text();
    o.group.scale = n.at("rating").text() == "GR" ? GlareScale::outdoor : GlareScale::unified;
    o.group.sources =
        n.at("sources").text() == "in table" ? GlareSources::in_table : GlareSources::in_front;
    o.group.room = n.at("room").text();
    if (const std::optional<Node> worst = n.find("worst"))
        o.worst = worst->count();
    if (const std::optional<Node> table = n.find("by_table"))
        o.by_table = table->number();
    o.table_note = n.at("table_note").text();
    for (const Node& i : n.at("observers").items()) {
        o.group.sight_lines.push_back(
            {i.at("position").point(), i.at("direction").direction()});
        o.ratings.push_back(to_rating(i));
    }
    if (o.worst && *o.worst >= o.ratings.size())
        n.at("worst").fail("beyond the last observer");
    return o;
}

EnergyResult to_energy(const Node& n) {
    EnergyResult e;
    e.room = n.at("room").text();
    e.floor_area = n.at("floor_area").number();
    e.reason = n.at("reason").text();
    const std::optional<Node> watts = n.find("watts");
    if (!watts)
        return e;
    e.watts = watts->number();
    e.density = n.at("density").number();
    e.surface = n.at("surface").text();
    if (const std::optional<Node> per = n.find("density_per_100_lux"))
        e.density_per_100_lux = per->estimate();
    if (const std::optional<Node> leni = n.find("leni"))
        e.leni = leni->number();
    return e;
}

SceneResult to_scene(const Node& n) {
    SceneResult scene;
    scene.name = n.at("name").text();
    for (const Node& f : n.at("factors").items())
        scene.factors.push_back(f.number());
    if (const std::optional<Node> watts = n.find("watts"))
        scene.watts = watts->number();
    for (const Node& s : n.at("surfaces").items())
        scene.surfaces.push_back(to_summary(s.at("summary")));
    for (const Node& v : n.at("verdicts").items())
        scene.verdicts.push_back(to_verdict(v));
    return scene;
}

ScheduleEntry to_schedule_entry(const Node& n) {
    ScheduleEntry e;
    e.type = n.at("type").text();
    e.file = n.at("file").text();
    e.manufacturer = n.at("manufacturer").text();
    e.product = n.at("product").text();
    e.count = n.at("count").count();
    e.flux = n.at("flux").number();
    if (const std::optional<Node> watts = n.find("watts"))
        e.watts = watts->number();
    if (const std::optional<Node> ra = n.find("colour_rendering"))
        e.colour_rendering = ra->number();
    e.maintenance.value = n.at("maintenance_factor").number();
    if (const std::optional<Node> parts = n.find("maintenance_parts"))
        e.maintenance = {e.maintenance.value,
                         true,
                         parts->at("LLMF").number(),
                         parts->at("LSF").number(),
                         parts->at("LMF").number(),
                         parts->at("RSMF").number()};
    return e;
}

Results to_results(const Node& root) {
    Results r;
    for (const Node& s : root.at("surfaces").items())
        r.surfaces.push_back(to_surface(s));
    const Node flux = root.at("flux_balance");
    r.flux_balance = {flux.at("emitted").estimate(),
                      flux.at("absorbed").estimate(),
                      flux.at("escaped").estimate()};
    const Node rays = root.at("rays_by_kind");
    r.rays = {rays.at("path").count(), rays.at("shadow").count(), rays.at("gather").count()};
    r.wall_seconds = root.at("time").at("wall_s").number();
    r.cpu_seconds = root.at("time").at("cpu_s").number();
    r.converged = root.at("converged").boolean();
    r.interrupted = root.at("interrupted").boolean();
    r.replicates = root.at("replicates").count();
    r.units = root.at("units").count();
    r.looks = root.at("looks").count();
    r.paths = root.at("paths").count();
    for (const Node& v : root.at("verdicts").items())
        r.verdicts.push_back(to_verdict(v));
    for (const Node& m : root.at("modelling").items())
        r.modelling.push_back(to_modelling(m, r));
    for (const Node& o : root.at("observers").items())
        r.observers.push_back(to_observers(o));
    for (const Node& e : root.at("energy").items())
        r.energy.push_back(to_energy(e));
    for (const Node& s : root.at("scenes").items()) {
        r.scenes.push_back(to_scene(s));
        if (r.scenes.back().surfaces.size() != r.surfaces.size())
            s.at("surfaces").fail("as many as the results have are needed");
    }
    r.estimator = root.at("estimator").text();
    r.confidence = root.at("interval_confidence").number();
    for (const Node& m : root.at("notices").items())
        r.notices.push_back(to_message(m));
    return r;
}

/// `source:line:column` of a byte.
std::string place_of(std::string_view text, std::size_t byte, const std::string& source) {
    std::size_t line = 1;
    std::size_t column = 1;
    for (const char c : text.substr(0, byte)) {
        column = c == '\n' ? 1 : column + 1;
        line += c == '\n' ? 1U : 0U;
    }
    return source + ":" + std::to_string(line) + ":" + std::to_string(column);
}

} // namespace

ResultsDocument parse_results_json(std::string_view text, std::string_view source) {
    const std::string name(source);
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::parse_error& error) {
        throw InputError(place_of(text, error.byte > 0 ? error.byte - 1 : 0, name),
                         "this is not JSON",
                         "Truncated file?");
    }
    const Node root(&json, name);
    if (root.at("isolux_results").count() != 1)
        root.at("isolux_results").fail("this format is not version 1");
    const Node project = root.at("project");
    ResultsDocument d;
    d.version = root.at("version").text();
    d.project_name = project.at("name").text();
    d.project = to_input_file(project);
    for (const Node& f : root.at("inputs").items())
        d.inputs.push_back(to_input_file(f));
    d.seed = root.at("seed").count();
    d.tolerance = root.at("tolerance").number();
    d.confidence = root.at("confidence").number();
    d.results = to_results(root);
    if (const auto description = project.find("description"))
        d.description = description->text();
    if (const auto tolerance = root.find("absolute_tolerance"))
        d.absolute_tolerance = tolerance->number();
    if (const auto date = root.at("time").find("date"))
        d.date = date->text();
    if (const auto installation = root.find("installation"))
        d.plan = parse_installation(*installation);
    for (const Node& e : root.at("schedule").items())
        d.schedule.push_back(to_schedule_entry(e));
    return d;
}

ResultsDocument read_results_json(const std::filesystem::path& path) {
    return parse_results_json(read_file_bytes(path, FileLimits::results), path.string());
}

} // namespace isolux
