#include "isolux/viz/plan_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "isolux/viz/drawing_parts.h"
#include "isolux/viz/label_layout.h"
#include "isolux/viz/plan_symbols.h"

namespace isolux {

namespace {

constexpr double name_size = 2.6;   // mm
constexpr double type_size = 2.1;   // mm
constexpr double least_room = 30.0; // mm, for a name, however small what it names

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

/// A name on the plan, before it has its place.
Text make_name(std::string text, const Colour& colour, Weight weight) {
    Text t;
    t.text = std::move(text);
    t.size = name_size;
    t.weight = weight;
    t.colour = colour;
    t.halo = ink::white;
    return t;
}

/// A name inside what it names, from the upper left corner on; where there is no room inside,
/// anywhere within its extent.
void write_name(MapPage& page,
                LabelLayout& layout,
                const std::string& name,
                const std::vector<Polyline>& loops,
                const Colour& colour,
                Weight weight) {
    constexpr double step = 2.0; // mm
    Extent e;
    for (const Polyline& loop : loops)
        for (const Point2& p : loop)
            e.include(p);
    Text t = make_name(
        shorten(name, std::max(e.width() - 2.0, least_room), name_size, weight, page.ruler()),
        colour,
        weight);
    const double width = page.ruler().width(t.text, name_size, weight);
    for (const std::vector<Polyline>& within : {loops, {page.frame()}})
        for (double y = e.low.y + 1.0 + 0.5 * name_size; y < e.high.y; y += name_size)
            for (double x = e.low.x + 1.2; x == e.low.x + 1.2 || x + width < e.high.x - 1.0;
                 x += step) {
                if (!layout.place({{x + 0.5 * width, y}, width, name_size, 0.0}, within))
                    continue;
                t.at = {x, y + 0.5 * cap_height * name_size};
                page.add(std::move(t));
                return;
            }
}

/// A name along a surface seen edge-on, on its front.
void write_name_along(MapPage& page,
                      LabelLayout& layout,
                      const std::string& name,
                      const CalculationSurface& surface,
                      const std::array<Point2, 2>& ends) {
    const auto [a, b] = ends;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    Point2 along{(b.x - a.x) / length, (b.y - a.y) / length};
    if (along.x < -1e-6 || (std::abs(along.x) <= 1e-6 && along.y > 0.0))
        along = {-along.x, -along.y}; // read from below or from the right
    Point2 front{along.y, -along.x};
    if (!surface.receivers.empty()) {
        const UnitVector3& n = surface.receivers.front().axis;
        if (n.x() * front.x - n.y() * front.y < 0.0) // y runs down on the page
            front = {-front.x, -front.y};
    }
    Text t = make_name(
        shorten(
            name, std::max(length - 2.0, least_room), name_size, Weight::normal, page.ruler()),
        surface_line.colour,
        Weight::normal);
    const double width = page.ruler().width(t.text, name_size, Weight::normal);
    t.anchor = Anchor::middle;
    t.turn = -std::atan2(along.y, along.x) * 180.0 / std::acos(-1.0);
    const std::vector<Polyline> frame{page.frame()};
    constexpr double from_line = 0.9 * name_size; // mm, to the middle of the letters
    for (const double away : {from_line, 2.2 * from_line, -from_line})
        for (const double share : {0.5, 0.3, 0.7, 0.15, 0.85}) {
            const Point2 centre{a.x + share * (b.x - a.x) + away * front.x,
                                a.y + share * (b.y - a.y) + away * front.y};
            if (!layout.place({centre, width, name_size, t.turn}, frame))
                continue;
            const double drop = 0.5 * cap_height * name_size;
            t.at = {centre.x - drop * along.y, centre.y + drop * along.x};
            page.add(std::move(t));
            return;
        }
}

/// The ends of a loop that is a line on paper; nothing of one that has an area.
std::optional<std::array<Point2, 2>> edge_of(const Polyline& loop) {
    std::array<Point2, 2> ends{loop.front(), loop.front()};
    double longest = 0.0;
    for (const Point2& p : loop)
        for (const Point2& q : loop)
            if (const double d = std::hypot(p.x - q.x, p.y - q.y); d > longest) {
                longest = d;
                ends = {p, q};
            }
    if (!(longest > 0.0))
        return std::nullopt;
    constexpr double thickest = 0.2; // mm
    const auto [a, b] = ends;
    for (const Point2& p : loop)
        if (std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x))
            > thickest * longest)
            return std::nullopt;
    return ends;
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

/// A wall's line from `a` to `b` is interrupted: a thin double line for glass, two jambs and a
/// thin line for a leaf, jambs alone for a hole. Nothing where the points are one. mm.
std::vector<Shape> opening_between(const Point2& a, const Point2& b, OpeningState state) {
    constexpr double jamb = 1.1; // mm, half
    constexpr double gap = 0.45; // mm, half, between the lines of a window
    const Stroke thin{ink::black, 0.2, 0.0};
    const Stroke erase{ink::white, 0.8, 0.0};
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0.0))
        return {};
    const Point2 across{-(b.y - a.y) / length, (b.x - a.x) / length};
    const auto beside = [&](const Point2& p, double d) {
        return Point2{p.x + d * across.x, p.y + d * across.y};
    };
    std::vector<Shape> shapes{make_line({a, b}, erase)};
    for (const Point2& end : {a, b})
        shapes.push_back(make_line({beside(end, -jamb), beside(end, jamb)}, thin));
    if (state == OpeningState::glazed)
        for (const double d : {-gap, gap})
            shapes.push_back(make_line({beside(a, d), beside(b, d)}, thin));
    else if (state == OpeningState::closed)
        shapes.push_back(make_line({a, b}, thin));
    return shapes;
}

