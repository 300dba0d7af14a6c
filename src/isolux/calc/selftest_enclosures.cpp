#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "isolux/calc/selftest.h"
#include "isolux/calc/selftest_answers.h"
#include "isolux/calc/selftest_scenes.h"
#include "isolux/validate/enclosure.h"
#include "isolux/validate/integrating_sphere.h"

/// Closed rooms: nothing escapes, so the flux fixes the answer.
namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

UnitVector3 unit(double x, double y, double z) { return UnitVector3(Vector3{x, y, z}); }

/// The reflected light is the same at every point of a sphere, wherever the source. The mesh
/// has 20480 triangles: its own area goes into the reference, and a facet that does not see
/// itself changes the value by its share of the area (5e-5) times the contrast, below 2e-4.
SelftestCase make_sphere_case(double offset) {
    constexpr double radius = 1.0, reflectance = 0.8, allowance = 2e-4;
    constexpr int halvings = 5;
    const Lumen flux(1000.0);
    SelftestCase selftest;
    selftest.name = fmt::format("integrating sphere, source {:g} m off the centre", offset);
    selftest.settings = selftest_settings();
    selftest.settings.tolerance = 0.01; // of the total, while the answers are about a part
    selftest.scene = [offset, flux] {
        SceneDescription scene;
        const MaterialId paint = add_material(scene, reflectance);
        scene.objects.push_back(make_sphere(radius, halvings, paint).object);
        add_isotropic_source(scene, {0, 0, offset}, flux);
        return scene;
    };
    const SphereMesh mesh = make_sphere(radius, halvings, MaterialId(0));
    const Metre equal_area_radius(std::sqrt(mesh.area / (4.0 * pi)));
    const Lux reference = sphere_indirect(equal_area_radius, reflectance, flux);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t facet = i * mesh.centres.size() / 4 + 17;
        const Receiver r{mesh.centres[facet], mesh.normals[facet]};
        add_point(selftest,
                  fmt::format("reflected light at z = {:.2f} m", r.point.z),
                  r,
                  Part::indirect,
                  reference,
                  allowance);
    }
    add_flux_balance(selftest, flux);
    return selftest;
}

/// A room whose surfaces all emit M and reflect rho: M/(1 - rho) everywhere, whichever way.
SelftestCase make_furnace(double reflectance) {
    constexpr double x = 4.0, y = 3.0, z = 2.5;
    constexpr double exitance = 100.0;
    SelftestCase selftest;
    selftest.name = fmt::format("furnace, reflectance {:g}", reflectance);
    selftest.settings = selftest_settings();
    selftest.scene = [reflectance] {
        SceneDescription scene;
        const MaterialId paint = add_material(scene, reflectance);
        scene.rooms.push_back(make_box_room(x, y, z, paint, paint, paint));
        struct Side {
            Point3 centre;
            Vector3 inwards;
            Vector3 along; ///< the opening's x axis
            double width;  ///< along that axis
            double height;
        };
        for (const Side& side : {Side{{0.5 * x, 0.5 * y, 0}, {0, 0, 1}, {1, 0, 0}, x, y},
                                 Side{{0.5 * x, 0.5 * y, z}, {0, 0, -1}, {1, 0, 0}, x, y},
                                 Side{{0, 0.5 * y, 0.5 * z}, {1, 0, 0}, {0, 1, 0}, y, z},
                                 Side{{x, 0.5 * y, 0.5 * z}, {-1, 0, 0}, {0, 1, 0}, y, z},
                                 Side{{0.5 * x, 0, 0.5 * z}, {0, 1, 0}, {1, 0, 0}, x, z},
                                 Side{{0.5 * x, y, 0.5 * z}, {0, -1, 0}, {1, 0, 0}, x, z}}) {
            const UnitVector3 up(-side.inwards);
            const UnitVector3 along(side.along);
            const Frame frame{side.centre, along, UnitVector3(cross(up, along)), up};
            add_lambertian_source(
                scene,
                frame,
                {OpeningShape::rectangle, Metre(side.width), Metre(side.height), Metre(0)},
                Lumen(exitance * side.width * side.height));
        }
        return scene;
    };
    const Lux reference = furnace_illuminance(exitance, reflectance);
    for (const Receiver& r :
         {Receiver{{1.3, 1.1, 0.8}, unit(0, 0, 1)},
          Receiver{{3.1, 0.7, 1.6}, unit(1, -2, 0.5)},
          Receiver{{2.2, 2.1, 1.2}, unit(-1, 0, -3)},
          Receiver{{0.9, 2.3, 1.9}, unit(0, 0, 1), IlluminanceKind::cylindrical}})
        add_point(selftest,
                  fmt::format("({:g}, {:g}, {:g})", r.point.x, r.point.y, r.point.z),
                  r,
                  Part::total,
                  reference);
    add_flux_balance(selftest, Lumen(exitance * 2.0 * (x * y + y * z + z * x)));
    return selftest;
}

/// Gauss-Legendre rule of 8 points over one side, folded at the middle: distance from the
/// middle over half the side, and weight (Abramowitz and Stegun, table 25.4).
struct GaussNode {
    double at;
    double weight;
};

