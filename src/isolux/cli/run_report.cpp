#include "isolux/cli/run_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/calc/judge.h"
#include "isolux/cli/terminal.h"
#include "isolux/cli/text_table.h"
#include "isolux/measure/quantity.h"

namespace isolux {

namespace {

/// "1234", "56 thousand", "7.8 million"
std::string format_number(std::uint64_t n) {
    const auto value = static_cast<double>(n);
    if (n < 10'000)
        return fmt::format("{}", n);
    if (value < 1e6)
        return fmt::format("{:.0f} thousand", value / 1e3);
    return fmt::format("{:.1f} million", value / 1e6);
}

std::string format_flux(double lumen) {
    return lumen < 1000.0 ? fmt::format("{:.4g}", lumen) : fmt::format("{:.0f}", lumen);
}

/// Why an error bar deserves less trust, METHODS 3.5.
bool is_flagged(const PointResult& p) noexcept {
    return p.suspicious_replicate || p.heavy_tail || p.near_surface;
}

} // namespace

std::string to_statistics_notes(const Results& results) {
    std::string text;
    bool is_any_flagged = false;
    for (const SurfaceResult& s : results.surfaces)
        is_any_flagged = is_any_flagged || std::ranges::any_of(s.points, is_flagged);
    if (is_any_flagged)
        text += "* an error bar is flagged where one replicate stands apart, the replicates "
                "have heavy tails, or another surface is within 1 mm (column flags of the "
                ".csv)\n";
    return text;
}

std::string format_estimate(const Estimate& e, double confidence) {
    const double half =
        0.5
        * (confidence_interval(e, confidence).upper - confidence_interval(e, confidence).lower);
    if (half <= 1e-9 * std::abs(e.mean))
        return fmt::format("{:.4g}", e.mean);
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, 9);
    return fmt::format("{:.{}f} +-{:.{}f}", e.mean, decimals, half, decimals);
}

std::string to_summary_table(const Results& results) {
    std::vector<TextTable::Column> columns{{"surface", Align::left}, {"points", Align::right}};
    for (const char* head : {"Em [lx]", "Emin [lx]", "Emax [lx]", "U0", "Ud"})
        columns.push_back({head, Align::right});
    columns.push_back({"", Align::left});
    TextTable table(columns);
    for (const SurfaceResult& s : results.surfaces) {
        std::string remark = s.surface.kind == IlluminanceKind::planar
                                 ? ""
                                 : std::string(quantity_name(s.surface.kind));
        if (const auto flagged = std::ranges::count_if(s.points, is_flagged); flagged > 0)
            remark += fmt::format("{}* {} error bar{} flagged",
                                  remark.empty() ? "" : ", ",
                                  flagged,
                                  flagged == 1 ? "" : "s");
        if (!s.converged)
            remark += remark.empty() ? "not converged" : ", not converged";
        std::vector<std::string> cells{s.surface.name, fmt::format("{}", s.points.size())};
        for (const Estimate* e : {&s.summary.mean,
                                  &s.summary.minimum,
                                  &s.summary.maximum,
                                  &s.summary.uniformity,
                                  &s.summary.diversity})
            cells.push_back(format_estimate(*e, results.confidence));
        cells.push_back(remark);
        table.add_row(std::move(cells));
    }
    return table.text();
}

std::string to_run_facts(const Results& results) {
    const FluxBalance& flux = results.flux_balance;
    std::string text =
        fmt::format("+- is half the {:g} % confidence interval\n", 100.0 * results.confidence);
    if (flux.absorbed.samples == 0) {
        text += fmt::format("flux: {} lm emitted; not followed (direct light only)\n",
                            format_flux(flux.emitted.mean));
    } else {
        const double left = flux.emitted.mean - flux.absorbed.mean - flux.escaped.mean;
        text += fmt::format("flux: {} lm emitted = {} lm absorbed + {} lm escaped, {:.2f} % "
                            "unaccounted for\n",
                            format_flux(flux.emitted.mean),
                            format_estimate(flux.absorbed, results.confidence),
                            format_estimate(flux.escaped, results.confidence),
                            flux.emitted.mean > 0.0 ? 100.0 * left / flux.emitted.mean : 0.0);
    }
    text += fmt::format(
        "time: {} ({} of processor time); {} rays, {} light paths\n",
        format_seconds(results.wall_seconds),
        format_seconds(results.cpu_seconds),
        format_number(results.rays.path + results.rays.shadow + results.rays.gather),
        format_number(results.paths));
    return text;
}

std::string to_maintenance_line(const std::vector<ScheduleEntry>& schedule) {
    std::vector<double> factors;
    for (const ScheduleEntry& e : schedule)
        if (e.count > 0 && std::ranges::find(factors, e.maintenance.value) == factors.end())
            factors.push_back(e.maintenance.value);
    if (factors.empty())
        return {};
    if (factors.size() == 1 && factors.front() == 1.0)
        return "values are initial ones: the maintenance factor is 1\n";
    std::string text;
    for (const double f : factors)
        text += fmt::format("{}{:.4g}", text.empty() ? "" : ", ", f);
    return fmt::format("values are maintained ones: maintenance factor {}\n", text);
}

std::string to_scene_lines(const Results& results) {
    std::string text;
    for (const SceneResult& scene : results.scenes) {
        text += "scene " + scene.name + ":";
        for (std::size_t s = 0; s < scene.surfaces.size(); ++s)
            text += fmt::format("{} {} Em {} lx",
                                s == 0 ? "" : ",",
                                results.surfaces[s].surface.name,
                                format_estimate(scene.surfaces[s].mean, results.confidence));
        if (!scene.verdicts.empty())
            text += fmt::format("; verdict {}", to_word(overall(scene.verdicts)));
        text += "\n";
    }
    return text.empty() ? text : text + "`isolux scenes` tells more of them\n";
}

} // namespace isolux
