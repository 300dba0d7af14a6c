#include <fmt/format.h>

#include "isolux/report/budget.h"
#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"

namespace isolux::report {

namespace {

std::string self_test_line(const std::optional<SelftestRecord>& test, const Texts& t) {
    if (!test)
        return t.self_test_absent;
    return fill(t.self_test_value,
                {std::to_string(test->passed),
                 std::to_string(test->rows),
                 test->version,
                 std::to_string(test->seed)});
}

FactList make_facts(const ResultsDocument& d,
                    const std::optional<SelftestRecord>& self_test,
                    const Texts& t) {
    const Results& r = d.results;
    FactList list{t.method_caption, {}};
    list.rows = {
        {{t.estimator}, {r.estimator}},
        {{t.seed}, {std::to_string(d.seed)}},
        {{t.tolerance},
         {fmt::format(
             "{}, {} {}", to_percent(d.tolerance), to_digits(d.absolute_tolerance), t.lux)}},
        {{t.confidence},
         {fill(t.confidence_value, {to_percent(d.confidence), to_percent(r.confidence)})}},
        {{t.replicates}, {std::to_string(r.replicates), static_cast<double>(r.replicates)}},
        {{t.paths}, {std::to_string(r.paths), static_cast<double>(r.paths)}},
        {{t.rays}, {std::to_string(r.rays.path + r.rays.shadow + r.rays.gather)}},
        {{t.flux_balance},
         {fill(t.flux_balance_value,
               {estimate_cell(r.flux_balance.emitted, r.confidence).text,
                estimate_cell(r.flux_balance.absorbed, r.confidence).text,
                estimate_cell(r.flux_balance.escaped, r.confidence).text})}},
        {{t.self_test}, {self_test_line(self_test, t)}},
        {{t.duration},
         {fill(t.duration_value, {to_digits(r.wall_seconds), to_digits(r.cpu_seconds)})}}};
    return list;
}

Table make_budget_table(const Results& r, const Assumptions& assumptions, const Texts& t) {
    Table table{t.budget_caption,
                {{t.surface},
                 {t.monte_carlo, true},
                 {t.photometry, true},
                 {t.assumed_flux, true},
                 {t.reflectance, true},
                 {t.maintenance, true},
                 {t.combined, true}},
                {}};
    for (const SurfaceResult& s : r.surfaces) {
        const Budget b = make_budget(s, r.confidence, assumptions);
        const auto cell = [&](double u) {
            return Cell{
                fmt::format("{} ({:.0f} %)", to_percent(u), 100.0 * b.share(u)), u, Mark::none};
        };
        table.rows.push_back({{s.surface.name},
                              cell(b.monte_carlo),
                              cell(b.photometry),
                              cell(b.flux),
                              cell(b.reflectance),
                              cell(b.maintenance),
                              {to_percent(b.combined), b.combined}});
    }
    return table;
}

Table make_hashes(const ResultsDocument& d, const Texts& t) {
    Table table{t.hashes_caption, {{t.file}, {t.sha256}}, {}};
    table.rows.push_back({{d.project.file}, {d.project.sha256}});
    for (const InputFile& f : d.inputs)
        table.rows.push_back({{f.file}, {f.sha256}});
    return table;
}

} // namespace

Section make_method_section(const ResultsDocument& d,
                            const std::optional<SelftestRecord>& self_test,
                            const Texts& t) {
    const Assumptions assumptions;
    Section section{"method", t.method, {}};
    section.blocks.emplace_back(Paragraph{t.method_intro});
    section.blocks.emplace_back(make_facts(d, self_test, t));
    section.blocks.emplace_back(Subheading{t.budget_title});
    section.blocks.emplace_back(Paragraph{fill(t.budget_intro,
                                               {to_percent(assumptions.photometry),
                                                to_percent(assumptions.flux),
                                                to_percent(assumptions.reflected_light),
                                                to_percent(assumptions.maintenance)})});
    section.blocks.emplace_back(make_budget_table(d.results, assumptions, t));
    section.blocks.emplace_back(Subheading{t.hashes_title});
    section.blocks.emplace_back(Paragraph{t.hashes_intro});
    section.blocks.emplace_back(make_hashes(d, t));
    return section;
}

} // namespace isolux::report
