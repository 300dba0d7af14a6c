#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/cli/experiment_filter_report.h"
#include "isolux/cli/text_table.h"
#include "isolux/viz/chart.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

std::string headline(const DenoiseStudy& s) {
    return fmt::format("Cornell box, {} x {} pixels, {} steps of {} rays a pixel, {} seed{}",
                       s.size.columns,
                       s.size.rows,
                       s.task.steps,
                       s.task.step_samples,
                       s.task.seeds,
                       s.task.seeds == 1 ? "" : "s");
}

std::string plus_minus(const Estimate& e) {
    return fmt::format("{:.4g} +-{:.1g}", e.mean, e.standard_error);
}

Json to_json(const Estimate& e) {
    return {{"mean", e.mean}, {"standard_error", e.standard_error}};
}

std::string filter_table(const DenoiseStudy& s, std::size_t f) {
    TextTable table({{"rays", Align::right},
                     {"a own/%", Align::right},
                     {"a first/%", Align::right},
                     {"SSIM", Align::right},
                     {"relMSE", Align::right},
                     {"filter/s", Align::right},
                     {"f samples", Align::right}});
    for (const DenoiseStep& step : s.steps) {
        const DenoisedStep& d = step.filters[f];
        table.add_row({fmt::format("{}", step.samples),
                       plus_minus(d.similarity_to_own),
                       plus_minus(d.similarity_to_first),
                       plus_minus(d.ssim),
                       plus_minus(d.relative_mse),
                       fmt::format("{:.2g}", d.filter_seconds.mean),
                       plus_minus(d.speed_up) + (d.is_extrapolated ? " *" : "")});
    }
    return table.text();
}

} // namespace

std::string to_text(const DenoiseStudy& s) {
    std::string text = headline(s)
                       + ". +- is one standard error over the seeds.\n\n"
                         "Unfiltered against the reference (b), and time to render (e)\n\n";
    TextTable noisy({{"rays", Align::right},
                     {"b SSIM", Align::right},
                     {"b relMSE", Align::right},
                     {"e CPU/s", Align::right}});
    for (const DenoiseStep& step : s.steps)
        noisy.add_row({fmt::format("{}", step.samples),
                       plus_minus(step.ssim),
                       plus_minus(step.relative_mse),
                       plus_minus(step.render_seconds)});
    text += noisy.text();
    for (std::size_t f = 0; f < s.filters.size(); ++f)
        text +=
            fmt::format("\n{} ({}): the earlier study's numbers (a), against the reference, "
                        "and times the samples\nthat the unfiltered picture needs for its "
                        "relMSE (f)\n\n{}\n1/SSIM - 1 of the first number follows "
                        "samples^{:.2f}.\n",
                        s.filters[f],
                        s.filters[f] == "oidn" ? "c" : "d",
                        filter_table(s, f),
                        s.exponents[f]);
    text += "\n* beyond the steps that were rendered: the line through the last two goes on.\n"
            "(a) compares pictures with their own filtered versions: it tells how noisy the "
            "input was,\nnot how good the output is. Only b, c, d and f compare with the "
            "truth.\n";
    if (!s.missing.empty())
        text += "No column c: " + s.missing + "\n";
    return text;
}

std::string to_json(const DenoiseStudy& s) {
    Json document{{"isolux_experiment_denoise", 1},
                  {"version", ISOLUX_VERSION},
                  {"columns", s.size.columns},
                  {"rows", s.size.rows},
                  {"seeds", s.task.seeds},
                  {"reference_factor", s.task.reference_factor},
                  {"reference_noise", s.reference_noise}};
    document["filters"] = Json::array();
    for (std::size_t f = 0; f < s.filters.size(); ++f)
        document["filters"].push_back(
            {{"name", s.filters[f]}, {"exponent_of_similarity", s.exponents[f]}});
    if (!s.missing.empty())
        document["oidn_missing"] = s.missing;
    document["steps"] = Json::array();
    for (const DenoiseStep& step : s.steps) {
        Json j{{"samples", step.samples},
               {"ssim_g11", to_json(step.ssim)},
               {"relative_mse", to_json(step.relative_mse)},
               {"render_cpu_seconds", to_json(step.render_seconds)}};
        j["filters"] = Json::array();
        for (const DenoisedStep& d : step.filters)
            j["filters"].push_back(
                {{"similarity_to_own_percent", to_json(d.similarity_to_own)},
                 {"similarity_to_first_percent", to_json(d.similarity_to_first)},
                 {"ssim_g11", to_json(d.ssim)},
                 {"relative_mse", to_json(d.relative_mse)},
                 {"filter_cpu_seconds", to_json(d.filter_seconds)},
                 {"equal_error_sample_ratio", to_json(d.speed_up)},
                 {"is_extrapolated", d.is_extrapolated}});
        document["steps"].push_back(std::move(j));
    }
    return document.dump(2) + "\n";
}

std::string to_csv(const DenoiseStudy& s) {
    std::string text = "samples,filter";
    for (const char* name : {"own_percent",
                             "first_percent",
                             "ssim_g11",
                             "relative_mse",
                             "cpu_seconds",
                             "sample_ratio"})
        text += fmt::format(",{0},{0}_standard_error", name);
    text += "\r\n";
    const auto add = [&](const Estimate& e) {
        text += fmt::format(",{},{}", e.mean, e.standard_error);
    };
    for (const DenoiseStep& step : s.steps) {
        text += fmt::format("{},none,,,,", step.samples);
        for (const Estimate* e : {&step.ssim, &step.relative_mse, &step.render_seconds})
            add(*e);
        text += ",,\r\n";
        for (std::size_t f = 0; f < s.filters.size(); ++f) {
            const DenoisedStep& d = step.filters[f];
            text += fmt::format("{},{}", step.samples, s.filters[f]);
            for (const Estimate* e : {&d.similarity_to_own,
                                      &d.similarity_to_first,
                                      &d.ssim,
                                      &d.relative_mse,
                                      &d.filter_seconds,
                                      &d.speed_up})
                add(*e);
            text += "\r\n";
        }
    }
    return text;
}

Drawing draw(const DenoiseStudy& s) {
    Chart own;
    own.title = "Similarity of noisy pictures to their own denoised versions";
    own.x_name = "rays a pixel";
    own.y_name = "% of (SSIM + 1)/2";
    own.x_scale = AxisScale::logarithmic;
    Chart error;
    error.title = "Error against the reference";
    error.x_name = own.x_name;
    error.y_name = "relMSE";
    error.x_scale = error.y_scale = AxisScale::logarithmic;
    const auto add = [](ChartSeries& to, std::size_t samples, const Estimate& e) {
        to.points.push_back({static_cast<double>(samples), e.mean});
        to.half_widths.push_back(e.standard_error);
    };
    ChartSeries noisy{"unfiltered", SeriesLook::marks, series_colour(0), {}, {}};
    for (const DenoiseStep& step : s.steps)
        add(noisy, step.samples, step.relative_mse);
    error.series.push_back(std::move(noisy));
    for (std::size_t f = 0; f < s.filters.size(); ++f) {
        ChartSeries percent{s.filters[f], SeriesLook::marks, series_colour(f + 1), {}, {}};
        ChartSeries filtered = percent;
        for (const DenoiseStep& step : s.steps) {
            add(percent, step.samples, step.filters[f].similarity_to_own);
            add(filtered, step.samples, step.filters[f].relative_mse);
        }
        own.series.push_back(std::move(percent));
        error.series.push_back(std::move(filtered));
    }
    return draw_charts("Denoising as samples grow", {headline(s)}, std::array{own, error});
}

} // namespace isolux