constexpr std::array gauss_nodes{GaussNode{0.1834346424956498, 0.3626837833783620},
                                 GaussNode{0.5255324099163290, 0.3137066458778873},
                                 GaussNode{0.7966664774136267, 0.2223810344533745},
                                 GaussNode{0.9602898564975363, 0.1012285362903763}};

/// Mean of the reflected light over a face, replicate by replicate. The direct part is exact,
/// so that it moves the mean only.
Estimate mean_reflected(const Results& results) {
    const SurfaceResult& face = results.surfaces[0];
    std::vector<double> means(face.replicates.replicates, 0.0);
    for (std::size_t i = 0; i < face.points.size(); ++i) {
        const double weight = gauss_nodes[i / 4].weight * gauss_nodes[i % 4].weight;
        for (std::size_t r = 0; r < means.size(); ++r)
            means[r] += weight * (face.replicates.row(r)[i] - face.points[i].direct.mean);
    }
    return estimate_from_replicates(means);
}

/// CIE 171:2006, test 5.8: a cube of 4 m, an isotropic source in its middle, one reflectance.
/// All faces, and the quarters of a face, are alike: the mean over one quarter is the mean of
/// all. The product rule is within 2e-4 of the integral (found by radiosity with analytic form
/// factors).
SelftestCase make_cube(double reflectance) {
    constexpr double half = 2.0, allowance = 2e-4;
    const Lumen flux(10000.0);
    SelftestCase selftest;
    selftest.name = fmt::format("CIE 171 5.8 cube, reflectance {:g}", reflectance);
    selftest.settings = selftest_settings();
    // Of a point; the mean of all is sharper. Where little is reflected that is a small part of
    // what the tolerance is about.
    selftest.settings.tolerance = reflectance < 0.5 ? 0.01 : 0.015;
    selftest.scene = [reflectance, flux] {
        SceneDescription scene;
        const MaterialId paint = add_material(scene, reflectance);
        scene.rooms.push_back(make_box_room(2 * half, 2 * half, 2 * half, paint, paint, paint));
        add_isotropic_source(scene, {half, half, half}, flux);
        return scene;
    };
    CalculationSurface quarter;
    quarter.name = "quarter of the floor";
    for (const GaussNode& u : gauss_nodes) {
        for (const GaussNode& v : gauss_nodes)
            quarter.receivers.push_back(
                {{half * (1.0 - u.at), half * (1.0 - v.at), 0.0}, unit(0, 0, 1)});
    }
    selftest.surfaces.push_back(std::move(quarter));
    const SquareMetre area(6.0 * 4.0 * half * half);
    selftest.answers.push_back({"mean reflected light",
                                "lx",
                                in_lux(closed_room_mean_indirect(flux, area, reflectance)),
                                mean_reflected,
                                allowance});
    add_flux_balance(selftest, flux);
    return selftest;
}

/// An ordinary room, point by point. Reference: radiosity, two methods that agree to 3e-5.
SelftestCase make_shoebox() {
    constexpr double allowance = 3e-5;
    const Lumen flux(3000.0);
    SelftestCase selftest;
    selftest.name = "shoebox 4 x 3 x 2.5 m";
    selftest.settings = selftest_settings();
    selftest.settings.tolerance = 0.008; // of the total, while the answers are about a part
    selftest.scene = [flux] {
        SceneDescription scene;
        const MaterialId floor = add_material(scene, 0.3);
        const MaterialId ceiling = add_material(scene, 0.8);
        const MaterialId walls = add_material(scene, 0.6);
        scene.rooms.push_back(make_box_room(4.0, 3.0, 2.5, floor, ceiling, walls));
        add_isotropic_source(scene, {2, 1.5, 1.6}, flux);
        return scene;
    };

    struct Known {
        Point3 point;
        UnitVector3 normal;
        double indirect;
    };

    for (const Known& known : {Known{{1, 1, 0.75}, unit(0, 0, 1), 96.3827},
                               Known{{2, 1.5, 0.75}, unit(0, 0, 1), 109.807},
                               Known{{3.4, 2.4, 0.75}, unit(0, 0, 1), 85.2927},
                               Known{{2, 1.5, 1.2}, unit(1, 0, 0), 71.1112},
                               Known{{0, 1.5, 1.2}, unit(1, 0, 0), 75.9102}})
        add_point(selftest,
                  fmt::format("reflected light at ({:g}, {:g}, {:g})",
                              known.point.x,
                              known.point.y,
                              known.point.z),
                  {known.point, known.normal},
                  Part::indirect,
                  Lux(known.indirect),
                  allowance);
    add_flux_balance(selftest, flux);
    return selftest;
}

} // namespace

std::vector<SelftestCase> make_enclosure_cases() {
    return {make_sphere_case(0.0),
            make_sphere_case(0.5),
            make_furnace(0.5),
            make_furnace(0.9),
            make_cube(0.3),
            make_cube(0.5),
            make_cube(0.7),
            make_cube(0.95),
            make_shoebox()};
}

} // namespace isolux
