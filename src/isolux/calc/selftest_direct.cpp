#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "isolux/calc/selftest.h"
#include "isolux/calc/selftest_answers.h"
#include "isolux/calc/selftest_scenes.h"
#include "isolux/measure/quantity.h"
#include "isolux/validate/inverse_square.h"
#include "isolux/validate/lambertian_shapes.h"

/// Light straight from the source: everything is known to many digits.
namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double luminance = 1000.0; ///< cd/m2 of every Lambertian opening

UnitVector3 unit(double x, double y, double z) { return UnitVector3(Vector3{x, y, z}); }

SelftestCase make_case(std::string name) {
    SelftestCase selftest;
    selftest.name = std::move(name);
    selftest.settings = selftest_settings();
    return selftest;
}

std::string place_of(const Receiver& r) {
    std::string place = fmt::format("({:g}, {:g}, {:g})", r.point.x, r.point.y, r.point.z);
    if (r.kind == IlluminanceKind::planar)
        return place
               + fmt::format(
                   " facing ({:.2g}, {:.2g}, {:.2g})", r.axis.x(), r.axis.y(), r.axis.z());
    return place + " " + std::string(quantity_name(r.kind));
}

/// Points around a source at (0, 0, 2): below, aside, tilted, above, facing away.
SelftestCase make_inverse_square() {
    SelftestCase selftest = make_case("inverse square and cosine law");
    const IdealPointSource source{{0, 0, 2}, Lumen(1000.0), {}, {}};
    selftest.scene = [source] {
        SceneDescription scene;
        add_isotropic_source(scene, source.position, source.flux);
        return scene;
    };
    for (const Receiver& r :
         {Receiver{{0, 0, 0}, unit(0, 0, 1)},
          Receiver{{1, 0, 0}, unit(0, 0, 1)},
          Receiver{{2, 0, 1}, unit(-1, 0, 0)},
          Receiver{{1.5, -1, 0.2}, unit(-0.5, 0.2, 0.8)},
          Receiver{{40, 9, 30}, unit(-1, 0, -1)},
          Receiver{{4, 0, 0}, unit(5, 0, 1)},
          Receiver{{1.5, 0.5, 1.2}, unit(0, 0, 1), IlluminanceKind::cylindrical},
          Receiver{{1.5, 0.5, 1.2},
                   unit(0, 0, 1),
                   IlluminanceKind::semi_cylindrical,
                   unit(-1, 0.5, 0)},
          Receiver{{1.5, 0.5, 1.2}, unit(0, 0, 1), IlluminanceKind::hemispherical},
          Receiver{{1.5, 0.5, 1.2}, unit(0, 0, 1), IlluminanceKind::mean_spherical}})
        add_point(selftest, place_of(r), r, Part::total, point_source_illuminance(source, r));
    return selftest;
}

/// A rectangle 1.3 m x 0.7 m that faces down.
SelftestCase make_horizontal_rectangle() {
    SelftestCase selftest = make_case("Lambertian rectangle, parallel");
    constexpr double a = 1.3, b = 0.7, height = 0.9;
    selftest.scene = [] {
        SceneDescription scene;
        Frame frame;
        frame.origin = {0, 0, height};
        add_lambertian_source(scene,
                              frame,
                              {OpeningShape::rectangle, Metre(a), Metre(b), Metre(0)},
                              Lumen(pi * luminance * a * b));
        return scene;
    };
    for (const auto& [x, y] :
         {std::pair{0.0, 0.0}, {0.5 * a, 0.5 * b}, {1.1, -0.4}, {2.5, 1.5}}) {
        const ParallelRectangle seen{
            -0.5 * a - x, 0.5 * a - x, -0.5 * b - y, 0.5 * b - y, height};
        const Receiver r{{x, y, 0}, unit(0, 0, 1)};
        add_point(selftest,
                  place_of(r),
                  r,
                  Part::total,
                  illuminance_from(seen, CandelaPerSquareMetre(luminance)));
    }
    return selftest;
}