void draw_openings(MapPage& page, const Plan& plan) {
    for (const SceneOpening& o : plan.openings)
        for (Shape& shape : opening_between(page.to_page(o.from), page.to_page(o.to), o.state))
            page.add(std::move(shape));
}

/// An opening in a piece of wall.
std::vector<Shape> opening_symbol(OpeningState state) {
    std::vector<Shape> symbol{make_line({{0.0, 0.0}, {8.0, 0.0}}, room_line)};
    for (Shape& shape : opening_between({1.8, 0.0}, {6.2, 0.0}, state))
        symbol.push_back(std::move(shape));
    return symbol;
}

/// The marks of a luminaire without its body: the arrow, and the dashes beside it.
std::vector<Shape> aim_symbol() {
    const Stroke thin{ink::black, 0.2, 0.0};
    return {make_line({{0.5, 0.0}, {3.2, 0.0}}, thin),
            make_line({{2.4, -0.6}, {3.2, 0.0}, {2.4, 0.6}}, thin),
            make_line({{4.6, 0.0}, {7.6, 0.0}}, {ink::black, 0.2, 0.6})};
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
        entries.push_back({aim_symbol(), "arrow: C0, dashes: aim of a tilted luminaire"});
    if (!plan.objects.empty())
        entries.push_back(area_entry(ink::furniture, object_line, "object"));
    if (has_surfaces)
        entries.push_back(line_entry(surface_line, "calculation surface"));
    if (!plan.rooms.empty())
        entries.push_back(line_entry(room_line, "room"));
    const auto has = [&](OpeningState state) {
        return std::ranges::any_of(plan.openings,
                                   [state](const SceneOpening& o) { return o.state == state; });
    };
    if (has(OpeningState::glazed))
        entries.push_back({opening_symbol(OpeningState::glazed), "window"});
    if (has(OpeningState::closed))
        entries.push_back({opening_symbol(OpeningState::closed), "closed door"});
    if (has(OpeningState::open))
        entries.push_back({opening_symbol(OpeningState::open), "opening"});
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
    for (const PlanOutline& room : plan.rooms)
        write_name(page,
                   layout,
                   room.name,
                   page.to_page(room.faces.empty() ? room.lines : room.faces),
                   ink::black,
                   Weight::bold);
    std::vector<std::string> along_walls; // several quantities may share a wall and its name
    for (const CalculationSurface& s : surfaces) {
        const Polyline line = page.to_page({surface_outline(s)}).front();
        if (line.empty())
            continue;
        if (const auto ends = edge_of(line)) {
            if (std::ranges::find(along_walls, s.name) == along_walls.end())
                write_name_along(page, layout, s.name, s, *ends);
            along_walls.push_back(s.name);
        } else {
            write_name(page, layout, s.name, {line}, surface_line.colour, Weight::normal);
        }
    }
}

} // namespace isolux
