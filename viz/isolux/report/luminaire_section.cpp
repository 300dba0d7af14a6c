#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/calc/long_side.h"
#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"
#include "isolux/viz/intensity_diagrams.h"

namespace isolux::report {

namespace {

std::vector<Frame> frames_of(const Plan& plan, std::size_t type) {
    std::vector<Frame> frames;
    for (const PlanLuminaire& l : plan.luminaires)
        if (l.type == type)
            frames.push_back(l.frame);
    return frames;
}

std::string product_of(const PlanType& t) {
    std::string words;
    for (const std::string& part : {t.manufacturer, t.product})
        if (!part.empty())
            words += (words.empty() ? "" : ", ") + part;
    return words.empty() ? t.symmetry : words;
}

Cell watts_cell(double watts, const Texts& t) {
    return watts > 0.0 ? number_cell(watts) : Cell{t.not_stated};
}

Table make_schedule(const Plan& plan, const Texts& t) {
    Table table{t.schedule_caption,
                {{t.number},
                 {t.type},
                 {t.product},
                 {t.count, true},
                 {t.flux_each, true},
                 {t.flux_all, true},
                 {t.watts_each, true},
                 {t.watts_all, true}},
                {}};
    double count = 0.0;
    double flux = 0.0;
    double watts = 0.0;
    bool is_known = true;
    for (std::size_t k = 0; k < plan.types.size(); ++k) {
        const PlanType& type = plan.types[k];
        const auto n = static_cast<double>(frames_of(plan, k).size());
        if (n == 0.0)
            continue;
        table.rows.push_back({{std::to_string(k + 1)},
                              {type.name},
                              {product_of(type)},
                              {fmt::format("{:.0f}", n), n},
                              {fmt::format("{:.0f}", type.flux), type.flux},
                              {fmt::format("{:.0f}", n * type.flux), n * type.flux},
                              watts_cell(type.watts, t),
                              watts_cell(n * type.watts, t)});
        count += n;
        flux += n * type.flux;
        watts += n * type.watts;
        is_known = is_known && type.watts > 0.0;
    }
    table.rows.push_back({{t.total},
                          {},
                          {},
                          {fmt::format("{:.0f}", count), count},
                          {},
                          {fmt::format("{:.0f}", flux), flux},
                          {},
                          is_known ? number_cell(watts) : Cell{t.not_stated}});
    return table;
}

std::string degrees_or(const std::optional<double>& angle, const Texts& t) {
    return angle ? fmt::format("{:.0f}°", *angle) : t.not_stated;
}

void add(FactList& list, const std::string& name, const std::string& value) {
    if (!value.empty())
        list.rows.push_back({{name}, {value}});
}

/// 0.6 × 0.6 × 0.08 m; the height only where there is one.
std::string size_in_words(const LuminousOpening& o) {
    std::string size =
        fmt::format("{:.3g} × {:.3g}", in_metre(o.extent_x), in_metre(o.extent_y));
    if (in_metre(o.extent_z) > 0.0)
        size += fmt::format(" × {:.3g}", in_metre(o.extent_z));
    return size + " m";
}

FactList make_facts(const Plan& plan, std::size_t k, const Texts& t) {
    const PlanType& type = plan.types[k];
    FactList list{fill(t.facts_caption, {std::to_string(k + 1), type.name}), {}};
    add(list, t.product, type.product);
    add(list, t.manufacturer, type.manufacturer);
    add(list, t.catalogue_number, type.catalogue_number);
    add(list, t.file, type.file.empty() ? "" : fmt::format("{} ({})", type.file, type.format));
    add(list, t.lamps, type.lamps);
    list.rows.push_back({{t.flux}, {fmt::format("{:.0f} lm", type.flux), type.flux}});
    if (type.watts > 0.0)
        add(list,
            t.power,
            fill(t.power_value,
                 {to_digits(type.watts), fmt::format("{:.0f}", type.flux / type.watts)}));
    if (type.light_output_ratio)
        add(list,
            t.light_output_ratio,
            fmt::format("{:.1f} %", 100.0 * *type.light_output_ratio));
    add(list, t.downward_share, fmt::format("{:.1f} %", 100.0 * type.downward_share));
    add(list,
        t.largest_intensity,
        fill(t.largest_intensity_value,
             {to_digits(type.maximum),
              fmt::format("{:.4g}", type.maximum_c),
              fmt::format("{:.4g}", type.maximum_gamma)}));
    add(list,
        t.beam,
        fill(t.beam_value, {degrees_or(type.beam_c0, t), degrees_or(type.beam_c90, t)}));
    if (type.body.shape != OpeningShape::point)
        add(list, t.body, size_in_words(type.body));
    std::string side = describe_long_side(type.long_side, frames_of(plan, k));
    if (type.align_length_axis)
        side += "; " + t.aligned;
    add(list, t.long_side, side);
    return list;
}

FactSheet make_sheet(const Plan& plan, std::size_t k, const Texts& t) {
    const PlanType& type = plan.types[k];
    constexpr double size = 72.0; // mm
    FactSheet sheet;
    sheet.figure.drawing =
        make_polar_picture(type.curves, fill(t.polar_caption, {type.name}), size);
    sheet.figure.alternative = fill(t.polar_alternative,
                                    {type.name,
                                     to_digits(type.maximum),
                                     fmt::format("{:.4g}", type.maximum_c),
                                     fmt::format("{:.4g}", type.maximum_gamma)});
    sheet.figure.caption = fill(t.polar_caption, {type.name});
    sheet.facts = make_facts(plan, k, t);
    return sheet;
}

Table make_positions(const Plan& plan, const Texts& t) {
    Table table{t.positions_caption,
                {{t.luminaire},
                 {t.number},
                 {"x", true},
                 {"y", true},
                 {"z", true},
                 {t.c0_direction, true},
                 {t.tilt, true},
                 {t.light_share, true},
                 {t.group}},
                {},
                true};
    const double in_degrees = 180.0 / std::acos(-1.0);
    for (const PlanLuminaire& l : plan.luminaires) {
        const double turn = std::atan2(l.c0.y, l.c0.x) * in_degrees;
        const double tilt = std::acos(std::clamp(l.frame.z.z(), -1.0, 1.0)) * in_degrees;
        table.rows.push_back({{l.name},
                              {std::to_string(l.type + 1)},
                              {fmt::format("{:.2f}", l.position.x), l.position.x},
                              {fmt::format("{:.2f}", l.position.y), l.position.y},
                              {fmt::format("{:.2f}", l.position.z), l.position.z},
                              {fmt::format("{:.0f}", turn + 0.0)},
                              {fmt::format("{:.0f}", tilt + 0.0)},
                              {fmt::format("{:.2f}", l.scale), l.scale},
                              {l.group}});
    }
    return table;
}

} // namespace

Section make_luminaire_section(const ResultsDocument& d, const Texts& t) {
    Section section{"luminaires", t.luminaires, {}};
    section.blocks.emplace_back(make_schedule(d.plan, t));
    section.blocks.emplace_back(Paragraph{t.schedule_note, Mark::none, true});
    for (std::size_t k = 0; k < d.plan.types.size(); ++k)
        if (!frames_of(d.plan, k).empty())
            section.blocks.emplace_back(make_sheet(d.plan, k, t));
    section.blocks.emplace_back(Paragraph{t.legend, Mark::none, true});
    section.blocks.emplace_back(Paragraph{t.positions_note, Mark::none, true});
    section.blocks.emplace_back(make_positions(d.plan, t));
    return section;
}

} // namespace isolux::report
