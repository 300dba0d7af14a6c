#include "isolux/report/make_report.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"

namespace isolux::report {

namespace {

/// "2026-05-13T09:30:00Z" as "2026-05-13 09:30 UTC".
std::string date_of(const ResultsDocument& d, const Texts& t) {
    if (d.date.size() < 16)
        return d.date.empty() ? t.no_date : d.date;
    return d.date.substr(0, 10) + " " + d.date.substr(11, 5) + " UTC";
}

std::string state_of(const Results& r, const Texts& t) {
    return r.interrupted ? t.state_interrupted : r.converged ? t.state_converged : t.state_open;
}

} // namespace

std::string fill(const std::string& pattern, const std::vector<std::string>& values) {
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    for (const std::string& v : values)
        store.push_back(std::cref(v));
    return fmt::vformat(pattern, store);
}

Report make_report(const ResultsDocument& d,
                   const std::vector<View>& views,
                   const Texts& t,
                   const std::optional<SelftestRecord>& self_test) {
    Report r;
    r.language = t.language;
    r.kind = t.kind;
    r.title = d.project_name;
    r.lead = d.description;
    r.contents_title = t.contents;
    r.footer = fill(t.footer, {d.project_name, d.version});
    r.cover.caption = t.cover_caption;
    r.cover.rows = {
        {{t.project}, {d.project_name}},
        {{t.project_file}, {d.project.file}},
        {{t.date}, {date_of(d, t)}},
        {{t.program}, {fill(t.program_value, {d.version})}},
        {{t.accuracy},
         {fill(t.accuracy_value, {to_percent(d.tolerance), to_percent(d.confidence)})}},
        {{t.state}, {state_of(d.results, t)}}};
    if (!d.results.verdicts.empty())
        r.sections.push_back(make_verdict_section(d, t));
    r.sections.push_back(make_overview(d, t));
    if (!d.plan.luminaires.empty())
        r.sections.push_back(make_luminaire_section(d, t));
    if (!d.plan.rooms.empty())
        r.sections.push_back(make_room_section(d, t));
    for (std::size_t k = 0; k < d.results.surfaces.size(); ++k)
        r.sections.push_back(make_surface_section(d, k, t));
    if (!d.results.observers.empty())
        r.sections.push_back(make_glare_section(d, t));
    if (!d.results.energy.empty())
        r.sections.push_back(make_energy_section(d, t));
    if (!d.results.scenes.empty())
        r.sections.push_back(make_scene_section(d, t));
    if (!views.empty())
        r.sections.push_back(make_view_section(views, t));
    r.sections.push_back(make_method_section(d, self_test, t));
    return r;
}

} // namespace isolux::report
