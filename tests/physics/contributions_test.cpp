// Light by source and derivatives by reflectance: the sum is the whole, dimming follows without
// a new calculation, and derivatives are those of closed answers.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"

#include "support/facetted_sphere.h"
#include "support/replicates.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

using test::Builder;
using test::z_limit;
using test::z_score;

/// A room with a mirror, a pane, a screen, panels and lamps in three groups, the second dimmed
/// to `level`.
Scene mixed_room(double level) {
    Builder b;
    const MaterialId floor = b.add_diffuse(0.3);
    const MaterialId ceiling = b.add_diffuse(0.8);
    const MaterialId walls =
        b.add_material({"walls", Opaque{{0.6, 0.5, 0.3}, 0.0}, Sides::both});
    const MaterialId mirror =
        b.add_material({"mirror", Opaque{Rgb::grey(0.2), 0.6}, Sides::both});
    const MaterialId pane = b.add_material({"pane", ClearPane{}, Sides::both});
    b.add_room({0, 0, 0}, {6, 4, 3}, floor, ceiling, walls);
    b.add_quad({0.01, 0.5, 0.2}, {0, 3, 0}, {0, 0, 2.5}, mirror);
    b.add_quad({4.5, 0, 0}, {0, 4, 0}, {0, 0, 3}, pane);
    b.add_quad({2.5, 1, 0}, {0, 2, 0}, {0, 0, 1.5}, floor);
    b.add_panel({1, 1, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000);
    b.add_panel({4, 2, 2.9}, {0, 0.6, 0}, {0.6, 0, 0}, 3000);
    const LuminaireTypeId lamp = b.add_isotropic_type(800);
    b.add_point({5.5, 2, 2}, lamp);
    b.add_point({3, 3, 2.5}, lamp);
    const char* groups[]{"one", "two", "two", ""};
    for (std::size_t i = 0; i < 4; ++i) {
        Luminaire& l = b.luminaires[i];
        l.placement.group = groups[i];
        if (l.placement.group == "two") {
            l.placement.scale = level;
            l.flux = level * l.flux;
        }
    }
    return b.build();
}

/// Open points, one next to a wall (traced), one that looks up, a cylinder.
std::vector<CalculationSurface> points_in_it() {
    CalculationSurface s;
    s.name = "points";
    const UnitVector3 up = UnitVector3::from_unit({0, 0, 1});
    for (int i = 0; i < 10; ++i)
        s.receivers.push_back({{0.4 + 0.53 * i, 0.7 + 0.27 * i, 0.8}, up});
    s.receivers.push_back({{1.0, 0.0, 0.01}, UnitVector3::from_unit({0, 1, 0})});
    s.receivers.push_back({{5.0, 1.0, 1.6}, up, IlluminanceKind::cylindrical});
    return {s};
}

Settings with_books(Estimator estimator, std::uint64_t seed = 1) {
    Settings settings;
    settings.estimator = estimator;
    settings.fixed_units = 2;
    settings.seed = seed;
    settings.sensitivities = true;
    return settings;
}

class BooksOf : public testing::TestWithParam<Estimator> {};

/// All sources at full level give the result itself, for every replicate, but for the rounding
/// of floats: 2^-24 for each of 4 entries and their sums.
TEST_P(BooksOf, SourcesAddUpToTheWhole) {
    const Scene scene = mixed_room(1.0);
    const Results r = calculate(scene, points_in_it(), with_books(GetParam()));
    ASSERT_TRUE(r.contributions.has_value());
    const Contributions& c = *r.contributions;
    ASSERT_EQ(c.sources.size(), 3U);
    const std::vector<double> full(3, 1.0);
    const ReplicateTable sum = combine(c, full, 0, c.points);
    const ReplicateTable direct = combine(c, LightPart::direct, full, 0, c.points);
    const ReplicateTable& whole = r.surfaces[0].replicates;
    ASSERT_EQ(sum.values.size(), whole.values.size());
    for (std::size_t i = 0; i < sum.values.size(); ++i)
        EXPECT_NEAR(sum.values[i], whole.values[i], 1e-6 * whole.values[i]) << i;
    for (std::size_t p = 0; p < c.points; ++p) {
        double mean = 0.0;
        for (std::size_t k = 0; k < c.replicates; ++k)
            mean += direct.row(k)[p] / static_cast<double>(c.replicates);
        const double expected = r.surfaces[0].points[p].direct.mean;
        EXPECT_NEAR(mean, expected, 1e-6 * expected) << p;
    }
}

/// Books change no number.
TEST_P(BooksOf, CostNoBitOfTheResult) {
    const Scene scene = mixed_room(1.0);
    Settings without = with_books(GetParam());
    without.contributions = SourceSplit::none;
    without.sensitivities = false;
    const Results a = calculate(scene, points_in_it(), with_books(GetParam()));
    const Results b = calculate(scene, points_in_it(), without);
    EXPECT_FALSE(b.contributions.has_value());
    EXPECT_FALSE(b.sensitivities.has_value());
    EXPECT_EQ(a.surfaces[0].replicates.values, b.surfaces[0].replicates.values);
}

/// Dimming one group of a full calculation is a calculation with that group dimmed.
TEST_P(BooksOf, DimmingAgreesWithANewCalculation) {
    const Scene full = mixed_room(1.0);
    const Scene dimmed = mixed_room(0.3);
    std::vector<std::vector<double>> dimmed_rows;
    std::vector<std::vector<double>> new_rows;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Results r = calculate(full, points_in_it(), with_books(GetParam(), seed));
        ASSERT_EQ(r.contributions->sources[1].name, "two");
        const std::vector<double> levels{1.0, 0.3, 1.0};
        const ReplicateTable t = combine(*r.contributions, levels, 0, r.contributions->points);
        const Results n = calculate(dimmed, points_in_it(), with_books(GetParam(), 100 + seed));
        for (std::size_t k = 0; k < t.replicates; ++k) {
            dimmed_rows.emplace_back(t.row(k).begin(), t.row(k).end());
            const auto row = n.surfaces[0].replicates.row(k);
            new_rows.emplace_back(row.begin(), row.end());
        }
    }
    const std::size_t points = dimmed_rows[0].size();
    const test::Sample a{points, dimmed_rows};
    const test::Sample b{points, new_rows};
    for (std::uint32_t k = 0; k < 8; ++k)
        EXPECT_LT(std::abs(z_score(a.projection(k), b.projection(k))), z_limit) << k;
    if (GetParam() != Estimator::local_estimation) { // which knows no bound next to a wall
        EXPECT_LT(a.mean().standard_error, 0.01 * a.mean().mean);
    }
}

