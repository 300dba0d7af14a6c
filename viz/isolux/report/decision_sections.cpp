#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"

namespace isolux::report {

namespace {

std::string scale_of(const ObserverGroup& group) {
    return group.scale == GlareScale::unified ? "UGR" : "GR";
}

std::string in_words(const Point3& p) {
    return fmt::format("{:.2f}, {:.2f}, {:.2f}", p.x, p.y, p.z);
}

std::string in_words(const UnitVector3& v) {
    return fmt::format("{:.2f}, {:.2f}, {:.2f}", v.x(), v.y(), v.z());
}

Cell rating_cell(const GlareRating& r, double confidence) {
    return r.value.samples == 0 ? Cell{r.reason} : estimate_cell(r.value, confidence);
}

Table make_groups(const Results& r, const Texts& t) {
    Table table{t.glare_caption,
                {{t.observers},
                 {t.scale},
                 {t.sight_lines, true},
                 {t.worst, true},
                 {t.eye},
                 {t.looking},
                 {t.by_table}},
                {}};
    for (const ObserverGroupResult& o : r.observers) {
        const auto lines = static_cast<double>(o.group.sight_lines.size());
        std::vector<Cell> row{
            {o.group.name}, {scale_of(o.group)}, {fmt::format("{:.0f}", lines), lines}};
        if (o.worst) {
            const SightLine& line = o.group.sight_lines[*o.worst];
            row.push_back(rating_cell(o.ratings[*o.worst], r.confidence));
            row.push_back({in_words(line.eye)});
            row.push_back({in_words(line.direction)});
        } else {
            row.insert(row.end(), {Cell{"–"}, Cell{}, Cell{}});
        }
        row.push_back(
            {o.by_table ? fmt::format("{:.1f} ({})", *o.by_table, o.table_note) : o.table_note,
             o.by_table});
        table.rows.push_back(std::move(row));
    }
    return table;
}

Table make_ratings(const ObserverGroupResult& o, double confidence, const Texts& t) {
    Table table{
        fill(t.ratings_caption, {o.group.name, scale_of(o.group)}),
        {{t.number}, {t.eye}, {t.looking}, {scale_of(o.group), true}, {t.background, true}},
        {},
        true};
    for (std::size_t k = 0; k < o.ratings.size(); ++k)
        table.rows.push_back({{std::to_string(k + 1)},
                              {in_words(o.group.sight_lines[k].eye)},
                              {in_words(o.group.sight_lines[k].direction)},
                              rating_cell(o.ratings[k], confidence),
                              estimate_cell(o.ratings[k].background, confidence)});
    return table;
}

Table make_maintenance(const ResultsDocument& d, const Texts& t) {
    Table table{t.maintenance_caption,
                {{t.type},
                 {"LLMF", true},
                 {"LSF", true},
                 {"LMF", true},
                 {"RSMF", true},
                 {t.maintenance_factor, true}},
                {}};
    for (const ScheduleEntry& e : d.schedule) {
        const MaintenanceFactor& m = e.maintenance;
        const auto part = [&](double value) {
            return m.has_parts ? number_cell(value) : Cell{"–"};
        };
        table.rows.push_back({{e.type},
                              part(m.lamp_flux),
                              part(m.lamp_survival),
                              part(m.luminaire),
                              part(m.room_surface),
                              number_cell(m.value)});
    }
    return table;
}

/// Why verdicts are missing, and what to know about others; each sentence once.
std::vector<std::string> notes_of(const std::vector<Verdict>& verdicts, const Texts& t) {
    std::vector<std::string> notes;
    for (const Verdict& v : verdicts) {
        std::string note = fill(t.verdict_note, {v.subject, v.requirement.symbol, v.reason});
        if (!v.reason.empty() && std::ranges::find(notes, note) == notes.end())
            notes.push_back(std::move(note));
    }
    return notes;
}

} // namespace

Section make_glare_section(const ResultsDocument& d, const Texts& t) {
    Section section{"glare", t.glare, {}};
    section.blocks.emplace_back(Paragraph{t.glare_intro});
    section.blocks.emplace_back(make_groups(d.results, t));
    for (const ObserverGroupResult& o : d.results.observers)
        section.blocks.emplace_back(make_ratings(o, d.results.confidence, t));
    return section;
}

Section make_energy_section(const ResultsDocument& d, const Texts& t) {
    // below the short section on glare, where there is one
    Section section{"energy", t.energy, {}, d.results.observers.empty()};
    Table table{t.energy_caption,
                {{t.room},
                 {t.area, true},
                 {t.watts, true},
                 {t.density, true},
                 {t.density_per_100_lux, true},
                 {t.leni, true}},
                {}};
    for (const EnergyResult& e : d.results.energy) {
        const Cell unknown{e.reason.empty() ? t.not_stated : e.reason};
        table.rows.push_back({{e.room},
                              number_cell(e.floor_area),
                              e.watts ? number_cell(*e.watts) : unknown,
                              e.watts ? number_cell(e.density) : Cell{"–"},
                              e.watts && !e.surface.empty()
                                  ? estimate_cell(e.density_per_100_lux, d.results.confidence)
                                  : Cell{"–"},
                              e.leni ? number_cell(*e.leni) : Cell{"–"}});
    }
    section.blocks.emplace_back(std::move(table));
    if (!d.schedule.empty())
        section.blocks.emplace_back(make_maintenance(d, t));
    return section;
}

Section make_scene_section(const ResultsDocument& d, const Texts& t) {
    Section section{"scenes", t.scenes, {}, false};
    section.blocks.emplace_back(Paragraph{t.scenes_intro});
    const double confidence = d.results.confidence;
    for (const SceneResult& scene : d.results.scenes) {
        Table table{fill(t.scene_caption, {scene.name}),
                    {{t.surface},
                     {t.mean + ", " + t.lux, true},
                     {t.minimum + ", " + t.lux, true},
                     {t.maximum + ", " + t.lux, true},
                     {t.uniformity, true}},
                    {}};
        for (std::size_t k = 0; k < scene.surfaces.size(); ++k)
            table.rows.push_back({{d.results.surfaces[k].surface.name},
                                  estimate_cell(scene.surfaces[k].mean, confidence),
                                  estimate_cell(scene.surfaces[k].minimum, confidence),
                                  estimate_cell(scene.surfaces[k].maximum, confidence),
                                  estimate_cell(scene.surfaces[k].uniformity, confidence)});
        section.blocks.emplace_back(std::move(table));
        if (!scene.verdicts.empty())
            section.blocks.emplace_back(make_verdict_table(scene.verdicts,
                                                           fill(t.scene_caption, {scene.name})
                                                               + ": " + t.verdict_caption,
                                                           t));
        for (std::string& note : notes_of(scene.verdicts, t))
            section.blocks.emplace_back(Paragraph{std::move(note), Mark::none, true});
    }
    return section;
}

} // namespace isolux::report
