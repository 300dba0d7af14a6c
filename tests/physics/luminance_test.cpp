// Luminance of sight lines against closed answers: METHODS 7.2 rows 9, 10, 19, 20 and 21 and
// the elementary cases: a luminaire looked at, a Lambertian wall, panes and mirrors on the way.

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"
#include "isolux/calc/luminance.h"
#include "isolux/io/project_json.h"

#include "support/facetted_sphere.h"
#include "support/replicates.h"
#include "support/source_dir.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

using test::Builder;
using test::z_limit;
using test::z_score;

constexpr double pi = std::numbers::pi;

SightLine line(const Point3& eye, const Vector3& direction) {
    return {eye, UnitVector3(direction)};
}

std::vector<LuminanceResult> look(const Scene& scene,
                                  const std::vector<SightLine>& lines,
                                  std::size_t units,
                                  Estimator estimator = Estimator::automatic,
                                  std::uint64_t seed = 1) {
    Settings settings;
    settings.fixed_units = units;
    settings.estimator = estimator;
    settings.seed = seed;
    return estimate_luminances(scene, lines, settings).rays;
}

/// 64 independent replicates: four seeds of 16, METHODS "Statistical protocol". The error is
/// that of the mean of four estimates.
std::vector<Estimate> look_with_four_seeds(const Scene& scene,
                                           const std::vector<SightLine>& lines,
                                           std::size_t units,
                                           Estimator estimator = Estimator::automatic,
                                           std::uint64_t first_seed = 1) {
    std::vector<Estimate> all(lines.size());
    for (std::uint64_t s = 0; s < 4; ++s) {
        const auto rays = look(scene, lines, units, estimator, first_seed + s);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            all[i].mean += 0.25 * rays[i].total.mean;
            all[i].standard_error =
                std::hypot(all[i].standard_error, 0.25 * rays[i].total.standard_error);
        }
    }
    return all;
}

// ---- a luminaire looked at ------------------------------------------------------------------

TEST(LuminanceOfALuminaire, IsItsIntensityOverTheProjectedAreaOfItsOpening) {
    const std::filesystem::path here = isolux::test::source_dir();
    Project project = parse_project(
        R"({"isolux": 1, "luminaire_types": {"down": {"file": ")"
            + (here / "luminaires" / "batwing-linear.ldt").generic_string() + R"("}},
        "luminaires": [{"type": "down", "position": [0, 0, 3]}]})",
        "p.json");
    const LuminaireType type = project.scene.luminaire_types.at(0);
    const Scene scene = build_scene(std::move(project.scene));
    const Opening& opening = scene.luminaires.at(0).opening;
    ASSERT_NE(opening.form, OpeningForm::point);
    for (const double degrees_from_nadir : {0.0, 20.0, 35.0, 50.0, 65.0}) {
        const double gamma = degrees_from_nadir / 180.0 * pi;
        const Vector3 w{std::sin(gamma), 0.0, -std::cos(gamma)}; // from the luminaire
        double shown = 0.0; // of all faces, in the direction w
        for (const Facet& f : opening.facets)
            shown += opening.form == OpeningForm::flat
                         ? f.area * std::abs(dot(f.normal, w))
                         : f.area * std::max(0.0, dot(f.normal, w));
        const Point3 centre = opening.form == OpeningForm::flat
                                  ? Point3{0, 0, 3}
                                  : Point3{0, 0, opening.facets[0].vertices[0].z};
        const double exact = in_candela(luminous_intensity(type, UnitVector3(w))) / shown;
        const auto rays = look(scene, {line(Point3{0, 0, 3} + 2.0 * w, -w)}, 1);
        EXPECT_NEAR(rays[0].total.mean, exact, 1e-9 * exact)
            << degrees_from_nadir << " degrees, opening at z = " << centre.z;
        EXPECT_LT(rays[0].total.standard_error, 1e-12 * exact);
        EXPECT_EQ(rays[0].luminaires.mean, rays[0].total.mean);
    }
}

TEST(LuminanceOfALuminaire, IsTheSameFromEverySideForALambertianPanel) {
    Builder b;
    b.add_panel({0, 0, 2}, {0, 1, 0}, {1, 0, 0}, 500.0); // shines down
    const Scene scene = b.build();
    const double exact = 500.0 / pi;
    for (const Vector3 w : {Vector3{0, 0, 1}, {0.4, 0.1, 0.3}, {-1, 0.2, 0.15}}) {
        const Point3 seen{0.5, 0.5, 2};
        EXPECT_NEAR(look(scene, {line(seen - w, w)}, 1)[0].total.mean, exact, 1e-9 * exact);
    }
    // from behind it is dark
    EXPECT_EQ(look(scene, {line({0.5, 0.5, 3}, {0, 0, -1})}, 1)[0].total.mean, 0.0);
    // and beside it there is nothing
    EXPECT_EQ(look(scene, {line({1.5, 0.5, 0}, {0, 0, 1})}, 1)[0].total.mean, 0.0);
}

