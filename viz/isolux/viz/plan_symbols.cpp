#include "isolux/viz/plan_symbols.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace isolux {

namespace {

constexpr double point_symbol_radius = 1.1; // mm
constexpr double smallest_body = 1.6;       // mm, longer side on paper
constexpr double mark_length = 1.5;         // mm past the outline
constexpr double inclined = 0.09;           // sine of the tilt that is worth a line: 5 degrees

double largest_side(const Polyline& body) {
    Extent e;
    for (const Point2& p : body)
        e.include(p);
    return body.empty() ? 0.0 : std::max(e.width(), e.height());
}

/// How far a ray from `from` in direction `d` runs inside a convex outline.
double distance_to_border(const Polyline& body, const Point2& from, const Point2& d) {
    double farthest = 0.0;
    for (std::size_t k = 0; k < body.size(); ++k) {
        const Point2& a = body[k];
        const Point2& b = body[(k + 1) % body.size()];
        const double det = d.x * (a.y - b.y) - d.y * (a.x - b.x);
        if (std::abs(det) < 1e-12)
            continue;
        const double t = ((a.x - from.x) * (a.y - b.y) - (a.y - from.y) * (a.x - b.x)) / det;
        const double s = (d.x * (a.y - from.y) - d.y * (a.x - from.x)) / det;
        if (s >= -1e-9 && s <= 1.0 + 1e-9)
            farthest = std::max(farthest, t);
    }
    return farthest;
}

Shape open_lines(std::vector<Polyline> lines, const Stroke& stroke) {
    Shape s;
    s.lines = std::move(lines);
    s.ends = Ends::open;
    s.stroke = stroke;
    return s;
}

Point2 along(const Point2& from, const Point2& direction, double length) {
    return {from.x + length * direction.x, from.y + length * direction.y};
}

/// The mark towards C0: a short line, with a head where it is an arrow.
std::vector<Polyline> c0_mark(const Point2& from, const Point2& d, Direction kind) {
    const Point2 tip = along(from, d, mark_length);
    if (kind == Direction::tick)
        return {{from, tip}};
    constexpr double head = 0.8;
    const Point2 back = along(tip, d, -head);
    const Point2 across{-d.y, d.x};
    return {{from, tip},
            {along(back, across, 0.5 * head), tip, along(back, across, -0.5 * head)}};
}

std::vector<Polyline> cross_in(const Point2& centre) {
    const double r = point_symbol_radius * std::numbers::sqrt2 / 2.0;
    return {{{centre.x - r, centre.y - r}, {centre.x + r, centre.y + r}},
            {{centre.x - r, centre.y + r}, {centre.x + r, centre.y - r}}};
}

} // namespace

Polyline circle(const Point2& centre, double radius) {
    Polyline loop;
    constexpr int corners = 24;
    for (int k = 0; k < corners; ++k) {
        const double a = 2.0 * std::numbers::pi * k / corners;
        loop.push_back({centre.x + radius * std::cos(a), centre.y + radius * std::sin(a)});
    }
    return loop;
}

void draw_lines(MapPage& page, const std::vector<PlanOutline>& things, const Stroke& stroke) {
    for (const PlanOutline& thing : things)
        page.add(open_lines(page.to_page(thing.lines), stroke));
}

void draw_faces(MapPage& page, const std::vector<PlanOutline>& things, const Colour& fill) {
    for (const PlanOutline& thing : things)
        for (const Polyline& face : page.to_page(thing.faces)) {
            Shape s;
            s.lines = {face};
            s.fill = fill;
            s.stroke = Stroke{fill, 0.1};
            page.add(std::move(s));
        }
}

void draw_luminaire(MapPage& page,
                    const PlanLuminaire& luminaire,
                    const LuminaireStyle& style) {
    const Point2 centre = page.to_page(Point2{luminaire.position.x, luminaire.position.y});
    Polyline body = page.to_page({luminaire.body}).front();
    const bool is_symbol = largest_side(body) < smallest_body;
    if (is_symbol)
        body = circle(centre, point_symbol_radius);
    Shape outline;
    outline.lines = {body};
    outline.fill = style.fill;
    outline.stroke = style.outline;
    page.add(std::move(outline));
    const Stroke thin{style.outline.colour, 0.7 * style.outline.width};
    if (is_symbol)
        page.add(open_lines(cross_in(centre), thin));
    const double c0 = std::hypot(luminaire.c0.x, luminaire.c0.y);
    if (c0 > 0.1) {
        const Point2 d{luminaire.c0.x / c0, -luminaire.c0.y / c0};
        const double border = distance_to_border(body, centre, d);
        page.add(open_lines(c0_mark(along(centre, d, border), d, style.c0), style.outline));
    }
    if (const double lean = std::hypot(luminaire.nadir.x, luminaire.nadir.y); lean > inclined) {
        const Point2 d{luminaire.nadir.x / lean, -luminaire.nadir.y / lean};
        const double border = distance_to_border(body, centre, d);
        page.add(open_lines({{centre, along(centre, d, border + 2.0 + 4.0 * lean)}},
                            {style.outline.colour, 0.2, 0.6}));
    }
}

LegendEntry luminaire_entry(const LuminaireStyle& style, bool is_point, std::string text) {
    const Point2 centre{3.0, 0.0};
    const Point2 edge{is_point ? centre.x + point_symbol_radius : 5.0, 0.0};
    Shape body;
    if (is_point)
        body.lines = {circle(centre, point_symbol_radius)};
    else
        body.lines = {{{1.0, -1.5}, {5.0, -1.5}, {5.0, 1.5}, {1.0, 1.5}}};
    body.fill = style.fill;
    body.stroke = style.outline;
    std::vector<Shape> symbol{std::move(body)};
    if (is_point)
        symbol.push_back(open_lines(cross_in(centre), style.outline));
    symbol.push_back(open_lines(c0_mark(edge, {1.0, 0.0}, style.c0), style.outline));
    return {std::move(symbol), std::move(text)};
}

LegendEntry line_entry(const Stroke& stroke, std::string text) {
    return {{open_lines({{{0.5, 0.0}, {7.0, 0.0}}}, stroke)}, std::move(text)};
}

LegendEntry area_entry(const Colour& fill, const Stroke& stroke, std::string text) {
    Shape area;
    area.lines = {{{0.5, -1.5}, {7.0, -1.5}, {7.0, 1.5}, {0.5, 1.5}}};
    area.fill = fill;
    area.stroke = stroke;
    return {{area}, std::move(text)};
}

} // namespace isolux
