#include "isolux/photometry/ugr_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/photometry/position_index.h"
#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double height = 2.0; ///< H, luminaires above the eye, m

/// The table seen from the room: x across the line of sight, y along it, z up.
struct View {
    const LuminairePhotometry& luminaire;
    bool sees_plus_x = true; ///< the luminaire's +x points along the line of sight, else its +y

    [[nodiscard]] UnitVector3 to_luminaire(const Vector3& room) const {
        return sees_plus_x ? UnitVector3(Vector3{room.y, -room.x, room.z}) : UnitVector3(room);
    }
};

/// L^2 omega / p^2 = I^2 / (A r^2 p^2) of one luminaire; `at` relative to the eye.
double glare_of(const View& view, const Vector3& at) {
    const auto p = tabulated_position_index(at.z / at.y, std::abs(at.x) / at.y);
    if (!p)
        return 0.0;
    const UnitVector3 w = view.to_luminaire(-at);
    const double intensity = view.luminaire.distribution.evaluate(w).value();
    if (intensity == 0.0)
        return 0.0;
    const double area = projected_luminous_area(view.luminaire, w).value();
    return intensity * intensity / (area * length_squared(at) * *p * *p);
}

double sum_of_glare(const View& view, const UgrRoom& room, double spacing) {
    const int columns = static_cast<int>(std::lround(room.across * height / spacing));
    const int rows = static_cast<int>(std::lround(room.along * height / spacing));
    double sum = 0.0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            sum += glare_of(
                view,
                {(column + 0.5 - 0.5 * columns) * spacing, (row + 0.5) * spacing, height});
    return sum;
}

/// Downward rays of one luminaire, so that the rooms need not look at the table again.
struct Ray {
    double dx; ///< where it meets the plane of the eye, m from below the luminaire
    double dy;
    double flux; ///< lm
};

struct Rays {
    std::vector<Ray> down;
    double down_flux = 0.0;
    double up_flux = 0.0;
};

Rays make_rays(const View& view) {
    constexpr int rings = 180;
    constexpr int sectors = 144;
    Rays rays;
    for (int r = 0; r < 2 * rings; ++r) {
        const double g = pi * (r + 0.5) / (2 * rings);
        const double zone =
            std::cos(pi * r / (2 * rings)) - std::cos(pi * (r + 1) / (2 * rings));
        for (int s = 0; s < sectors; ++s) {
            const double c = 2 * pi * (s + 0.5) / sectors;
            const Vector3 w{std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)};
            const double flux =
                view.luminaire.distribution.evaluate(view.to_luminaire(w)).value() * zone * 2
                * pi / sectors;
            if (r >= rings) {
                rays.up_flux += flux;
            } else if (flux > 0.0) {
                rays.down_flux += flux;
                rays.down.push_back({-height * w.x / w.z, -height * w.y / w.z, flux});
            }
        }
    }
    return rays;
}

/// Of `count` luminaires in a row of the room's width, how many throw a ray that moves sideways
/// by `shift` onto the floor.
int count_inside(int count, double spacing, double shift) noexcept {
    const double first = 0.5 * spacing;
    const double lowest = std::ceil((-std::min(shift, 0.0) - first) / spacing - 1e-9);
    const double highest =
        std::floor((count * spacing - std::max(shift, 0.0) - first) / spacing + 1e-9);
    return std::max(0,
                    static_cast<int>(std::min(highest, count - 1.0))
                        - static_cast<int>(std::max(lowest, 0.0)) + 1);
}

