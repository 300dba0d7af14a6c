#include "catalogue.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace {

using namespace isolux;

/// Relative intensity towards (C, gamma) in degrees; only its shape matters.
using Shape = std::function<double(double, double)>;

double in_radians(double degrees_) { return degrees_ * std::numbers::pi / 180.0; }

double cosine(double degrees_) { return std::max(0.0, std::cos(in_radians(degrees_))); }

double square(double x) { return x * x; }

/// 1 below `from`, 0 above `to`, smooth between: the shielding of a housing's rim.
double shield(double gamma, double from, double to) {
    const double t = std::clamp((gamma - from) / (to - from), 0.0, 1.0);
    return 1.0 - t * t * (3.0 - 2.0 * t);
}

/// A lobe around (C, gamma) that falls to one half at `half_width` degrees from its axis.
double lobe(double c, double gamma, double axis_c, double axis_gamma, double half_width) {
    const double cos_angle = cosine(gamma) * cosine(axis_gamma)
                             + std::sin(in_radians(gamma)) * std::sin(in_radians(axis_gamma))
                                   * std::cos(in_radians(c - axis_c));
    const double angle = std::acos(std::clamp(cos_angle, -1.0, 1.0)) * 180.0 / std::numbers::pi;
    return std::exp(-std::numbers::ln2 * square(angle / half_width));
}

/// How much of a direction lies across the axis y of a long luminaire: 1 in C0, 0 in C90.
double across(double c) { return square(std::cos(in_radians(c))); }

// ---- the shapes --------------------------------------------------------------------------

double lambertian(double, double gamma) { return cosine(gamma); }

double narrow_downlight(double c, double gamma) {
    return (lobe(c, gamma, 0, 0, 12) + 0.06 * square(cosine(gamma))) * shield(gamma, 45, 70);
}

double batwing_direct_indirect(double c, double gamma) {
    const auto wing = [](double g, double depth) {
        return cosine(g) * (1.0 + depth * square(std::sin(in_radians(g))));
    };
    const double t = across(c);
    if (gamma <= 90) {
        const double crosswise = wing(gamma, 1.6) * shield(gamma, 58, 84);
        const double lengthwise = cosine(gamma) * shield(gamma, 50, 84);
        return t * crosswise + (1.0 - t) * lengthwise;
    }
    const double up = 180.0 - gamma;
    const double crosswise = wing(up, 2.2) * shield(up, 70, 90);
    const double lengthwise = cosine(up) * shield(up, 60, 90);
    return 0.55 * (t * crosswise + (1.0 - t) * lengthwise);
}

/// Throws towards C0; the reflector hides the lamp on the room side.
double wall_washer(double c, double gamma) {
    return (lobe(c, gamma, 0, 38, 24) + 0.10 * cosine(gamma)) * shield(gamma, 62, 80);
}

double high_bay(double, double gamma) {
    return (0.8 + 0.9 * square(std::sin(in_radians(gamma)))) * cosine(gamma)
           * shield(gamma, 42, 78);
}

/// Two lobes along the road, turned a little to the street (C90); little light behind.
double street_lantern(double c, double gamma) {
    const double lobes = lobe(c, gamma, 18, 64, 17) + lobe(c, gamma, 162, 64, 17);
    const double street_side = 0.5 * (1.0 + std::sin(in_radians(c)));
    const double base =
        (0.10 + 0.25 * street_side * std::sin(in_radians(gamma))) * cosine(gamma);
    return (lobes + base) * shield(gamma, 72, 89);
}

// ---- from shape to luminaire -------------------------------------------------------------

struct Grid {
    double plane_step;
    double gamma_step;
    double last_gamma;
};

IntensityDistribution tabulate(const Shape& shape, const Grid& grid, double scale) {
    std::vector<Angle> planes;
    std::vector<Angle> gammas;
    for (int i = 0; i * grid.plane_step <= 360.0; ++i)
        planes.push_back(degrees(i * grid.plane_step));
    for (int i = 0; i * grid.gamma_step <= grid.last_gamma; ++i)
        gammas.push_back(degrees(i * grid.gamma_step));
    std::vector<double> candela;
    for (std::size_t p = 0; p < planes.size(); ++p)
        for (std::size_t g = 0; g < gammas.size(); ++g) {
            const double value =
                shape(static_cast<double>(p % (planes.size() - 1)) * grid.plane_step,
                      static_cast<double>(g) * grid.gamma_step);
            candela.push_back(std::round(10.0 * scale * value) / 10.0); // tenths of a candela
        }
    return {std::move(planes), std::move(gammas), std::move(candela)};
}

