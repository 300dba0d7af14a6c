#pragma once

#include <random>
#include <vector>

#include "isolux/base/receiver.h"

#include "support/test_scene.h"

namespace isolux::test {

inline constexpr double furnace_exitance = 100.0; // lm/m2

/// A closed room of 3 m x 2.5 m x 2 m whose six surfaces all emit furnace_exitance and reflect
/// rho: E = M / (1 - rho) at every point and for every orientation, of which M is direct.
inline Builder furnace(double rho) {
    Builder b;
    const Point3 p{0, 0, 0};
    const Vector3 x{3, 0, 0};
    const Vector3 y{0, 2.5, 0};
    const Vector3 z{0, 0, 2};
    const auto m = b.add_diffuse(rho);
    b.add_room(p, {3, 2.5, 2}, m, m, m);
    b.add_panel(p, x, y, furnace_exitance * 7.5);
    b.add_panel(p + z, y, x, furnace_exitance * 7.5);
    b.add_panel(p, y, z, furnace_exitance * 5.0);
    b.add_panel(p + x, z, y, furnace_exitance * 5.0);
    b.add_panel(p, z, x, furnace_exitance * 6.0);
    b.add_panel(p + y, x, z, furnace_exitance * 6.0);
    return b;
}

/// Planes in all directions, 0.3 m and more from the walls.
inline std::vector<Receiver> furnace_points(std::size_t n) {
    std::vector<Receiver> points;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (std::size_t i = 0; i < n; ++i) {
        Receiver r;
        r.point = {0.3 + 2.4 * u(random), 0.3 + 1.9 * u(random), 0.3 + 1.4 * u(random)};
        r.axis = UnitVector3({u(random) - 0.5, u(random) - 0.5, u(random) - 0.5});
        points.push_back(r);
    }
    return points;
}

} // namespace isolux::test
