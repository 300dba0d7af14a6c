#include "isolux/calc/bench_rooms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "isolux/base/check.h"
#include "isolux/calc/selftest_scenes.h"
#include "isolux/scene/primitives.h"

namespace isolux {

namespace {

constexpr double desk_height = 0.75; // m, of the work plane

/// Reflectances of EN 12464-1's usual room: floor, ceiling, walls.
struct Shell {
    MaterialId floor, ceiling, wall;
};

Shell add_shell(SceneDescription& scene) {
    return {add_material(scene, 0.2), add_material(scene, 0.7), add_material(scene, 0.5)};
}

Frame frame_at(const Point3& p) {
    Frame f;
    f.origin = p;
    return f;
}

LuminousOpening rectangle(double x, double y) {
    LuminousOpening o;
    o.shape = OpeningShape::rectangle;
    o.extent_x = Metre(x);
    o.extent_y = Metre(y);
    return o;
}

CalculationSurface plane(std::string name,
                         const Point3& corner,
                         double x,
                         double y,
                         std::size_t nx,
                         std::size_t ny) {
    return make_grid_surface(std::move(name),
                             frame_at(corner),
                             Metre(x),
                             Metre(y),
                             {nx, ny},
                             {},
                             IlluminanceKind::planar,
                             UnitVector3::from_unit({1, 0, 0}));
}

void add_box(SceneDescription& scene,
             const Vector3& size,
             const Point3& at,
             MaterialId material) {
    SurfaceMesh mesh = make_box(size).transformed({1, 1, 1}, frame_at(at));
    scene.objects.push_back(
        {"box " + std::to_string(scene.objects.size() + 1), std::move(mesh), {material}});
}

/// Panels in nx x ny even rows just below the ceiling, one type for all of them.
void add_panels(SceneDescription& scene, const Point3& size, std::size_t nx, std::size_t ny) {
    const auto step_x = size.x / static_cast<double>(nx);
    const auto step_y = size.y / static_cast<double>(ny);
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const Point3 at{(static_cast<double>(i) + 0.5) * step_x,
                            (static_cast<double>(j) + 0.5) * step_y,
                            size.z - 0.01};
            if (scene.luminaires.empty()) {
                add_lambertian_source(scene, frame_at(at), rectangle(0.6, 0.6), Lumen(3600.0));
                continue;
            }
            LuminairePlacement next = scene.luminaires.front();
            next.name = "panel " + std::to_string(scene.luminaires.size() + 1);
            next.world_from_luminaire.origin = at;
            scene.luminaires.push_back(std::move(next));
        }
}

/// A linear pendant of 1.5 m that sends 60 % of 5000 lm down in a broad beam and the rest up.
LuminaireType make_pendant() {
    std::vector<Angle> gammas;
    std::vector<double> candela;
    for (int g = 0; g <= 180; g += 5) {
        const double c = std::cos(g * std::numbers::pi / 180.0);
        gammas.push_back(degrees(g));
        candela.push_back(c >= 0.0 ? c * std::sqrt(c) : -0.9 * c * (1.0 + 0.4 * c));
    }
    const std::size_t rows = gammas.size();
    candela.insert(candela.end(), candela.begin(), candela.begin() + static_cast<long>(rows));
    LuminairePhotometry photometry{
        .symmetry = "rotational",
        .manufacturer = {},
        .name = "pendant",
        .catalogue_number = {},
        .distribution = {{degrees(0), degrees(360)}, std::move(gammas), std::move(candela)},
        .opening = rectangle(1.5, 0.08),
        .housing = {},
        .declared_flux = {},
        .lamp_sets = {}};
    LuminaireType type;
    type.name = "direct/indirect pendant";
    type.flux_scale = 5000.0 / in_lumen(photometry.distribution.flux());
    type.opening = photometry.opening;
    type.source = std::move(photometry);
    return type;
}

void add_pendants(SceneDescription& scene, const Point3& size, std::size_t nx, std::size_t ny) {
    const LuminaireTypeId type(scene.luminaire_types.size());
    scene.luminaire_types.push_back(make_pendant());
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            LuminairePlacement p;
            p.name = "pendant " + std::to_string(scene.luminaires.size() + 1);
            p.type = type;
            p.world_from_luminaire =
                frame_at({(static_cast<double>(i) + 0.5) * size.x / static_cast<double>(nx),
                          (static_cast<double>(j) + 0.5) * size.y / static_cast<double>(ny),
                          size.z - 0.5});
            scene.luminaires.push_back(std::move(p));
        }
}

BenchRoom make_corridor() {
    BenchRoom b;
    b.description = "L-shaped corridor of 10 m x 8 m, 2 m wide, one panel at the end of an arm";
    const Shell m = add_shell(b.scene);
    Room room = make_box_room(10.0, 8.0, 2.7, m.floor, m.ceiling, m.wall);
    room.footprint = {{0, 0}, {10, 0}, {10, 8}, {8, 8}, {8, 2}, {0, 2}};
    room.walls.assign(6, m.wall);
    b.scene.rooms.push_back(std::move(room));
    add_lambertian_source(
        b.scene, frame_at({1.5, 1.0, 2.69}), rectangle(0.6, 0.6), Lumen(3600.0));
    b.surfaces.push_back(plane("arm 1", {0, 0, 0.01}, 10.0, 2.0, 20, 4));
    b.surfaces.push_back(plane("arm 2", {8, 2, 0.01}, 2.0, 6.0, 4, 15));
    b.rms_error = 0.02;
    b.cpu_seconds = 0.41;
    return b;
}

