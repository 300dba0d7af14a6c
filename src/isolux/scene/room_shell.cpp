#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "isolux/scene/scene.h"
#include "isolux/scene/triangulate.h"

/// The shell of a room. Every wall is cut along the edges of its openings into a grid of
/// rectangles; floor, ceiling and neighbouring walls take over the grid's points along their
/// common edges, so that the shell has no gaps and no T-shaped joints.
namespace isolux {
namespace {

/// Cuts closer together than this, in metres, become one: less than the step by which rays
/// leave a surface, so no light could use the slit.
constexpr double least_slit = 1e-5;

struct Rectangle {
    double s0 = 0.0; ///< m along the wall
    double s1 = 0.0;
    double z0 = 0.0; ///< m, height in the world
    double z1 = 0.0;

    [[nodiscard]] bool holds(double s, double z) const noexcept {
        return s0 < s && s < s1 && z0 < z && z < z1;
    }
};

/// Adds a cut unless there is one; returns where it is.
double add_cut(std::vector<double>& cuts, double at) {
    for (const double c : cuts)
        if (std::abs(c - at) <= least_slit)
            return c;
    cuts.push_back(at);
    return at;
}

/// A wall from corner `a` to corner `b`, the room on its left.
struct Wall {
    Point2 a;
    Point2 b;
    double length = 0.0;

    Wall(const Point2& from, const Point2& to)
        : a(from), b(to), length(std::hypot(to.x - from.x, to.y - from.y)) {}

    [[nodiscard]] Point2 at(double s) const noexcept {
        if (s == length)
            return b; // to the last bit
        return {a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)};
    }

    [[nodiscard]] double along(const Point2& p) const noexcept {
        return ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / length;
    }

    [[nodiscard]] double beside(const Point2& p) const noexcept {
        return ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
    }
};

Wall wall_of(const Room& room, std::size_t k) {
    return {room.footprint[k], room.footprint[(k + 1) % room.footprint.size()]};
}

Rectangle rectangle_of(const Room& room, const WallOpening& opening) {
    const double z = room.floor_level + opening.sill;
    return {opening.offset, opening.offset + opening.width, z, z + opening.height};
}

/// Where a neighbour's opening lies on this wall, if the two walls stand back to back in one
/// plane.
std::optional<Rectangle>
seen_on(const Wall& wall, const Room& neighbour, const WallOpening& opening) {
    if (opening.wall >= neighbour.footprint.size())
        return std::nullopt;
    const Wall other = wall_of(neighbour, opening.wall);
    const Rectangle r = rectangle_of(neighbour, opening);
    const double s0 = wall.along(other.at(r.s1)), s1 = wall.along(other.at(r.s0));
    if (s0 >= s1 || std::abs(wall.beside(other.at(r.s0))) > least_slit
        || std::abs(wall.beside(other.at(r.s1))) > least_slit)
        return std::nullopt;
    return Rectangle{s0, s1, r.z0, r.z1};
}

/// A part of a wall that is not wall.
struct Cutout {
    Rectangle where;
    std::optional<std::uint32_t> slot; ///< of the leaf or pane; none: a hole
};

class ShellBuilder {
public:
    ShellBuilder(const Room& room, std::span<const Room> neighbours)
        : room_(room), cuts_(room.footprint.size()),
          cutouts_(room.footprint.size()), levels_{room.floor_level,
                                                   room.floor_level + room.height} {
        add_slot("floor", room.floor);
        add_slot("ceiling", room.ceiling);
        for (std::size_t k = 0; k < room.footprint.size(); ++k) {
            add_slot(fmt::format("wall {}", k + 1), room.walls[k]);
            cuts_[k] = {0.0, wall_of(room, k).length};
        }
        for (std::size_t i = 0; i < room.openings.size(); ++i)
            add_opening(room.openings[i], i);
        for (const Room& neighbour : neighbours)
            if (&neighbour != &room)
                add_openings_of(neighbour);
    }

    Object build() {
        for (auto& cuts : cuts_)
            std::ranges::sort(cuts);
        std::ranges::sort(levels_);
        add_walls();
        add_floor_and_ceiling();
        add_columns();
        return {room_.name,
                SurfaceMesh(points_, faces_, slot_of_face_, slots_),
                std::move(material_of_slot_)};
    }

private:
    std::uint32_t add_slot(std::string name, MaterialId material) {
        slots_.push_back(std::move(name));
        material_of_slot_.push_back(material);
        return static_cast<std::uint32_t>(slots_.size() - 1);
    }

    void add_opening(const WallOpening& opening, std::size_t index);
    void add_openings_of(const Room& neighbour);
    void add_cutout(std::size_t wall, const Rectangle& r, std::optional<std::uint32_t> slot);
    void add_walls();
    void add_cell(const Wall& wall, const Rectangle& r, std::uint32_t slot);
    void add_floor_and_ceiling();
    void add_columns();
    void add_face(std::initializer_list<Point3> corners, std::uint32_t slot);

