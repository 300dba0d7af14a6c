#include "isolux/viz/plan_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "isolux/viz/drawing_parts.h"
#include "isolux/viz/label_layout.h"
#include "isolux/viz/plan_symbols.h"

namespace isolux {

namespace {

constexpr double name_size = 2.6; // mm
constexpr double type_size = 2.1; // mm

const Stroke room_line{ink::black, 0.6, 0.0};
const Stroke object_line{ink::grey, 0.18, 0.0};
const Stroke surface_line{{0, 90, 160}, 0.3, 1.2};

/// Fills that stay apart for colour-blind readers: Okabe and Ito's set
/// (jfly.uni-koeln.de/color, 2008), lightened so that a number can stand on them.
Colour type_colour(std::size_t type) {
    constexpr std::array<Colour, 7> fills{Colour{248, 222, 140},
                                          {170, 215, 245},
                                          {150, 215, 195},
                                          {245, 240, 160},
                                          {235, 175, 140},
                                          {228, 190, 212},
                                          {160, 195, 225}};
    return fills[type % fills.size()];
}

LuminaireStyle style_of(std::size_t type) {
    return {{ink::black, 0.22, 0.0}, type_colour(type), Direction::arrow};
}

/// A name inside the upper left corner of what it names, or along its other corners.
void write_name(MapPage& page,
                LabelLayout& layout,
                const std::string& name,
                const Polyline& page_line,
                const Colour& colour,
                Weight weight) {
    Extent e;
    for (const Point2& p : page_line)
        e.include(p);
    Text t;
    t.text = shorten(name, std::max(e.width() - 2.0, 12.0), name_size, weight, page.ruler());
    t.size = name_size;
    t.weight = weight;
    t.colour = colour;
    t.halo = ink::white;
    const double width = page.ruler().width(t.text, name_size, weight);
    const std::vector<Polyline> frame{page.frame()};
    for (double y = e.low.y + 1.0 + 0.5 * name_size; y < e.high.y; y += name_size)
        for (const double x : {e.low.x + 1.2, e.high.x - 1.2 - width}) {
            if (!layout.place({{x + 0.5 * width, y}, width, name_size, 0.0}, frame))
                continue;
            t.at = {x, y + 0.5 * cap_height * name_size};
            page.add(std::move(t));
            return;
        }
}

void draw_surfaces(MapPage& page, std::span<const CalculationSurface> surfaces) {
    for (const CalculationSurface& s : surfaces) {
        Shape shape;
        shape.lines = page.to_page({surface_outline(s)});
        shape.stroke = surface_line;
        if (!shape.lines.front().empty()) {
            page.add(std::move(shape));
            continue;
        }
        shape.lines.clear();
        shape.ends = Ends::open;
        shape.stroke->dash = 0.0;
        for (const Receiver& r : s.receivers) {
            const Point2 at = page.to_page(Point2{r.point.x, r.point.y});
            shape.lines.push_back({{at.x - 0.8, at.y}, {at.x + 0.8, at.y}});
            shape.lines.push_back({{at.x, at.y - 0.8}, {at.x, at.y + 0.8}});
        }
        page.add(std::move(shape));
    }
}

/// A wall's line is interrupted: a thin double line for glass, two jambs and a thin line for a
/// leaf, jambs alone for a hole.
void draw_openings(MapPage& page, const Plan& plan) {
    constexpr double jamb = 1.1; // mm, half
    constexpr double gap = 0.45; // mm, half, between the lines of a window
    const Stroke thin{ink::black, 0.2, 0.0};
    const Stroke erase{ink::white, 0.8, 0.0};
    for (const PlanOpening& o : plan.openings) {
        const Point2 a = page.to_page(o.from);
        const Point2 b = page.to_page(o.to);
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        if (!(length > 0.0))
            continue;
        const Point2 across{-(b.y - a.y) / length, (b.x - a.x) / length};
        const auto beside = [&](const Point2& p, double d) {
            return Point2{p.x + d * across.x, p.y + d * across.y};
        };
        page.add(make_line({a, b}, erase));
        for (const Point2& end : {a, b})
            page.add(make_line({beside(end, -jamb), beside(end, jamb)}, thin));
        if (o.state == OpeningState::glazed)
            for (const double d : {-gap, gap})
                page.add(make_line({beside(a, d), beside(b, d)}, thin));
        else if (o.state == OpeningState::closed)
            page.add(make_line({a, b}, thin));
    }
}

void number_luminaires(MapPage& page, LabelLayout& layout, const Plan& plan) {
    const std::vector<Polyline> frame{page.frame()};
    for (const PlanLuminaire& l : plan.luminaires) {
        Text t;
        t.text = fmt::format("{}", l.type + 1);
        t.size = type_size;
        t.anchor = Anchor::middle;
        t.colour = ink::black;
        t.halo = type_colour(l.type);
        const Point2 at = page.to_page(Point2{l.position.x, l.position.y});
        const double width = page.ruler().width(t.text, type_size, Weight::normal);
        if (!layout.place({at, width + 0.3, type_size, 0.0}, frame))
            continue;
        t.at = {at.x, at.y + 0.5 * cap_height * type_size};
        page.add(std::move(t));
    }
}

} // namespace

Polyline surface_outline(const CalculationSurface& surface) {
    Polyline line;
    for (const Point3& p : surface.outline)
        line.push_back({p.x, p.y});
    if (line.empty() && surface.grid) {
        const GridLayout& g = *surface.grid;
        for (const auto& [u, v] :
             {std::pair{0.0, 0.0}, {g.width, 0.0}, {g.width, g.height}, {0.0, g.height}}) {
            const Point3 p = g.frame.point_from_local({u, v, 0.0});
            line.push_back({p.x, p.y});
        }
    }
    return line;
}

std::vector<LegendEntry> make_plan_entries(const Plan& plan, bool has_surfaces) {
    std::vector<LegendEntry> entries;
    for (std::size_t t = 0; t < plan.types.size(); ++t) {
        std::size_t count = 0;
        bool is_point = true;
        for (const PlanLuminaire& l : plan.luminaires)
            if (l.type == t) {
                ++count;
                is_point = is_point && l.body.empty();
            }
        if (count == 0)
            continue;
        entries.push_back(luminaire_entry(style_of(t),
                                          is_point,
                                          fmt::format("{}: {} × {}, {:.0f} lm",
                                                      t + 1,
                                                      count,
                                                      plan.types[t].name,
                                                      plan.types[t].flux)));
    }
    if (!plan.luminaires.empty())
        entries.push_back({{}, "arrow: C0, dashes: aim of a tilted luminaire"});
    if (!plan.objects.empty())
        entries.push_back(area_entry(ink::furniture, object_line, "object"));
    if (has_surfaces)
        entries.push_back(line_entry(surface_line, "calculation surface"));
    if (!plan.rooms.empty())
        entries.push_back(line_entry(room_line, "room"));
    const auto has = [&](OpeningState state) {
        return std::ranges::any_of(plan.openings,
                                   [state](const PlanOpening& o) { return o.state == state; });
    };
    if (has(OpeningState::glazed))
        entries.push_back({{}, "double thin line in a wall: window"});
    if (has(OpeningState::closed))
        entries.push_back({{}, "thin line in a wall: closed door"});
    if (has(OpeningState::open))
        entries.push_back({{}, "gap in a wall: opening"});
    return entries;
}

void draw_plan_parts(MapPage& page,
                     const Plan& plan,
                     std::span<const CalculationSurface> surfaces) {
    draw_faces(page, plan.objects, ink::furniture);
    draw_lines(page, plan.objects, object_line);
    draw_lines(page, plan.rooms, room_line);
    draw_openings(page, plan);
    draw_surfaces(page, surfaces);
    for (const PlanLuminaire& l : plan.luminaires)
        draw_luminaire(page, l, style_of(l.type));
    LabelLayout layout;
    number_luminaires(page, layout, plan);
    for (const PlanOutline& room : plan.rooms) {
        Polyline corners;
        for (const Polyline& line : page.to_page(room.lines))
            corners.insert(corners.end(), line.begin(), line.end());
        write_name(page, layout, room.name, corners, ink::black, Weight::bold);
    }
    for (const CalculationSurface& s : surfaces)
        if (const Polyline line = page.to_page({surface_outline(s)}).front(); !line.empty())
            write_name(page, layout, s.name, line, surface_line.colour, Weight::normal);
}

} // namespace isolux