/// Desks, screens and cupboards in rows: 113 boxes.
BenchRoom make_large_office() {
    BenchRoom b;
    b.description = "office of 24 m x 15 m x 3 m, 24 direct/indirect pendants, 113 boxes";
    const Shell m = add_shell(b.scene);
    const MaterialId wood = add_material(b.scene, 0.4);
    const MaterialId fabric = add_material(b.scene, 0.3);
    b.scene.rooms.push_back(make_box_room(24.0, 15.0, 3.0, m.floor, m.ceiling, m.wall));
    for (std::size_t j = 0; j < 6; ++j)
        for (std::size_t i = 0; i < 9; ++i) {
            const double x = 2.0 + 2.5 * static_cast<double>(i);
            const double y = 1.6 + 2.35 * static_cast<double>(j);
            add_box(b.scene, {1.6, 0.8, 0.03}, {x, y, 0.70}, wood);
            add_box(b.scene, {1.6, 0.04, 0.5}, {x, y + 0.45, 0.73}, fabric);
        }
    for (std::size_t i = 0; i < 5; ++i)
        add_box(
            b.scene, {1.2, 0.45, 1.8}, {3.0 + 4.5 * static_cast<double>(i), 14.7, 0.0}, wood);
    add_pendants(b.scene, {24.0, 15.0, 3.0}, 6, 4);
    b.surfaces.push_back(plane("work plane", {0.25, 0.25, desk_height}, 23.5, 14.0, 58, 40));
    b.surfaces.push_back(plane("front desk", {1.3, 1.3, desk_height}, 1.0, 0.4, 5, 2));
    b.cpu_seconds = 4.9;
    return b;
}

/// A room of 8 m x 6 m x 2.8 m with 16 desks, screens, pedestals and a cupboard.
void furnish(SceneDescription& scene, const Shell& m) {
    const MaterialId wood = add_material(scene, 0.45);
    const MaterialId fabric = add_material(scene, 0.3);
    scene.rooms.push_back(make_box_room(8.0, 6.0, 2.8, m.floor, m.ceiling, m.wall));
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 4; ++i) {
            const double x = 1.3 + 1.8 * static_cast<double>(i);
            const double y = 0.9 + 1.35 * static_cast<double>(j);
            add_box(scene, {1.4, 0.7, 0.03}, {x, y, 0.70}, wood);
            add_box(scene, {1.4, 0.03, 0.4}, {x, y + 0.4, 0.73}, fabric);
            add_box(scene, {0.4, 0.5, 0.55}, {x + 0.45, y, 0.0}, fabric);
        }
    add_box(scene, {0.4, 2.4, 1.9}, {7.78, 3.0, 0.0}, wood);
    add_panels(scene, {8.0, 6.0, 2.8}, 3, 2);
}

BenchRoom make_furnished_office() {
    BenchRoom b;
    b.description = "office of 8 m x 6 m x 2.8 m with 16 desks, screens, pedestals, a cupboard";
    furnish(b.scene, add_shell(b.scene));
    b.surfaces.push_back(plane("work plane", {0.25, 0.25, desk_height}, 7.0, 5.5, 20, 15));
    b.rms_error = 0.002;
    b.cpu_seconds = 0.2;
    return b;
}

/// The same number of points in a room twice as large, with nothing upright on its desks.
BenchRoom make_plain_office() {
    BenchRoom b;
    b.description = "office of 12 m x 9 m x 3 m with 20 desks, pedestals, seats, 5 cupboards";
    const Shell m = add_shell(b.scene);
    const MaterialId wood = add_material(b.scene, 0.5);
    const MaterialId fabric = add_material(b.scene, 0.35);
    const MaterialId paint = add_material(b.scene, 0.6);
    b.scene.rooms.push_back(make_box_room(12.0, 9.0, 3.0, m.floor, m.ceiling, m.wall));
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t i = 0; i < 5; ++i) {
            const double x = 1.6 + 2.2 * static_cast<double>(i);
            const double y = 1.4 + 2.0 * static_cast<double>(j);
            add_box(b.scene, {1.6, 0.8, 0.03}, {x, y, 0.71}, wood);
            add_box(b.scene, {0.4, 0.6, 0.55}, {x + 0.5, y, 0.0}, paint);
            add_box(b.scene, {0.45, 0.45, 0.45}, {x, y + 0.7, 0.0}, fabric);
        }
    for (std::size_t i = 0; i < 5; ++i)
        add_box(
            b.scene, {1.0, 0.45, 1.8}, {2.0 + 1.5 * static_cast<double>(i), 8.77, 0.0}, paint);
    add_panels(b.scene, {12.0, 9.0, 3.0}, 4, 3);
    b.surfaces.push_back(plane("work plane", {0.5, 0.5, desk_height}, 11.0, 8.0, 20, 15));
    b.rms_error = 0.002;
    b.cpu_seconds = 0.2;
    return b;
}