TEST_P(BooksOf, AreTheSameForAnyNumberOfThreads) {
    const Scene scene = mixed_room(1.0);
    std::vector<Results> results;
    for (const std::size_t threads : {1U, 2U, 7U}) {
        const ThreadLimit limit(threads);
        results.push_back(calculate(scene, points_in_it(), with_books(GetParam())));
    }
    for (std::size_t i = 1; i < 3; ++i) {
        EXPECT_EQ(results[i].contributions->direct, results[0].contributions->direct);
        EXPECT_EQ(results[i].contributions->indirect, results[0].contributions->indirect);
        EXPECT_EQ(results[i].sensitivities->values, results[0].sensitivities->values);
    }
}

INSTANTIATE_TEST_SUITE_P(Estimators,
                         BooksOf,
                         testing::Values(Estimator::automatic,
                                         Estimator::local_estimation,
                                         Estimator::local_estimation_mis,
                                         Estimator::path_tracing));

/// Mean over points of the derivatives by material `m`, 64 replicates.
Estimate derivative(const Scene& scene,
                    const std::vector<Receiver>& receivers,
                    Settings settings,
                    std::size_t m) {
    CalculationSurface surface;
    surface.receivers = receivers;
    const std::vector<CalculationSurface> surfaces{surface};
    std::vector<double> means;
    settings.sensitivities = true;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        settings.seed = seed;
        const Results r = calculate(scene, surfaces, settings);
        for (std::size_t k = 0; k < r.sensitivities->replicates; ++k) {
            double sum = 0.0;
            for (const float v : r.sensitivities->row(m, k))
                sum += static_cast<double>(v);
            means.push_back(sum / static_cast<double>(receivers.size()));
        }
    }
    return estimate_from_replicates(means);
}

class DerivativesOf : public testing::TestWithParam<std::tuple<double, Estimator>> {};

/// Every surface emits M and reflects rho: E = M/(1 - rho) everywhere, dE/drho = M/(1 - rho)^2.
TEST_P(DerivativesOf, AFurnaceAreThoseOfItsFormula) {
    const auto [rho, estimator] = GetParam();
    constexpr double exitance = 100.0;
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
    const Scene scene = b.build();
    std::vector<Receiver> receivers;
    for (int i = 0; i < 12; ++i)
        receivers.push_back({{0.4 + 0.19 * i, 0.5 + 0.12 * i, 0.5 + 0.08 * i},
                             UnitVector3({std::sin(i), std::cos(2.0 * i), std::sin(3.0 * i)})});
    Settings settings;
    settings.estimator = estimator;
    settings.fixed_units = 4;
    const Estimate e = derivative(scene, receivers, settings, 0);
    const double exact = exitance / ((1.0 - rho) * (1.0 - rho));
    EXPECT_LT(std::abs(z_score(e, exact)), z_limit)
        << e.mean << " +- " << e.standard_error << ", exact " << exact;
    if (estimator != Estimator::local_estimation) {
        EXPECT_LT(e.standard_error, 0.01 * exact);
    }
}

