#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "isolux/viz/map.h"
#include "isolux/viz/map_page.h"
#include "isolux/viz/plan_parts.h"
#include "isolux/viz/surface_view.h"

namespace isolux {

namespace {

Extent extent_of(const Plan& plan, std::span<const CalculationSurface> surfaces) {
    Extent e;
    const auto include = [&](const std::vector<PlanOutline>& things) {
        for (const PlanOutline& thing : things)
            for (const Polyline& line : thing.lines)
                for (const Point2& p : line)
                    e.include(p);
    };
    include(plan.rooms);
    if (plan.rooms.empty())
        include(plan.objects);
    for (const PlanLuminaire& l : plan.luminaires) {
        e.include({l.position.x, l.position.y});
        for (const Point2& p : l.body)
            e.include(p);
    }
    for (const CalculationSurface& s : surfaces) {
        for (const Point2& p : surface_outline(s))
            e.include(p);
        for (const Receiver& r : s.receivers)
            e.include({r.point.x, r.point.y});
    }
    if (e.is_empty())
        e = {{0.0, 0.0}, {0.0, 0.0}};
    return with_margin(e);
}

} // namespace

Drawing draw_plan_map(const Plan& plan,
                      std::span<const CalculationSurface> surfaces,
                      const std::string& project) {
    PageText text;
    text.title = "Floor plan";
    text.project = project;
    double flux = 0.0;
    for (const PlanLuminaire& l : plan.luminaires)
        flux += plan.types[l.type].flux;
    if (!plan.luminaires.empty())
        text.remarks = {fmt::format("{} luminaires, {:.0f} lm before dimming and maintenance",
                                    plan.luminaires.size(),
                                    flux)};
    MapPage page(text,
                 extent_of(plan, surfaces),
                 {"x", "y"},
                 {},
                 make_plan_entries(plan, !surfaces.empty()));
    page.open_clip({page.frame()});
    draw_plan_parts(page, plan, surfaces);
    page.close_clip();
    return std::move(page).finish();
}

void write_plan_map(const std::filesystem::path& stem,
                    const Plan& plan,
                    std::span<const CalculationSurface> surfaces,
                    const std::string& project) {
    write_drawing(stem, draw_plan_map(plan, surfaces, project));
}

} // namespace isolux