/// 40 points just above the floor: five rows, eight distances from 2 to 80 cm.
BenchRoom make_near_walls() {
    BenchRoom b = make_furnished_office();
    b.description += ", points 2 to 80 cm from a wall";
    CalculationSurface s;
    s.name = "by the wall";
    for (std::size_t i = 0; i < 40; ++i) {
        const double d = 0.02 * std::pow(40.0, static_cast<double>(i % 8) / 7.0);
        s.receivers.push_back({{0.4 + 1.7 * static_cast<double>(i / 8), d, 0.1},
                               UnitVector3::from_unit({0, 0, 1})});
    }
    b.surfaces = {std::move(s)};
    b.rms_error = 0.01;
    b.cpu_seconds = 0.0;
    return b;
}

BenchRoom make_doorway() {
    BenchRoom b;
    b.description = "room of 4 m x 4 m beside one with two panels, an open door between them";
    const Shell m = add_shell(b.scene);
    const WallOpening door{"door", 1, 1.5, 0.0, 0.9, 2.1, OpeningState::open, {}};
    Room lit = make_box_room(5.0, 4.0, 2.7, m.floor, m.ceiling, m.wall);
    lit.name = "lit";
    lit.openings.push_back(door);
    Room dark = make_box_room(4.0, 4.0, 2.7, m.floor, m.ceiling, m.wall);
    dark.name = "dark";
    dark.footprint = {{5, 0}, {9, 0}, {9, 4}, {5, 4}};
    b.scene.rooms.push_back(std::move(lit));
    b.scene.rooms.push_back(std::move(dark));
    add_panels(b.scene, {5.0, 4.0, 2.7}, 2, 1);
    b.surfaces.push_back(plane("dark room", {5.0, 0.0, desk_height}, 4.0, 4.0, 10, 10));
    b.rms_error = 0.02;
    return b;
}

/// A room with nothing but its panels. @param points  on its work plane, along x and y
/// @param panels  likewise
BenchRoom make_empty(std::string name,
                     const Point3& size,
                     const std::array<std::size_t, 2>& points,
                     const std::array<std::size_t, 2>& panels) {
    BenchRoom b;
    b.name = std::move(name);
    b.description = std::to_string(points[0] * points[1]) + " points, "
                    + std::to_string(panels[0] * panels[1]) + " panels, nothing in the way";
    const Shell m = add_shell(b.scene);
    b.scene.rooms.push_back(make_box_room(size.x, size.y, size.z, m.floor, m.ceiling, m.wall));
    add_panels(b.scene, size, panels[0], panels[1]);
    b.surfaces.push_back(
        plane("work plane", {0, 0, desk_height}, size.x, size.y, points[0], points[1]));
    return b;
}

using Maker = BenchRoom (*)();

BenchRoom aimed(BenchRoom b, double seconds) {
    b.cpu_seconds = seconds;
    return b;
}

struct Entry {
    std::string_view name;
    Maker make;
};

constexpr std::array<Entry, 9> rooms{{
    {"empty-room", [] { return aimed(make_empty_bench_room(12, 8, 2, 2), 0.014); }},
    {"corridor", make_corridor},
    {"large-office", make_large_office},
    {"many-points", [] { return aimed(make_empty_bench_room(200, 120, 2, 2), 0.29); }},
    {"many-luminaires", [] { return aimed(make_empty_bench_room(12, 8, 20, 10), 0.086); }},
    {"plain-office", make_plain_office},
    {"furnished-office", make_furnished_office},
    {"near-walls", make_near_walls},
    {"doorway", make_doorway},
}};

constexpr auto names = [] {
    std::array<std::string_view, rooms.size()> all;
    std::transform(
        rooms.begin(), rooms.end(), all.begin(), [](const Entry& e) { return e.name; });
    return all;
}();

} // namespace

std::span<const std::string_view> bench_room_names() noexcept { return names; }

BenchRoom make_bench_room(std::string_view name) {
    const auto* entry = std::find_if(
        rooms.begin(), rooms.end(), [name](const Entry& e) { return e.name == name; });
    ISOLUX_EXPECT(entry != rooms.end());
    BenchRoom room = entry->make();
    room.name = name;
    return room;
}

BenchRoom make_empty_bench_room(std::size_t columns,
                                std::size_t rows,
                                std::size_t panels_x,
                                std::size_t panels_y) {
    const double x = std::max(6.0, 3.0 * static_cast<double>(panels_x));
    const double y = std::max(4.0, 3.0 * static_cast<double>(panels_y));
    return make_empty("empty room", Point3{x, y, 3.0}, {columns, rows}, {panels_x, panels_y});
}

BenchRoom make_hall_bench_room(std::size_t columns,
                               std::size_t rows,
                               std::size_t panels_x,
                               std::size_t panels_y) {
    return make_empty("hall", Point3{60.0, 40.0, 6.0}, {columns, rows}, {panels_x, panels_y});
}

} // namespace isolux