INSTANTIATE_TEST_SUITE_P(Reflectances,
                         DerivativesOf,
                         testing::Combine(testing::Values(0.3, 0.7),
                                          testing::Values(Estimator::local_estimation,
                                                          Estimator::local_estimation_mis,
                                                          Estimator::path_tracing)));

/// A sphere of two halves, isotropic lamp in the middle: E_ind = N/(A D), N = sum rho_i Phi_i,
/// D = 1 - sum rho_i A_i/A, so dE/drho_j = Phi_j/(A D) + N (A_j/A)/(A D^2). A facetted sphere
/// has 0.2 % less area (level 4); its form factors differ by as little, and a chain of 1/D of
/// them adds up: 1 % is allowed.
TEST(Derivatives, OfASphereOfTwoHalvesAreThoseOfItsFormula) {
    Builder b;
    const double rho[]{0.6, 0.3};
    const MaterialId m[]{b.add_diffuse(rho[0]), b.add_diffuse(rho[1])};
    const auto sphere = test::make_facetted_sphere({0, 0, 0}, 1.0, 4);
    for (const auto& [i, j, k] : sphere.faces) {
        const double height = sphere.points[i].z + sphere.points[j].z + sphere.points[k].z;
        b.add_triangle(
            sphere.points[i], sphere.points[j], sphere.points[k], m[height > 0.0 ? 0 : 1]);
    }
    constexpr double flux = 1000.0;
    b.add_point({0, 0, 0}, b.add_isotropic_type(flux));
    const Scene scene = b.build();
    std::vector<Receiver> receivers;
    for (std::size_t f = 0; f < 2048; f += 197) { // on the sphere itself: there E is uniform
        const auto& [i, j, k] = sphere.faces[f];
        const Point3 p = sphere.points[i];
        const Vector3 u = sphere.points[j] - p;
        const Vector3 v = sphere.points[k] - p;
        receivers.push_back({p + (1.0 / 3.0) * (u + v), UnitVector3(cross(u, v))});
    }
    const double area = 4.0 * std::numbers::pi;
    const double n = 0.5 * flux * (rho[0] + rho[1]);
    const double d = 1.0 - 0.5 * (rho[0] + rho[1]);
    const double exact = 0.5 * flux / (area * d) + n * 0.5 / (area * d * d);
    Settings settings;
    settings.fixed_units = 4;
    settings.estimator = Estimator::local_estimation_mis;
    for (const std::size_t j : {0U, 1U}) {
        const Estimate e = derivative(scene, receivers, settings, j);
        EXPECT_LT(std::abs(e.mean - exact), z_limit * e.standard_error + 0.01 * exact)
            << e.mean << " +- " << e.standard_error << ", exact " << exact;
    }
}

/// With mirror, pane, colour and traced points: against the difference of two calculations with
/// the same reflectance a little lower and higher, whose own curvature is below a thousandth.
TEST(Derivatives, OfAMixedRoomAreDifferencesOfCalculations) {
    const auto mean_of = [](double reflectance, std::uint64_t seed) {
        Scene scene = mixed_room(1.0);
        std::get<Opaque>(scene.materials[1].scattering).diffuse = Rgb::grey(reflectance);
        Settings settings = with_books(Estimator::automatic, seed);
        settings.fixed_units = 8;
        return calculate(scene, points_in_it(), settings);
    };
    std::vector<double> differences;
    std::vector<double> derivatives;
    constexpr double step = 0.1;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Results low = mean_of(0.8 - step, seed);
        const Results high = mean_of(0.8 + step, 100 + seed);
        const Results middle = mean_of(0.8, 200 + seed);
        ASSERT_EQ(middle.sensitivities->materials[1].reflectance, 0.8);
        for (std::size_t k = 0; k < low.replicates; ++k) {
            double difference = 0.0;
            double sum = 0.0;
            for (std::size_t p = 0; p < middle.sensitivities->points; ++p) {
                difference += high.surfaces[0].replicates.row(k)[p]
                              - low.surfaces[0].replicates.row(k)[p];
                sum += static_cast<double>(middle.sensitivities->row(1, k)[p]);
            }
            differences.push_back(difference / (2.0 * step));
            derivatives.push_back(sum);
        }
    }
    const Estimate a = estimate_from_replicates(differences);
    const Estimate b = estimate_from_replicates(derivatives);
    // E is a sum of c / (1 - g rho) in rho; with g below 0.4 (the ceiling sees itself through
    // the others) the step adds (g step)^2 / (1 - g rho)^2 < 0.4 %.
    EXPECT_LT(std::abs(a.mean - b.mean),
              z_limit * std::hypot(a.standard_error, b.standard_error) + 0.004 * a.mean)
        << a.mean << " +- " << a.standard_error << ", derivative " << b.mean << " +- "
        << b.standard_error;
    EXPECT_LT(b.standard_error, 0.02 * b.mean);
}

} // namespace
} // namespace isolux