// ---- a wall ---------------------------------------------------------------------------------

TEST(LuminanceOfAWall, IsIlluminanceTimesReflectanceOverPi) {
    Builder b;
    b.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, b.add_diffuse(0.4));
    b.add_point({0, 0, 2}, b.add_isotropic_type(4.0 * pi * 100.0)); // 100 cd
    const Scene scene = b.build();
    const Point3 at{0.6, 0.3, 0};
    const double d2 = 0.36 + 0.09 + 4.0;
    const double exact = 100.0 * 2.0 / (d2 * std::sqrt(d2)) * 0.4 / pi;
    for (const Vector3 w : {Vector3{0, 0, -1}, {0.8, 0.5, -0.2}}) {
        const auto r = look(scene, {line(at - 0.7 * w, w)}, 1)[0];
        EXPECT_NEAR(r.total.mean, exact, 1e-5 * exact); // rays start 10 um off the wall
        EXPECT_NEAR(r.direct.mean, r.total.mean, 1e-12 * exact);
    }
    EXPECT_EQ(look(scene, {line({0, 0, 1}, {0, 1, 0.1})}, 1)[0].total.mean, 0.0);
}

TEST(LuminanceOfAWall, HasTheColourOfItsPaintOnlyInItsWeights) {
    // Red light on a red wall is brighter than on a blue one of the same Y.
    Builder b;
    const MaterialId red = b.add_material({"red", Opaque{{0.5, 0, 0}, 0.0}, Sides::both});
    b.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, red);
    b.add_point({0, 0, 1}, b.add_isotropic_type(4.0 * pi * 100.0));
    const Scene scene = b.build();
    const double exact = 100.0 * 0.2126 * 0.5 / pi;
    EXPECT_NEAR(
        look(scene, {line({0, 0, 0.5}, {0, 0, -1})}, 1)[0].total.mean, exact, 1e-4 * exact);
}

// ---- panes and mirrors on the way, METHODS 7.2 rows 19 and 20
// ---------------------------------

TEST(LuminanceThroughAPane, IsDimmedByTheSlabFormula) {
    const ClearPane pane{1.52, 0.95};
    Builder b;
    b.add_quad(
        {-5, 1, -5}, {0, 0, 10}, {10, 0, 0}, b.add_material({"glass", pane, Sides::both}));
    b.add_panel({-9, 2, -9}, {18, 0, 0}, {0, 0, 18}, 324.0 * pi * 50.0); // 50 cd/m2 towards -y
    const Scene scene = b.build();
    for (const double degrees_of_incidence : {0.0, 20.0, 40.0, 60.0, 70.0}) {
        const double a = degrees_of_incidence / 180.0 * pi;
        const double exact = 50.0 * evaluate_slab(pane, std::cos(a)).transmittance;
        const auto r = look(scene, {line({0, 0, 0}, {std::sin(a), std::cos(a), 0})}, 1)[0];
        EXPECT_NEAR(r.total.mean, exact, 1e-9 * exact) << degrees_of_incidence;
    }
}

TEST(LuminanceInAMirror, IsThatOfTheThingTimesTheReflectance) {
    // Mirror, pane, panel: known losses at every step.
    Builder b;
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.0), 0.9}, Sides::both});
    const ClearPane pane{1.5, 1.0};
    const MaterialId glass = b.add_material({"glass", pane, Sides::both});
    b.add_quad({1, -1, -1}, {1, 1, 0}, {0, 0, 2}, mirror);           // turns +x into +y
    b.add_quad({0, 3, -1}, {3, 0, 0}, {0, 0, 2}, glass);             // across +y
    b.add_panel({0, 6, -2}, {4, 0, 0}, {0, 0, 4}, 16.0 * pi * 80.0); // 80 cd/m2 towards -y
    const Scene scene = b.build();
    const SightLine s = line({0, -0.4, 0}, {1, 0, 0});
    const double exact = 80.0 * 0.9 * evaluate_slab(pane, 1.0).transmittance;
    const auto r = look(scene, {s}, 1)[0];
    EXPECT_NEAR(r.total.mean, exact, 1e-9 * exact);
    EXPECT_NEAR(r.luminaires.mean, exact, 1e-9 * exact);
}

