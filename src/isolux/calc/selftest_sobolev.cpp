#include <array>
#include <cmath>

#include <fmt/format.h>

#include "isolux/calc/selftest.h"
#include "isolux/calc/selftest_answers.h"
#include "isolux/calc/selftest_scenes.h"
#include "isolux/validate/sobolev.h"

/// Sobolev's problem with plates so wide that their rim is out of reach.
namespace isolux {

namespace {

/// Half the side of a plate over the separation. What the rim is missing is below 1e-7 of the
/// value at r = 5 H (a square of half that size misses 1.3e-5 there).
constexpr double half_size = 60.0;

/// Foot of the source. Off the plates' middle, where the edge between two triangles runs.
constexpr double foot_x = 0.31, foot_y = 0.17;

constexpr std::array radii{0.0, 0.25, 0.5, 1.0, 2.0, 3.0, 5.0}; ///< over the separation

SelftestCase make_sobolev(const SobolevProblem& problem) {
    SelftestCase selftest;
    selftest.name = fmt::format(
        "Sobolev, reflectances {:g} and {:g}", problem.reflectance_1, problem.reflectance_2);
    selftest.settings = selftest_settings();
    selftest.scene = [problem] { return make_sobolev_plates(problem); };
    const double h = in_metre(problem.separation);
    for (const SobolevPlane plane : {SobolevPlane::one, SobolevPlane::two}) {
        const bool is_lower = plane == SobolevPlane::one;
        for (const double ratio : radii) {
            const double r = ratio * h;
            add_point(selftest,
                      fmt::format("plane {}, r = {:g} m", is_lower ? 1 : 2, r),
                      make_sobolev_receiver(problem, plane, Metre(r)),
                      Part::total,
                      sobolev_illuminance(problem, plane, Metre(r)));
        }
    }
    return selftest;
}

} // namespace

SceneDescription make_sobolev_plates(const SobolevProblem& problem) {
    SceneDescription scene;
    const double h = in_metre(problem.separation);
    const double s = half_size * h;
    const MaterialId lower = add_material(scene, problem.reflectance_1);
    const MaterialId upper = add_material(scene, problem.reflectance_2);
    scene.objects.push_back(
        make_plate("plane 1", {{{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}}}, lower));
    scene.objects.push_back(
        make_plate("plane 2", {{{-s, -s, h}, {-s, s, h}, {s, s, h}, {s, -s, h}}}, upper));
    add_isotropic_source(
        scene, {foot_x * h, foot_y * h, in_metre(problem.source_height)}, problem.flux);
    return scene;
}

Receiver make_sobolev_receiver(const SobolevProblem& problem, SobolevPlane plane, Metre r) {
    const double h = in_metre(problem.separation);
    const bool is_lower = plane == SobolevPlane::one;
    const double azimuth = 0.5 + 0.9 * in_metre(r) / h;
    return {{foot_x * h + in_metre(r) * std::cos(azimuth),
             foot_y * h + in_metre(r) * std::sin(azimuth),
             is_lower ? 0.0 : h},
            UnitVector3::from_unit({0, 0, is_lower ? 1.0 : -1.0})};
}

std::vector<SelftestCase> make_sobolev_cases() {
    return {make_sobolev({0.5, 0.5, Metre(1.0), Metre(0.5), Lumen(10000.0)}),
            make_sobolev({0.8, 0.3, Metre(1.0), Metre(0.4), Lumen(10000.0)}),
            make_sobolev({0.7, 0.7, Metre(2.5), Metre(0.75), Lumen(40000.0)})};
}

} // namespace isolux
