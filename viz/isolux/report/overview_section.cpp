#include "isolux/measure/quantity.h"
#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"

namespace isolux::report {

namespace {

Table make_surface_table(const Results& r, const Texts& t) {
    Table table{t.surfaces_caption,
                {{t.surface},
                 {t.quantity},
                 {t.points, true},
                 {t.mean + ", " + t.lux, true},
                 {t.minimum + ", " + t.lux, true},
                 {t.maximum + ", " + t.lux, true},
                 {t.uniformity, true},
                 {t.diversity, true},
                 {t.reached}},
                {},
                true};
    for (const SurfaceResult& s : r.surfaces)
        table.rows.push_back(
            {{s.surface.name},
             {std::string(quantity_name(s.surface.kind))},
             {std::to_string(s.points.size()), static_cast<double>(s.points.size())},
             estimate_cell(s.summary.mean, r.confidence),
             estimate_cell(s.summary.minimum, r.confidence),
             estimate_cell(s.summary.maximum, r.confidence),
             estimate_cell(s.summary.uniformity, r.confidence),
             estimate_cell(s.summary.diversity, r.confidence),
             {s.converged ? t.yes : t.no}});
    return table;
}

} // namespace

Section make_overview(const ResultsDocument& d, const Texts& t) {
    Section section{"overview", t.overview, {}, false, true};
    section.blocks.emplace_back(
        Paragraph{fill(t.overview_intro, {to_percent(d.results.confidence)})});
    section.blocks.emplace_back(make_surface_table(d.results, t));
    if (!d.results.notices.empty()) {
        Table notices{t.notices, {{t.place}, {t.notice}}, {}};
        for (const Message& m : d.results.notices)
            notices.rows.push_back(
                {{m.where}, {m.hint.empty() ? m.what : m.what + ". " + m.hint}});
        section.blocks.emplace_back(std::move(notices));
    }
    return section;
}

Section make_view_section(const std::vector<View>& views, const Texts& t) {
    Section section{"views", t.views, {}};
    for (const View& v : views)
        section.blocks.emplace_back(
            Photograph{v.png, fill(t.view_caption, {v.name}), fill(t.view_caption, {v.name})});
    return section;
}

} // namespace isolux::report