TEST(LuminanceInAMirror, ShowsAWallThatAPointSourceLightsOverTheMirror) {
    // A point source 1 m over a mirror, a plane beside it: direct light and that of the image.
    Builder b;
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.0), 0.8}, Sides::both});
    b.add_quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, mirror);
    b.add_quad({2, -1, 0.5}, {0, 2, 0}, {0, 0, 1.5}, b.add_diffuse(0.5)); // faces +x and -x
    b.add_point({0, 0, 1}, b.add_isotropic_type(4.0 * pi * 100.0));
    const Scene scene = b.build();
    const Point3 at{2, 0.3, 1.2};
    const auto e = [&](double source_z) {
        const double dz = at.z - source_z;
        const double d2 = 4.0 + 0.09 + dz * dz;
        return 100.0 * 2.0 / (d2 * std::sqrt(d2));
    };
    const double exact = (e(1.0) + 0.8 * e(-1.0)) * 0.5 / pi;
    const Point3 eye{0.5, -0.2, 1.7};
    const auto rays = look(scene, {line(eye, at - eye)}, 1);
    EXPECT_NEAR(rays[0].direct.mean, exact, 1e-4 * exact);
}

/// METHODS 7.2 rows 10 and 20: all walls emit M and reflect rho. A mirror and a pane that lose
/// nothing change nothing, so the luminance is M / (pi (1 - rho)) from everywhere in every
/// direction, over any chain.
TEST(LuminanceInAFurnace, IsTheSameThroughMirrorsAndPanes) {
    constexpr double exitance = 100.0;
    constexpr double rho = 0.6;
    Builder b;
    const Point3 p{0, 0, 0};
    const Vector3 x{3, 0, 0};
    const Vector3 y{0, 2.5, 0};
    const Vector3 z{0, 0, 2};
    const auto m = b.add_diffuse(rho);
    b.add_room(p, {3, 2.5, 2}, m, m, m);
    b.add_panel(p, x, y, exitance * 7.5);
    b.add_panel(p + z, y, x, exitance * 7.5);
    b.add_panel(p, y, z, exitance * 5.0);
    b.add_panel(p + x, z, y, exitance * 5.0);
    b.add_panel(p, z, x, exitance * 6.0);
    b.add_panel(p + y, x, z, exitance * 6.0);
    const auto mirror = b.add_material({"mirror", Opaque{Rgb::grey(0.0), 1.0}, Sides::both});
    const auto glass = b.add_material({"glass", ClearPane{1.52, 1.0}, Sides::both});
    b.add_quad({1.0, 0.6, 0.4}, {0, 1.2, 0}, {0, 0, 1.2}, mirror);
    b.add_quad({2.0, 0.5, 0.3}, {0, 1.4, 0.2}, {0, 0, 1.3}, glass);
    const Scene scene = b.build();
    const double exact = exitance / (pi * (1.0 - rho));
    const std::vector<SightLine> lines{
        line({0.4, 0.4, 1.0}, {0.0, 1.0, 0.1}),    // straight at a wall
        line({1.6, 1.1, 1.0}, {-1.0, 0.1, 0.05}),  // in the mirror
        line({1.6, 1.1, 1.0}, {1.0, 0.12, -0.03}), // through the pane
        line({2.5, 1.0, 1.0}, {-1.0, 0.02, 0.01}), // pane, mirror, pane
    };
    const auto all = look_with_four_seeds(scene, lines, 8);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_LT(std::abs(z_score(all[i], exact)), z_limit)
            << i << ": " << all[i].mean << " +- " << all[i].standard_error << ", exact "
            << exact;
        EXPECT_LT(all[i].standard_error, 0.02 * exact) << i;
    }
}

/// METHODS 7.2 row 9: reflected light in a sphere is the same everywhere, so is its luminance.
TEST(LuminanceInASphere, OfReflectedLightIsTheSameEverywhere) {
    constexpr double rho = 0.8;
    Builder b;
    const auto m = b.add_diffuse(rho);
    const test::FacettedSphere sphere = test::make_facetted_sphere({0, 0, 0}, 1.0, 5);
    for (const auto& [i, j, k] : sphere.faces)
        b.add_triangle(sphere.points[i], sphere.points[j], sphere.points[k], m);
    b.add_point({0, 0, 0.5}, b.add_isotropic_type(1000.0));
    const Scene scene = b.build();
    const double exact = rho / pi * rho * 1000.0 / (scene.total_area * (1.0 - rho));
    const std::vector<SightLine> lines{line({0, 0, 0}, {0.3, 0.5, -0.2}),
                                       line({0.5, 0.1, 0}, {-0.4, 0.1, 0.7}),
                                       line({0, -0.7, 0.2}, {0.1, 0.9, 0.3})};
    const auto rays = look(scene, lines, 4, Estimator::local_estimation_mis);
    for (const LuminanceResult& r : rays) {
        // Facets of 3 degrees, as for illuminance: allow a thousandth.
        EXPECT_NEAR(r.indirect.mean, exact, z_limit * r.indirect.standard_error + 1e-3 * exact);
        EXPECT_LT(r.indirect.standard_error, 0.005 * exact);
    }
}

