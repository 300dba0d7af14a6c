#include <fmt/format.h>

#include "isolux/report/numbers.h"
#include "isolux/report/sections.h"
#include "isolux/viz/map.h"
#include "isolux/viz/room_drawing.h"

namespace isolux::report {

Section make_room_section(const ResultsDocument& d, const Texts& t) {
    Section section{"rooms", t.rooms, {}};
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
    for (const PlanOutline& room : d.plan.rooms)
        section.blocks.emplace_back(
            Figure{draw_room(room, d.plan, surfaces, d.project_name),
                   fill(t.room_alternative,
                        {room.name,
                         std::to_string(luminaires_in(d.plan, room).size()),
                         std::to_string(surfaces.size())}),
                   fill(t.room_caption, {room.name})});
    return section;
}

} // namespace isolux::report
