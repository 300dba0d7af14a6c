#include "isolux/cli/experiment_filter_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/cli/text_table.h"
#include "isolux/viz/chart.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

/// Largest ratio aimed at, 512 x 512 pixels at 16 rays a pixel, CPU time.
double aim_of(const std::string& name) {
    if (name == "indirect")
        return 15.0;
    return name == "lens" ? 8.0 : 5.0;
}

std::string headline(const FilterComparison& c) {
    return fmt::format("{} x {} pixels, filtered at {} rays a pixel, {} seed{}",
                       c.size.columns,
                       c.size.rows,
                       c.task.samples,
                       c.task.seeds,
                       c.task.seeds == 1 ? "" : "s");
}

std::string plus_minus(const Estimate& e) {
    return fmt::format("{:.3g} +-{:.1g}", e.mean, e.standard_error);
}

/// Mean over the seeds of one of the unfiltered pictures, or of the filtered one.
template <class Value> Estimate over_runs(const FilterComparison& c, const Value& value) {
    std::vector<double> values;
    for (const FilterRun& run : c.runs)
        values.push_back(value(run));
    return estimate_from_replicates(values);
}

Json to_json(const FilterMeasurement& m) {
    return {{"samples", m.samples},
            {"relative_mse", m.relative_mse},
            {"cpu_seconds", m.cpu_seconds},
            {"filter_cpu_seconds", m.filter_seconds}};
}

Json to_json(const Estimate& e) {
    return {{"mean", e.mean}, {"standard_error", e.standard_error}};
}

bool is_any_extrapolated(const FilterComparison& c) {
    for (const FilterRun& run : c.runs)
        if (run.is_extrapolated)
            return true;
    return false;
}

} // namespace

std::string to_text(const FilterComparison& c, const std::string& name) {
    TextTable table({{"picture", Align::left},
                     {"rays a pixel", Align::right},
                     {"relMSE", Align::right},
                     {"CPU/s", Align::right},
                     {"of that filter/s", Align::right}});
    const auto row = [&](const char* picture, std::size_t samples, const auto& of) {
        table.add_row(
            {picture,
             fmt::format("{}", samples),
             plus_minus(over_runs(c, [&](const FilterRun& r) { return of(r).relative_mse; })),
             plus_minus(over_runs(c, [&](const FilterRun& r) { return of(r).cpu_seconds; })),
             fmt::format("{:.2g}", over_runs(c, [&](const FilterRun& r) {
                                       return of(r).filter_seconds;
                                   }).mean)});
    };
    row(
        "filtered", c.runs.front().filtered.samples, [](const FilterRun& r) -> const auto& {
            return r.filtered;
        });
    for (std::size_t k = 0; k < c.runs.front().unfiltered.size(); ++k)
        row(
            "unfiltered",
            c.runs.front().unfiltered[k].samples,
            [k](const FilterRun& r) -> const auto& { return r.unfiltered[k]; });
    std::string text =
        headline(c) + ". +- is one standard error over the seeds.\n\n" + table.text()
        + fmt::format("\nFor the filtered picture's error an unfiltered one needs "
                      "{} times the samples\nand {} times the CPU seconds "
                      "(the aim is {:g} times at 512 x 512).\n",
                      plus_minus(c.sample_ratio),
                      plus_minus(c.time_ratio),
                      aim_of(name));
    if (is_any_extrapolated(c))
        text +=
            "The ratio lies beyond the counts that were rendered: the line through the last "
            "two goes on.\n";
    return text;
}

std::string to_json(const FilterComparison& c, const std::string& name) {
    Json document{{"isolux_experiment_filter", 1},
                  {"version", ISOLUX_VERSION},
                  {"experiment", name},
                  {"columns", c.size.columns},
                  {"rows", c.size.rows},
                  {"samples", c.task.samples},
                  {"reference_factor", c.task.reference_factor},
                  {"reference_noise", c.reference_noise},
                  {"sample_ratio", to_json(c.sample_ratio)},
                  {"time_ratio", to_json(c.time_ratio)},
                  {"is_extrapolated", is_any_extrapolated(c)}};
    document["runs"] = Json::array();
    for (const FilterRun& run : c.runs) {
        Json j{{"seed", run.seed},
               {"filtered", to_json(run.filtered)},
               {"equal_samples", run.equal_samples},
               {"equal_cpu_seconds", run.equal_seconds},
               {"is_extrapolated", run.is_extrapolated}};
        j["unfiltered"] = Json::array();
        for (const FilterMeasurement& m : run.unfiltered)
            j["unfiltered"].push_back(to_json(m));
        document["runs"].push_back(std::move(j));
    }
    return document.dump(2) + "\n";
}

std::string to_csv(const FilterComparison& c) {
    std::string text = "seed,picture,samples,relative_mse,cpu_seconds,filter_cpu_seconds\r\n";
    const auto add = [&](std::uint64_t seed, const char* picture, const FilterMeasurement& m) {
        text += fmt::format("{},{},{},{},{},{}\r\n",
                            seed,
                            picture,
                            m.samples,
                            m.relative_mse,
                            m.cpu_seconds,
                            m.filter_seconds);
    };
    for (const FilterRun& run : c.runs) {
        add(run.seed, "filtered", run.filtered);
        for (const FilterMeasurement& m : run.unfiltered)
            add(run.seed, "unfiltered", m);
    }
    return text;
}

Drawing draw(const FilterComparison& c, const std::string& name) {
    std::vector<Chart> charts(2);
    charts[0].title = "Error over samples";
    charts[0].x_name = "rays a pixel";
    charts[1].title = "Error over time";
    charts[1].x_name = "CPU seconds";
    for (std::size_t i = 0; i < charts.size(); ++i) {
        Chart& chart = charts[i];
        chart.y_name = "relMSE";
        chart.x_scale = chart.y_scale = AxisScale::logarithmic;
        ChartSeries filtered{"filtered", SeriesLook::marks, series_colour(1), {}, {}};
        ChartSeries raw{"unfiltered", SeriesLook::marks, series_colour(0), {}, {}};
        const auto x = [&](const FilterMeasurement& m) {
            return i == 0 ? static_cast<double>(m.samples) : m.cpu_seconds;
        };
        for (const FilterRun& run : c.runs) {
            filtered.points.push_back({x(run.filtered), run.filtered.relative_mse});
            for (const FilterMeasurement& m : run.unfiltered)
                raw.points.push_back({x(m), m.relative_mse});
        }
        chart.series = {std::move(raw), std::move(filtered)};
    }
    return draw_charts("Filtered and unfiltered pictures: " + name, {headline(c)}, charts);
}

} // namespace isolux
