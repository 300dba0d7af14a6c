#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "isolux/calc/calculate.h"

/// A small room with one luminaire and one point, calculated through the library. Its direct
/// light is known: a source of 1000 lm in every direction, 2 m above the point.
int main() {
    using namespace isolux;
    SceneDescription description;
    description.materials = {{"white", Opaque{Rgb::grey(0.5), 0.0}}};
    Room room;
    room.name = "room";
    room.footprint = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    room.height = 3;
    room.walls.resize(4);
    description.rooms.push_back(std::move(room));
    LuminaireType bulb;
    bulb.name = "bulb";
    bulb.source = IsotropicSource{Lumen(1000)};
    description.luminaire_types.push_back(std::move(bulb));
    LuminairePlacement hung;
    hung.name = "bulb 1";
    hung.world_from_luminaire.origin = {2, 2, 2.5};
    description.luminaires.push_back(std::move(hung));

    CalculationSurface surface;
    surface.name = "desk";
    surface.receivers.push_back({{2, 2, 0.5}, UnitVector3::from_unit({0, 0, 1})});

    const Scene scene = build_scene(std::move(description));
    const Results results = calculate(scene, {&surface, 1}, Settings{});
    const PointResult& point = results.surfaces.front().points.front();
    std::printf("direct %.6f lx, total %.3f lx, standard error %.3f lx\n",
                point.direct.mean,
                point.total.mean,
                point.total.standard_error);
    const double expected = 1000 / (4 * std::numbers::pi) / 4;
    const bool is_right = std::abs(point.direct.mean - expected) < 1e-6 * expected
                          && point.indirect.mean > 0 && results.converged;
    return is_right ? 0 : 1;
}
