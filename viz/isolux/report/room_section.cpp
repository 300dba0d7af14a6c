#include <fmt/format.h>

#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"
#include "isolux/viz/map.h"
#include "isolux/viz/room_drawing.h"

namespace isolux::report {

namespace {

constexpr double highest_plan = 115.0; // mm, so that two fit on a page

std::string share(double v) { return v > 0.0 ? fmt::format("{:.3g}", v) : "–"; }

/// Rows of what is made alike: parts of a room each, objects of one material together.
std::vector<PlanFinish> gather_finishes(const std::vector<PlanFinish>& all) {
    std::vector<PlanFinish> rows;
    std::vector<std::size_t> counts;
    const auto is_alike = [](const PlanFinish& a, const PlanFinish& b) {
        return a.is_room == b.is_room && a.material == b.material
               && a.reflectance == b.reflectance && a.mirror == b.mirror
               && a.transmittance == b.transmittance && (!a.is_room || a.owner == b.owner);
    };
    for (const PlanFinish& f : all) {
        std::size_t k = 0;
        while (k < rows.size() && !is_alike(rows[k], f))
            ++k;
        if (k == rows.size()) {
            rows.push_back(f);
            counts.push_back(1);
            continue;
        }
        rows[k].area += f.area;
        ++counts[k];
        if (f.is_room)
            rows[k].part += ", " + f.part;
        else if (counts[k] <= 4 && f.owner != all[k].owner)
            rows[k].owner += ", " + f.owner;
        else if (counts[k] == 5)
            rows[k].owner += ", ...";
    }
    return rows;
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
    for (const PlanFinish& f : gather_finishes(finishes))
        table.rows.push_back({{f.owner},
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
