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
    r.paths = root.at("paths").count();
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
    return d;
}

ResultsDocument read_results_json(const std::filesystem::path& path) {
    return parse_results_json(read_file_bytes(path, FileLimits::results), path.string());
}

} // namespace isolux