/// The same rectangle upright in the plane x = 0.9, from z = -0.3 up: the horizon of the
/// receivers cuts it.
SelftestCase make_upright_rectangle() {
    SelftestCase selftest = make_case("Lambertian rectangle, upright, cut by the horizon");
    constexpr double height = 1.3, width = 0.7, distance = 0.9, foot = -0.3;
    selftest.scene = [] {
        SceneDescription scene;
        const Frame frame{{distance, 0, foot + 0.5 * height},
                          unit(0, 0, 1),
                          unit(0, -1, 0),
                          unit(1, 0, 0)}; // shines towards -x
        add_lambertian_source(scene,
                              frame,
                              {OpeningShape::rectangle, Metre(height), Metre(width), Metre(0)},
                              Lumen(pi * luminance * height * width));
        return scene;
    };
    for (const auto& [y, z] : {std::pair{0.0, 0.0}, {0.35, 0.0}, {-0.8, 0.2}, {0.1, -0.9}}) {
        const PerpendicularRectangle seen{
            -0.5 * width - y, 0.5 * width - y, foot - z, foot + height - z, distance};
        const Receiver r{{0, y, z}, unit(0, 0, 1)};
        add_point(selftest,
                  place_of(r),
                  r,
                  Part::total,
                  illuminance_from(seen, CandelaPerSquareMetre(luminance)));
    }
    return selftest;
}

/// The engine takes a polygon of equal area for the disc; the allowance is what that may cost.
SelftestCase make_disc() {
    SelftestCase selftest = make_case("Lambertian disc");
    constexpr double radius = 0.5, height = 1.2, allowance = 1e-3;
    selftest.scene = [] {
        SceneDescription scene;
        Frame frame;
        frame.origin = {0, 0, height};
        add_lambertian_source(
            scene,
            frame,
            {OpeningShape::ellipse, Metre(2 * radius), Metre(2 * radius), Metre(0)},
            Lumen(pi * luminance * pi * radius * radius));
        return scene;
    };
    for (const double x : {0.0, 0.5, 2.0}) {
        const Receiver r{{x, 0, 0}, unit(0, 0, 1)};
        add_point(selftest,
                  place_of(r),
                  r,
                  Part::total,
                  illuminance_from(LambertianDisc{radius, height, x},
                                   CandelaPerSquareMetre(luminance)),
                  allowance);
    }
    const Receiver r{{2, 0, 0}, unit(-1, 0, 0)};
    add_point(selftest,
              place_of(r),
              r,
              Part::total,
              vertical_illuminance_from(LambertianDisc{radius, height, 2.0},
                                        CandelaPerSquareMetre(luminance)),
              allowance);
    return selftest;
}

/// A rotationally symmetric table I = 100 + 900 cos^4, hung tilted and turned. At its own nodes
/// the interpolant is the table.
SelftestCase make_table() {
    SelftestCase selftest = make_case("tabulated luminaire, tilted");
    constexpr int step = 10; ///< degrees between nodes
    const auto intensity = [](double gamma) {
        return gamma > 0.5 * pi ? 0.0 : 100.0 + 900.0 * std::pow(std::cos(gamma), 4);
    };
    const Frame frame =
        make_tilted_frame({0.5, -0.3, 2.5}, degrees(20), degrees(35), degrees(110));
    selftest.scene = [intensity, frame] {
        std::vector<Angle> gammas;
        std::vector<double> candela;
        for (int g = 0; g <= 90; g += step)
            gammas.push_back(degrees(g));
        for (int plane = 0; plane < 2; ++plane) {
            for (const Angle g : gammas)
                candela.push_back(intensity(g.in_radians()));
        }
        LuminaireType type;
        type.name = "table";
        type.source = LuminairePhotometry{
            .symmetry = "rotational",
            .planes_in_file = 1,
            .gammas_in_file = gammas.size(),
            .manufacturer = {},
            .name = {},
            .catalogue_number = {},
            .distribution = IntensityDistribution({degrees(0), degrees(360)}, gammas, candela),
            .opening = {},
            .housing = {},
            .is_absolute = true,
            .declared_flux = {},
            .lamp_sets = {}};
        SceneDescription scene;
        scene.luminaire_types.push_back(std::move(type));
        scene.luminaires.push_back({"spot", LuminaireTypeId(0), frame, 1.0, ""});
        return scene;
    };
    for (const int g : {0, 30, 60, 80}) {
        const double gamma = degrees(g).in_radians();
        const double c = degrees(50 + g).in_radians();
        const double range = 3.0 + 0.01 * g;
        const UnitVector3 down(frame.vector_from_local(
            {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)}));
        const Receiver r{frame.origin + range * Vector3(down), -down};
        add_point(selftest,
                  fmt::format("gamma {}, {:g} m", g, range),
                  r,
                  Part::total,
                  Lux(intensity(gamma) / (range * range)));
    }
    return selftest;
}

} // namespace

std::vector<SelftestCase> make_direct_cases() {
    return {make_inverse_square(),
            make_table(),
            make_horizontal_rectangle(),
            make_upright_rectangle(),
            make_disc()};
}

} // namespace isolux