/// Direct flux of all luminaires on ceiling, walls and the plane of the eye.
std::array<Lumen, 3> direct_flux(const Rays& rays, const UgrRoom& room, double spacing) {
    const int columns = static_cast<int>(std::lround(room.across * height / spacing));
    const int rows = static_cast<int>(std::lround(room.along * height / spacing));
    double floor = 0.0;
    for (const Ray& ray : rays.down) {
        if (std::abs(ray.dx) > columns * spacing || std::abs(ray.dy) > rows * spacing)
            continue;
        floor += ray.flux * count_inside(columns, spacing, ray.dx)
                 * count_inside(rows, spacing, ray.dy);
    }
    const double luminaires = static_cast<double>(columns) * rows;
    return {Lumen(luminaires * rays.up_flux),
            Lumen(luminaires * rays.down_flux - floor),
            Lumen(floor)};
}

UgrValues make_values(const View& view, double spacing) {
    const Rays rays = make_rays(view);
    UgrValues values{};
    for (std::size_t r = 0; r < ugr_rooms.size(); ++r) {
        const UgrRoom& room = ugr_rooms[r];
        const double glare = sum_of_glare(view, room, spacing);
        const auto flux = direct_flux(rays, room, spacing);
        for (std::size_t k = 0; k < ugr_reflectances.size(); ++k) {
            const double background = indirect_wall_illuminance(room.across * height,
                                                                room.along * height,
                                                                height,
                                                                flux,
                                                                ugr_reflectances[k])
                                          .value()
                                      / pi;
            values[r][k] = 8.0 * std::log10(0.25 * glare / background);
        }
    }
    return values;
}

/// View factor between two equal parallel rectangles x by y, a distance h apart.
double parallel_view_factor(double x, double y, double h) noexcept {
    const double a = x / h;
    const double b = y / h;
    const double a1 = 1 + a * a;
    const double b1 = 1 + b * b;
    return 2 / (pi * a * b)
           * (0.5 * std::log(a1 * b1 / (1 + a * a + b * b))
              + a * std::sqrt(b1) * std::atan(a / std::sqrt(b1))
              + b * std::sqrt(a1) * std::atan(b / std::sqrt(a1)) - a * std::atan(a)
              - b * std::atan(b));
}

} // namespace

Lux indirect_wall_illuminance(double x,
                              double y,
                              double h,
                              const std::array<Lumen, 3>& direct,
                              const UgrReflectances& rho) {
    const double plane = x * y;
    const double walls = 2 * (x + y) * h;
    const double across = parallel_view_factor(x, y, h); // ceiling to floor
    const double to_walls = 1 - across;                  // ceiling or floor to walls
    const double back = to_walls * plane / walls;        // walls to ceiling, and to floor
    const double among = 1 - 2 * back;                   // walls to walls
    // E_i = D_i + sum of F_ij rho_j E_j; ceiling and floor are eliminated in favour of the
    // walls
    const double dc = direct[0].value() / plane;
    const double dw = direct[1].value() / walls;
    const double df = direct[2].value() / plane;
    const double c = rho.ceiling;
    const double w = rho.walls;
    const double f = rho.plane;
    const double det = 1 - across * across * c * f;
    // E_c = (dc + across f df + to_walls w (1 + across f) E_w) / det, E_f likewise
    const double from_ceiling = back * c / det;
    const double from_floor = back * f / det;
    const double constant =
        from_ceiling * (dc + across * f * df) + from_floor * (df + across * c * dc);
    const double gain = among * w + from_ceiling * to_walls * w * (1 + across * f)
                        + from_floor * to_walls * w * (1 + across * c);
    const double total = (dw + constant) / (1 - gain);
    return Lux(total - dw);
}

std::optional<UgrTable> make_ugr_table(const LuminairePhotometry& l, double spacing_to_height) {
    const Angle slanting = degrees(60);
    for (const double c : {0.0, 90.0, 180.0, 270.0})
        if (!mean_luminance(l, degrees(c), slanting))
            return std::nullopt;
    const bool length_is_x = l.opening.extent_x > l.opening.extent_y;
    const double spacing = spacing_to_height * height;
    return UgrTable{spacing_to_height,
                    make_values({l, !length_is_x}, spacing),
                    make_values({l, length_is_x}, spacing)};
}

} // namespace isolux
