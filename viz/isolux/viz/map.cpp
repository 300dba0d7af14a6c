#include "isolux/viz/map.h"

#include <algorithm>
#include <array>
#include <utility>

#include "isolux/viz/map_bands.h"
#include "isolux/viz/map_page.h"
#include "isolux/viz/map_scale.h"
#include "isolux/viz/map_text.h"
#include "isolux/viz/map_values.h"
#include "isolux/viz/plan_symbols.h"
#include "isolux/viz/surface_view.h"

namespace isolux {

namespace {

const Stroke object_line{ink::grey, 0.18, 0.0};
const Stroke room_line{ink::black, 0.6, 0.0};
const LuminaireStyle luminaire_style{{{60, 60, 60}, 0.2, 0.0}, {}, Direction::tick};

std::array<std::string, 2> axis_names(const SurfaceView& view) {
    return view.is_plan ? std::array<std::string, 2>{"x", "y"}
                        : std::array<std::string, 2>{"u", "v"};
}

std::vector<LegendEntry> make_entries(const Plan& visible, bool has_extremes) {
    std::vector<LegendEntry> list;
    if (!visible.luminaires.empty()) {
        const bool are_points =
            std::all_of(visible.luminaires.begin(),
                        visible.luminaires.end(),
                        [](const PlanLuminaire& l) { return l.body.empty(); });
        list.push_back(luminaire_entry(luminaire_style, are_points, "luminaire, mark: C0"));
    }
    if (!visible.objects.empty())
        list.push_back(area_entry(ink::furniture, object_line, "object"));
    if (!visible.rooms.empty())
        list.push_back(line_entry(room_line, "room"));
    if (has_extremes)
        list.push_back({{}, "▼ lowest, ▲ highest"});
    return list;
}

} // namespace

Drawing draw_map(const SurfaceResult& result, const Plan& plan, const MapNotes& notes) {
    const SurfaceView view = make_surface_view(result.surface);
    const Plan visible = select_visible(plan, result.surface, view);
    const ValueRange range = find_range(result.points);
    const MapScale scale = make_scale(result, range, notes.confidence);
    const bool has_grid = result.surface.grid.has_value();
    MapPage page(describe_result(result, notes),
                 map_extent(result.surface, view, visible),
                 axis_names(view),
                 make_legend(scale, range),
                 make_entries(visible, has_grid && !range.is_flat()));

    page.open_clip({page.frame()});
    draw_faces(page, visible.objects, ink::furniture);
    PaintedBands bands;
    if (has_grid)
        bands = paint_bands(page, result, view, scale);
    draw_lines(page, visible.objects, object_line);
    draw_lines(page, visible.rooms, room_line);
    for (const PlanLuminaire& l : visible.luminaires)
        draw_luminaire(page, l, luminaire_style);
    ValueWriter writer(page, result, view, scale, range);
    if (has_grid)
        writer.write_on_bands(bands);
    else
        writer.write_dots();
    page.close_clip();
    return std::move(page).finish();
}

void write_map(const std::filesystem::path& stem,
               const SurfaceResult& result,
               const Plan& plan,
               const MapNotes& notes) {
    write_drawing(stem, draw_map(result, plan, notes));
}

} // namespace isolux
