#include <algorithm>

#include <fmt/format.h>

#include "isolux/measure/quantity.h"
#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"
#include "isolux/viz/map.h"

namespace isolux::report {

namespace {

/// Longer lists belong into the CSV file.
constexpr std::size_t most_points = 1500;

constexpr double highest_map = 180.0; // mm, so that it fits below the title and the figures

std::vector<Cell> figure_row(const std::string& name, const Estimate& e, double confidence) {
    const Interval interval = confidence_interval(e, confidence);
    return {
        {name}, number_cell(e.mean), number_cell(interval.lower), number_cell(interval.upper)};
}

Table make_figures(const SurfaceResult& s, double confidence, const Texts& t) {
    Table table{t.figures_caption,
                {{t.quantity}, {t.value, true}, {t.lower, true}, {t.upper, true}},
                {}};
    table.rows = {figure_row(t.mean + ", " + t.lux, s.summary.mean, confidence),
                  figure_row(t.minimum + ", " + t.lux, s.summary.minimum, confidence),
                  figure_row(t.maximum + ", " + t.lux, s.summary.maximum, confidence),
                  figure_row(t.uniformity, s.summary.uniformity, confidence),
                  figure_row(t.diversity, s.summary.diversity, confidence)};
    return table;
}

bool is_flagged(const PointResult& p) {
    return p.suspicious_replicate || p.heavy_tail || p.near_surface;
}

Table make_values(const SurfaceResult& s, double confidence, const Texts& t) {
    Table table{fill(t.values_caption, {s.surface.name, t.lux}),
                {{t.point},
                 {"x", true},
                 {"y", true},
                 {"z", true},
                 {t.value, true},
                 {t.lower, true},
                 {t.upper, true},
                 {t.direct, true},
                 {t.indirect, true}},
                {},
                true};
    for (std::size_t k = 0; k < std::min(most_points, s.points.size()); ++k) {
        const PointResult& p = s.points[k];
        const Point3& at = s.surface.receivers[k].point;
        const Interval interval = confidence_interval(p.total, confidence);
        table.rows.push_back({{fmt::format("{}{}", k + 1, is_flagged(p) ? "*" : "")},
                              {fmt::format("{:.3f}", at.x), at.x},
                              {fmt::format("{:.3f}", at.y), at.y},
                              {fmt::format("{:.3f}", at.z), at.z},
                              number_cell(p.total.mean),
                              number_cell(interval.lower),
                              number_cell(interval.upper),
                              number_cell(p.direct.mean),
                              number_cell(p.indirect.mean)});
    }
    return table;
}

Figure make_map(const SurfaceResult& s, const ResultsDocument& d, const Texts& t) {
    const MapNotes notes{
        d.project_name, d.results.confidence, d.tolerance, d.absolute_tolerance, widest_map};
    return {draw_map(s, d.plan, notes),
            fill(t.map_alternative,
                 {std::string(quantity_name(s.surface.kind)),
                  s.surface.name,
                  to_digits(s.summary.mean.mean),
                  to_digits(s.summary.minimum.mean),
                  to_digits(s.summary.maximum.mean)}),
            fill(t.map_caption, {s.surface.name}),
            Figure{}.largest_width,
            highest_map};
}

} // namespace

Section make_surface_section(const ResultsDocument& d, std::size_t index, const Texts& t) {
    const SurfaceResult& s = d.results.surfaces[index];
    Section section{fmt::format("surface-{}", index + 1),
                    fill(t.surface_title, {s.surface.name}),
                    {},
                    false,
                    true};
    if (!s.converged)
        section.blocks.emplace_back(Paragraph{t.not_reached, Mark::undecided});
    section.blocks.emplace_back(make_figures(s, d.results.confidence, t));
    section.blocks.emplace_back(make_map(s, d, t));
    section.blocks.emplace_back(make_values(s, d.results.confidence, t));
    if (s.points.size() > most_points)
        section.blocks.emplace_back(Paragraph{
            fill(t.values_cut, {std::to_string(most_points), std::to_string(s.points.size())}),
            Mark::none,
            true});
    if (std::any_of(s.points.begin(), s.points.end(), is_flagged))
        section.blocks.emplace_back(Paragraph{t.flag_note, Mark::none, true});
    return section;
}

} // namespace isolux::report
