#include "isolux/calc/effort.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace isolux {

namespace {

/// Of the variance that is allowed the first look should find so much used up: half of the
/// points have more than the mean.
constexpr double aim = 0.7;

constexpr std::size_t fewest_samples = 4;
constexpr std::size_t most_samples = 256;

double power_of_two_above(double x, std::size_t least, std::size_t most) {
    const double bounded = std::clamp(x, static_cast<double>(least), static_cast<double>(most));
    return static_cast<double>(std::bit_ceil(static_cast<std::size_t>(std::ceil(bounded))));
}

} // namespace

double VarianceModel::of(const Effort& e) const noexcept {
    return paths / static_cast<double>(e.paths) + draws / static_cast<double>(e.draws)
           + directions / static_cast<double>(e.directions);
}

double UnitCosts::of(const Effort& e, std::size_t points) const noexcept {
    const double shared = path / static_cast<double>(std::max<std::size_t>(1, points));
    return static_cast<double>(e.paths) * (shared + pair) + static_cast<double>(e.draws) * draw
           + static_cast<double>(e.directions) * direction + point;
}

UnitCosts make_unit_costs(const Scene& scene, double vertices_per_path) {
    // Calibrated with tests/bench on one core of a server of 2023.
    const double triangles =
        static_cast<double>(std::max<std::size_t>(2, scene.triangles.size()));
    const double depth = 0.6 + 0.1 * std::log2(triangles); // of the search tree; 1 in a box
    const double luminaires =
        static_cast<double>(std::min<std::size_t>(64, scene.luminaires.size()));
    const double next_event = 120.0 + 3.0 * luminaires;
    UnitCosts c;
    c.path = (vertices_per_path + 1.0) * 220.0 * depth;
    c.pair = 0.4 * vertices_per_path;
    c.draw = 25.0 + 35.0 * depth;
    c.direction = next_event + 260.0 * depth;
    c.sample = (vertices_per_path + 0.5) * (next_event + 220.0 * depth);
    c.point = 150.0;
    return c;
}

EffortChoice
choose_effort(const VarianceModel& model, const UnitCosts& costs, std::size_t points) {
    EffortChoice best;
    double least = 0.0;
    for (std::size_t m = fewest_paths; m <= most_paths; m *= 2)
        for (std::size_t k = fewest_draws; k <= most_draws; k *= 2)
            for (std::size_t n = 1; n <= most_directions; n *= 2) {
                const Effort effort{m, k, n, best.effort.samples};
                const double units =
                    power_of_two_above((model.of(effort) + model.direct) / aim, 1, most_units);
                const double cost = units * costs.of(effort, points);
                if (least == 0.0 || cost < least) {
                    least = cost;
                    best = {effort, static_cast<std::size_t>(units)};
                }
            }
    return best;
}

Effort balance_effort(const VarianceModel& model,
                      const UnitCosts& costs,
                      std::size_t points,
                      std::size_t paths) {
    Effort best{paths, fewest_draws, 1, 0};
    double least = 0.0;
    for (std::size_t k = fewest_draws; k <= most_draws; k *= 2)
        for (std::size_t n = 1; n <= most_directions; n *= 2) {
            const Effort effort{paths, k, n, 0};
            const double cost = (model.of(effort) + model.direct) * costs.of(effort, points);
            if (least == 0.0 || cost < least) {
                least = cost;
                best = effort;
            }
        }
    return best;
}

std::size_t choose_samples(const VarianceModel& model, std::size_t units) {
    const double left = std::max(0.1, aim * static_cast<double>(units) - model.direct);
    return static_cast<std::size_t>(
        power_of_two_above(model.samples / left, fewest_samples, most_samples));
}

} // namespace isolux
