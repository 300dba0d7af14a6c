#include "isolux/viz/room_drawing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/viz/drawing_parts.h"
#include "isolux/viz/map_page.h"
#include "isolux/viz/plan_parts.h"
#include "isolux/viz/plan_symbols.h"

namespace isolux {

namespace {

constexpr double slack = 1e-3;       // m
constexpr double dimension_at = 4.5; // mm outside the wall
constexpr double shortest = 6.5;     // mm, walls shorter than that get no number
constexpr double dimension_size = 2.4;

bool is_inside(const Polyline& face, const Point2& p) {
    bool inside = false;
    for (std::size_t i = 0, j = face.size() - 1; i < face.size(); j = i++)
        if ((face[i].y > p.y) != (face[j].y > p.y)
            && p.x < (face[j].x - face[i].x) * (p.y - face[i].y) / (face[j].y - face[i].y)
                         + face[i].x)
            inside = !inside;
    return inside;
}

bool covers(const PlanOutline& room, const Point2& p) {
    return std::any_of(room.faces.begin(), room.faces.end(), [&](const Polyline& face) {
        return face.size() >= 3 && is_inside(face, p);
    });
}

bool is_same(const Point2& a, const Point2& b) {
    return std::abs(a.x - b.x) < slack && std::abs(a.y - b.y) < slack;
}

double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }

Point2 direction(const WallLine& w) {
    const double l = w.length();
    return {(w.to.x - w.from.x) / l, (w.to.y - w.from.y) / l};
}

/// Appends `next` to `wall` where it goes on in the same line.
bool join(WallLine& wall, const WallLine& next) {
    if (std::abs(cross(direction(wall), direction(next))) > 1e-6)
        return false;
    for (int turn = 0; turn < 4; ++turn) {
        Point2& end = turn < 2 ? wall.to : wall.from;
        const Point2& start = turn % 2 == 0 ? next.from : next.to;
        if (is_same(end, start)) {
            end = turn % 2 == 0 ? next.to : next.from;
            return true;
        }
    }
    return false;
}

void merge(std::vector<WallLine>& walls) {
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < walls.size() && !changed; ++i)
            for (std::size_t j = i + 1; j < walls.size() && !changed; ++j)
                if (join(walls[i], walls[j])) {
                    walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(j));
                    changed = true;
                }
    }
}

/// A dimension: a line with ticks at its ends, beside the wall, and the length on it.
void draw_dimension(MapPage& page, const WallLine& wall) {
    const double length = wall.length() * page.mm_per_metre();
    if (length < shortest)
        return;
    const Point2 out{dimension_at * wall.outside.x, -dimension_at * wall.outside.y};
    const Point2 a = page.to_page(wall.from);
    const Point2 b = page.to_page(wall.to);
    const Point2 from{a.x + out.x, a.y + out.y};
    const Point2 to{b.x + out.x, b.y + out.y};
    const Stroke thin{ink::grey, 0.15, 0.0};
    page.add(make_line({from, to}, thin));
    for (const Point2& end : {from, to})
        page.add(make_line({{end.x - 0.8, end.y + 0.8}, {end.x + 0.8, end.y - 0.8}}, thin));
    Text t = make_text(fmt::format("{:.2f}", wall.length()),
                       {0.5 * (from.x + to.x), 0.5 * (from.y + to.y)},
                       dimension_size,
                       Anchor::middle);
    double turn = std::atan2(from.y - to.y, to.x - from.x);
    const double pi = std::acos(-1.0);
    if (turn > 0.5 * pi + 1e-9)
        turn -= pi;
    if (turn <= -0.5 * pi + 1e-9)
        turn += pi;
    t.turn = turn * 180.0 / pi;
    const double drop = 0.5 * cap_height * dimension_size;
    t.at = {t.at.x + drop * std::sin(turn), t.at.y + drop * std::cos(turn)};
    t.halo = ink::white;
    page.add(std::move(t));
}

Extent extent_of(const PlanOutline& room) {
    Extent e;
    for (const Polyline& line : room.lines)
        for (const Point2& p : line)
            e.include(p);
    if (e.is_empty())
        e.include({0.0, 0.0});
    return e;
}