/// Scaled so that the interpolant gives `flux`, up to the rounding of the values.
IntensityDistribution with_flux(const Shape& shape, const Grid& grid, double flux) {
    constexpr double coarse = 1e6; // rounding does not matter yet
    return tabulate(shape, grid, coarse * flux / tabulate(shape, grid, coarse).flux().value());
}

LuminousOpening sized(OpeningShape shape, double x, double y, double z = 0.0) {
    return {shape, Metre(x), Metre(y), Metre(z)};
}

LuminairePhotometry make(std::string name,
                         std::string number,
                         IntensityDistribution distribution,
                         LuminousOpening opening,
                         LuminousOpening housing,
                         LampSet lamps) {
    const double watts = lamps.watts;
    const bool is_absolute = lamps.lamps < 0;
    return {.format = PhotometricFormat::lm63_2019,
            .photometric_type = 'C',
            .symmetry = {}, // the writers look for themselves
            .planes_in_file = 0,
            .gammas_in_file = 0,
            .manufacturer = "isolux samples",
            .name = std::move(name),
            .catalogue_number = std::move(number),
            .distribution = std::move(distribution),
            .opening = opening,
            .housing = housing,
            .is_absolute = is_absolute,
            .declared_flux = std::nullopt,
            .lamp_sets = {std::move(lamps)},
            .input_watts = watts};
}

LampSet led(double flux, double watts) {
    return {-1, "LED 4000 K", Lumen(flux), "4000", "80", watts};
}

} // namespace

std::vector<Sample> make_catalogue() {
    using enum OpeningShape;
    const Grid round_grid{360, 2.5, 90};
    std::vector<Sample> samples;
    samples.push_back({"lambertian-panel",
                       make("Lambertian panel 600 x 600",
                            "ISO-PANEL-600",
                            with_flux(lambertian, round_grid, 3600),
                            sized(rectangle, 0.570, 0.570),
                            sized(box, 0.595, 0.595, 0.035),
                            led(3600, 29))});
    samples.push_back({"narrow-downlight",
                       make("Narrow downlight, recessed",
                            "ISO-DOWN-24",
                            with_flux(narrow_downlight, round_grid, 1250),
                            sized(ellipse, 0.085, 0.085),
                            sized(vertical_cylinder, 0.110, 0.110, 0.120),
                            led(1250, 13.5))});
    samples.push_back({"batwing-linear",
                       make("Batwing linear pendant, direct/indirect",
                            "ISO-LINEAR-1500",
                            with_flux(batwing_direct_indirect, {15, 5, 180}, 6200),
                            sized(rectangle, 0.180, 1.480),
                            sized(box, 0.200, 1.500, 0.045),
                            led(6200, 46))});
    samples.push_back({"wall-washer",
                       make("Wall-washer, recessed, throws to C0",
                            "ISO-WASH-300",
                            with_flux(wall_washer, {15, 2.5, 90}, 2300),
                            sized(rectangle, 0.110, 0.290),
                            sized(box, 0.140, 0.320, 0.130),
                            led(2300, 22))});
    samples.push_back({"high-bay",
                       make("High bay with reflector, metal halide",
                            "ISO-BAY-250",
                            with_flux(high_bay, round_grid, 19200),
                            sized(ellipse, 0.480, 0.480),
                            sized(vertical_cylinder, 0.500, 0.500, 0.560),
                            {1, "HIT 250 W", Lumen(24000), "4200", "69", 276})});
    samples.push_back({"street-lantern",
                       make("Street lantern, street side C90",
                            "ISO-STREET-50",
                            with_flux(street_lantern, {15, 2.5, 90}, 6400),
                            sized(rectangle, 0.180, 0.260),
                            sized(box, 0.240, 0.580, 0.095),
                            led(6400, 49))});
    return samples;
}
