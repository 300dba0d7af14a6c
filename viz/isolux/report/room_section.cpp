#include <algorithm>

#include <fmt/format.h>

#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"
#include "isolux/viz/map.h"
#include "isolux/viz/room_drawing.h"

namespace isolux::report {

namespace {

constexpr double highest_plan = 115.0; // mm, so that two fit on a page

std::string share(double v) { return v > 0.0 ? fmt::format("{:.3g}", v) : "–"; }

/// Surfaces that are made alike.
struct FinishRow {
    PlanFinish finish;               ///< of the first; the area is that of all
    std::vector<std::string> owners; ///< each once
};

bool is_alike(const PlanFinish& a, const PlanFinish& b) {
    return a.is_room == b.is_room && a.material == b.material && a.reflectance == b.reflectance
           && a.mirror == b.mirror && a.transmittance == b.transmittance
           && (!a.is_room || a.owner == b.owner);
}

/// Parts of a room each, objects of one material together.
std::vector<FinishRow> gather_finishes(const std::vector<PlanFinish>& all) {
    std::vector<FinishRow> rows;
    for (const PlanFinish& f : all) {
        const auto row = std::ranges::find_if(
            rows, [&](const FinishRow& r) { return is_alike(r.finish, f); });
        if (row == rows.end()) {
            rows.push_back({f, {f.owner}});
            continue;
        }
        row->finish.area += f.area;
        const bool is_same_thing = std::ranges::find(row->owners, f.owner) != row->owners.end();
        if (!is_same_thing)
            row->owners.push_back(f.owner);
        if (is_same_thing && row->owners.size() == 1)
            row->finish.part += ", " + f.part;
        else
            row->finish.part.clear();
    }
    return rows;
}

/// "desk 1, desk 2, desk 3, desk 4, ... (16)"
std::string in_words(const std::vector<std::string>& owners) {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t k = 0; k < std::min(most, owners.size()); ++k)
        text += (k == 0 ? "" : ", ") + owners[k];
    return owners.size() <= most ? text : fmt::format("{}, ... ({})", text, owners.size());
}

Table make_finish_table(const std::vector<PlanFinish>& finishes, const Texts& t) {
    Table table{t.finishes_table,
                {{t.room_or_object},
                 {t.part},
                 {t.material},
                 {t.surface_area, true},
                 {t.diffuse_share, true},
                 {t.mirror_share, true},
                 {t.transmittance, true}},
                {}};
    for (const auto& [f, owners] : gather_finishes(finishes))
        table.rows.push_back({{in_words(owners)},
                              {f.part},
                              {f.material},
                              {fmt::format("{:.2f}", f.area), f.area},
                              {share(f.reflectance), f.reflectance},
                              {share(f.mirror), f.mirror},
                              {share(f.transmittance), f.transmittance}});
    return table;
}

} // namespace

Section make_room_section(const ResultsDocument& d, const Texts& t) {
    Section section{"rooms", t.rooms, {}, false};
    std::vector<CalculationSurface> surfaces;
    for (const SurfaceResult& s : d.results.surfaces)
        surfaces.push_back(s.surface);
    Table table{t.rooms_table,
                {{t.room}, {t.area, true}, {t.height, true}, {t.luminaire_count, true}},
                {}};
    for (const PlanOutline& room : d.plan.rooms) {
        const double area = area_of(room);
        const double height = room.upper - room.lower;
        const auto luminaires = static_cast<double>(luminaires_in(d.plan, room).size());
        table.rows.push_back({{room.name},
                              {fmt::format("{:.2f}", area), area},
                              {fmt::format("{:.2f}", height), height},
                              {fmt::format("{:.0f}", luminaires), luminaires}});
    }
    section.blocks.emplace_back(std::move(table));
    if (!d.plan.finishes.empty())
        section.blocks.emplace_back(make_finish_table(d.plan.finishes, t));
    for (const PlanOutline& room : d.plan.rooms)
        section.blocks.emplace_back(
            Figure{draw_room(room, d.plan, surfaces, d.project_name, widest_map),
                   fill(t.room_alternative,
                        {room.name,
                         std::to_string(luminaires_in(d.plan, room).size()),
                         std::to_string(surfaces.size())}),
                   fill(t.room_caption, {room.name}),
                   Figure{}.largest_width,
                   highest_plan});
    return section;
}

} // namespace isolux::report