bool touches(const Extent& a, const Extent& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y
           && b.low.y <= a.high.y;
}

/// What of the plan lies in the room.
Plan part_of(const Plan& plan, const PlanOutline& room) {
    Plan part;
    part.types = plan.types;
    part.rooms = {room};
    const Extent extent = extent_of(room);
    for (const PlanOutline& object : plan.objects)
        if (object.upper >= room.lower - slack && object.lower <= room.upper + slack
            && touches(extent_of(object), extent))
            part.objects.push_back(object);
    part.luminaires = luminaires_in(plan, room);
    for (const SceneOpening& o : plan.openings)
        if (o.room == room.name)
            part.openings.push_back(o);
    return part;
}

/// A surface on a wall belongs to the room it faces.
bool lies_in(const CalculationSurface& surface, const PlanOutline& room) {
    constexpr double before = 0.01; // m
    return std::any_of(surface.receivers.begin(), surface.receivers.end(), [&](const auto& r) {
        return r.point.z >= room.lower - slack && r.point.z <= room.upper + slack
               && covers(room,
                         {r.point.x + before * r.axis.x(), r.point.y + before * r.axis.y()});
    });
}

} // namespace

double WallLine::length() const noexcept { return std::hypot(to.x - from.x, to.y - from.y); }

std::vector<WallLine> find_walls(const PlanOutline& room) {
    std::vector<WallLine> walls;
    for (const Polyline& line : room.lines)
        for (std::size_t k = 0; k + 1 < line.size(); ++k)
            if (!is_same(line[k], line[k + 1]))
                walls.push_back({line[k], line[k + 1], {}});
    constexpr std::size_t most = 600; // a finer outline is no set of walls
    if (walls.size() > most)
        return {};
    merge(walls);
    for (WallLine& w : walls) {
        const Point2 d = direction(w);
        w.outside = {-d.y, d.x};
        constexpr double step = 0.01;
        const Point2 beside{0.5 * (w.from.x + w.to.x) + step * w.outside.x,
                            0.5 * (w.from.y + w.to.y) + step * w.outside.y};
        if (covers(room, beside))
            w.outside = {d.y, -d.x};
    }
    return walls;
}

double area_of(const PlanOutline& outline) {
    double twice = 0.0;
    for (const Polyline& face : outline.faces) {
        double sum = 0.0;
        for (std::size_t k = 0; k < face.size(); ++k)
            sum += cross(face[k], face[(k + 1) % face.size()]);
        twice += std::abs(sum);
    }
    return 0.5 * twice;
}

std::vector<PlanLuminaire> luminaires_in(const Plan& plan, const PlanOutline& room) {
    std::vector<PlanLuminaire> inside;
    for (const PlanLuminaire& l : plan.luminaires)
        if (l.position.z >= room.lower - slack && l.position.z <= room.upper + slack
            && covers(room, {l.position.x, l.position.y}))
            inside.push_back(l);
    return inside;
}

Drawing draw_room(const PlanOutline& room,
                  const Plan& plan,
                  std::span<const CalculationSurface> surfaces,
                  const std::string& project,
                  double largest_width) {
    const Plan part = part_of(plan, room);
    std::vector<CalculationSurface> here;
    for (const CalculationSurface& s : surfaces)
        if (lies_in(s, room))
            here.push_back(s);
    const Extent extent = extent_of(room);
    const double larger = std::max(extent.width(), extent.height());
    PageText text;
    text.title = room.name;
    text.project = project;
    text.largest_width = largest_width;
    text.remarks = {fmt::format("{:.2f} m², {:.2f} m high, {} luminaires",
                                area_of(room),
                                room.upper - room.lower,
                                part.luminaires.size())};
    MapPage page(text,
                 extent.grown(0.07 * larger, 1.0),
                 {"x", "y"},
                 {},
                 make_plan_entries(part, !here.empty()));
    page.open_clip({page.frame()});
    draw_plan_parts(page, part, here);
    for (const WallLine& wall : find_walls(room))
        draw_dimension(page, wall);
    page.close_clip();
    return std::move(page).finish();
}

} // namespace isolux