    const Room& room_;
    std::vector<std::vector<double>> cuts_; ///< of each wall, along it
    std::vector<std::vector<Cutout>> cutouts_;
    std::vector<double> levels_; ///< heights of all cuts, for all walls alike
    std::vector<std::string> slots_;
    std::vector<MaterialId> material_of_slot_;
    std::vector<Point3> points_;
    std::vector<std::vector<std::uint32_t>> faces_;
    std::vector<std::uint32_t> slot_of_face_;
};

void ShellBuilder::add_opening(const WallOpening& opening, std::size_t index) {
    std::optional<std::uint32_t> slot;
    if (opening.state != OpeningState::open)
        slot = add_slot(opening.name.empty() ? fmt::format("opening {}", index + 1)
                                             : fmt::format("opening {}", opening.name),
                        opening.material);
    if (opening.wall < cutouts_.size())
        add_cutout(opening.wall, rectangle_of(room_, opening), slot);
}

/// What is a hole or a pane on the other side cannot be wall on this one. The room's own
/// openings come first in the list and win where both overlap.
void ShellBuilder::add_openings_of(const Room& neighbour) {
    for (const WallOpening& opening : neighbour.openings)
        for (std::size_t k = 0; k < cutouts_.size() && opening.state != OpeningState::closed;
             ++k)
            if (const auto r = seen_on(wall_of(room_, k), neighbour, opening))
                add_cutout(k, *r, std::nullopt);
}

void ShellBuilder::add_cutout(std::size_t wall,
                              const Rectangle& r,
                              std::optional<std::uint32_t> slot) {
    const double length = wall_of(room_, wall).length;
    const double top = room_.floor_level + room_.height;
    Rectangle in{std::clamp(r.s0, 0.0, length),
                 std::clamp(r.s1, 0.0, length),
                 std::clamp(r.z0, room_.floor_level, top),
                 std::clamp(r.z1, room_.floor_level, top)};
    if (in.s1 - in.s0 <= least_slit || in.z1 - in.z0 <= least_slit)
        return;
    in = {add_cut(cuts_[wall], in.s0),
          add_cut(cuts_[wall], in.s1),
          add_cut(levels_, in.z0),
          add_cut(levels_, in.z1)};
    cutouts_[wall].push_back({in, slot});
}

void ShellBuilder::add_walls() {
    constexpr std::uint32_t first_wall = 2; // after floor and ceiling
    for (std::uint32_t k = 0; k < cuts_.size(); ++k)
        for (std::size_t i = 0; i + 1 < cuts_[k].size(); ++i)
            for (std::size_t j = 0; j + 1 < levels_.size(); ++j) {
                const Rectangle cell{cuts_[k][i], cuts_[k][i + 1], levels_[j], levels_[j + 1]};
                const auto found = std::ranges::find_if(cutouts_[k], [&](const Cutout& c) {
                    return c.where.holds(0.5 * (cell.s0 + cell.s1), 0.5 * (cell.z0 + cell.z1));
                });
                if (found == cutouts_[k].end())
                    add_cell(wall_of(room_, k), cell, first_wall + k);
                else if (found->slot)
                    add_cell(wall_of(room_, k), cell, *found->slot);
            }
}

/// A rectangle of a wall, its front to the room.
void ShellBuilder::add_cell(const Wall& wall, const Rectangle& r, std::uint32_t slot) {
    const Point2 p = wall.at(r.s0), q = wall.at(r.s1);
    add_face({{p.x, p.y, r.z0}, {p.x, p.y, r.z1}, {q.x, q.y, r.z1}, {q.x, q.y, r.z0}}, slot);
}

void ShellBuilder::add_floor_and_ceiling() {
    std::vector<std::vector<Point2>> rings(1);
    for (std::size_t k = 0; k < cuts_.size(); ++k)
        for (std::size_t i = 0; i + 1 < cuts_[k].size(); ++i)
            rings[0].push_back(wall_of(room_, k).at(cuts_[k][i]));
    for (const Column& column : room_.columns) {
        rings.push_back(column.outline);
        if (signed_area(column.outline) > 0.0)
            std::ranges::reverse(rings.back());
    }
    std::vector<Point2> flat;
    for (const auto& ring : rings)
        flat.insert(flat.end(), ring.begin(), ring.end());
    const double low = levels_.front(), high = levels_.back();
    for (const auto& t : triangulate(rings)) {
        const Point2 &a = flat[t[0]], &b = flat[t[1]], &c = flat[t[2]];
        add_face({{a.x, a.y, low}, {b.x, b.y, low}, {c.x, c.y, low}}, 0);
        add_face({{a.x, a.y, high}, {c.x, c.y, high}, {b.x, b.y, high}}, 1);
    }
}

void ShellBuilder::add_columns() {
    for (std::size_t i = 0; i < room_.columns.size(); ++i) {
        const Column& column = room_.columns[i];
        const auto slot = add_slot(fmt::format("column {}", i + 1), column.material);
        auto outline = column.outline; // clockwise: the room is on the left of its edges, too
        if (signed_area(outline) > 0.0)
            std::ranges::reverse(outline);
        for (std::size_t k = 0; k < outline.size(); ++k) {
            const Wall side(outline[k], outline[(k + 1) % outline.size()]);
            add_cell(side, {0.0, side.length, levels_.front(), levels_.back()}, slot);
        }
    }
}

void ShellBuilder::add_face(std::initializer_list<Point3> corners, std::uint32_t slot) {
    auto& face = faces_.emplace_back();
    for (const Point3& p : corners) {
        face.push_back(static_cast<std::uint32_t>(points_.size()));
        points_.push_back(p);
    }
    slot_of_face_.push_back(slot);
}

} // namespace

Object make_room_shell(const Room& room, std::span<const Room> neighbours) {
    return ShellBuilder(room, neighbours).build();
}

} // namespace isolux