/// METHODS 7.2 row 21: luminaire, mirror, diffuse wall, eye. Local estimation with gather rays
/// and path tracing agree; so do both halves of a furnished scene.
TEST(LuminanceOfACaustic, IsTheSameByLocalEstimationAndByPathTracing) {
    Builder b;
    const MaterialId walls = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {3, 3, 2.5}, walls, walls, walls);
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.05), 0.9}, Sides::both});
    b.add_quad({0.8, 0.8, 0.01}, {0, 1.4, 0}, {1.4, 0, 0}, mirror); // faces down: body below
    b.add_quad({0.8, 0.8, 0.012}, {1.4, 0, 0}, {0, 1.4, 0}, mirror);
    b.add_panel({1.2, 1.2, 1.2}, {0, 0.3, 0}, {0.3, 0, 0}, 1000.0); // shines down on it
    const Scene scene = b.build();
    const std::vector<SightLine> lines{line({0.3, 0.3, 1.5}, {0.6, 0.7, 0.7}),   // the ceiling
                                       line({1.5, 0.3, 1.2}, {0.1, 1.0, 0.2}),   // a wall
                                       line({0.3, 0.3, 1.5}, {0.8, 0.9, -0.9})}; // mirrored
    const auto a = look_with_four_seeds(scene, lines, 2, Estimator::local_estimation_mis, 1);
    const auto c = look_with_four_seeds(scene, lines, 2, Estimator::path_tracing, 11);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_LT(std::abs(z_score(a[i], c[i])), z_limit)
            << i << ": " << a[i].mean << " +- " << a[i].standard_error << " and " << c[i].mean
            << " +- " << c[i].standard_error;
        EXPECT_LT(a[i].standard_error, 0.02 * a[i].mean) << i;
        EXPECT_LT(c[i].standard_error, 0.02 * c[i].mean) << i;
    }
}

TEST(Luminance, HasTheSameBitsForAnyNumberOfThreads) {
    Builder b;
    const MaterialId walls = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {3, 3, 2.5}, walls, walls, walls);
    b.add_quad({1.5, 0.5, 0.2},
               {0, 2, 0},
               {0, 0, 2},
               b.add_material({"glass", ClearPane{}, Sides::both}));
    b.add_panel({1.2, 1.2, 2.4}, {0, 0.3, 0}, {0.3, 0, 0}, 1000.0);
    const Scene scene = b.build();
    std::vector<SightLine> lines;
    for (int i = 0; i < 40; ++i)
        lines.push_back(line({0.5, 0.5, 1.2}, {1.0, 0.05 * i, 0.02 * i - 0.5}));
    const auto with = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        return look(scene, lines, 1);
    };
    const auto one = with(1);
    for (const std::size_t threads : {2, 7}) {
        const auto other = with(threads);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            EXPECT_EQ(one[i].total.mean, other[i].total.mean) << i;
            EXPECT_EQ(one[i].total.standard_error, other[i].total.standard_error) << i;
        }
    }
}

TEST(Luminance, StopsAtTheToleranceAndSaysSo) {
    Builder b;
    const MaterialId walls = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {3, 3, 2.5}, walls, walls, walls);
    b.add_panel({1.2, 1.2, 2.4}, {0, 0.3, 0}, {0.3, 0, 0}, 1000.0);
    const Scene scene = b.build();
    Settings settings;
    settings.tolerance = 0.03;
    const std::vector<SightLine> lines{line({0.5, 0.5, 1.2}, {1, 1, -0.3})};
    const LuminanceResults results = estimate_luminances(scene, lines, settings);
    EXPECT_TRUE(results.converged);
    const Estimate e = results.rays[0].total;
    const Interval i = confidence_interval(e, 0.95);
    EXPECT_LE(0.5 * (i.upper - i.lower), 0.03 * e.mean);
    EXPECT_GT(e.standard_error, 0.0);
}

} // namespace
} // namespace isolux
