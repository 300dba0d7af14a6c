#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/measure/surface_grid.h"
#include "isolux/scene/scene.h"

/// Rooms to measure speed in, made in code so that every machine measures the same ones. Each
/// is a kind of task that asks something else of the engine.
namespace isolux {

/// A scene, the points in it, and the error and the time worth aiming at.
struct BenchRoom {
    std::string name;
    std::string description;
    SceneDescription scene;
    std::vector<CalculationSurface> surfaces;
    double rms_error = 0.01;  ///< relative, root mean square over the points
    double cpu_seconds = 0.0; ///< aim for that error on one core, scene built; 0: none
};

/// Names that make_bench_room knows:
/// * "empty-room": 96 points, 4 panels in the ceiling, nothing in the way
/// * "corridor": 140 points along an L-shaped corridor that one panel lights round its corner
/// * "large-office": 2330 points, 24 direct/indirect linear luminaires, 113 boxes
/// * "many-points": 24 000 points in an empty room
/// * "many-luminaires": 96 points under 200 panels
/// * "plain-office": 300 points between desks without screens
/// * "furnished-office": 300 points between desks and screens, close together
/// * "near-walls": the same office, points 2 to 80 cm from a wall and just above the floor
/// * "doorway": a room that is lit through an open door only
[[nodiscard]] std::span<const std::string_view> bench_room_names() noexcept;

/// @pre `name` is one of bench_room_names()
[[nodiscard]] BenchRoom make_bench_room(std::string_view name);

/// An empty room with `columns` x `rows` points on its work plane under panels of 0.6 m x 0.6 m
/// that hang in `panels_x` x `panels_y` even rows; the room grows with the panels, from 6 m x 4
/// m on, to 9 m2 for each of them at least. For cost against points and luminaires.
/// @pre all at least 1
[[nodiscard]] BenchRoom make_empty_bench_room(std::size_t columns,
                                              std::size_t rows,
                                              std::size_t panels_x,
                                              std::size_t panels_y);

/// The same in a hall of 60 m x 40 m x 6 m, however many panels there are: for cost against
/// luminaires alone.
[[nodiscard]] BenchRoom make_hall_bench_room(std::size_t columns,
                                             std::size_t rows,
                                             std::size_t panels_x,
                                             std::size_t panels_y);

} // namespace isolux
