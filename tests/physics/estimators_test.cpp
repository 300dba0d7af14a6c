// METHODS 7.2 rows 15, 19, 21: the default estimator, plain local estimation and path tracing
// from the points are independent implementations of one equation and must agree everywhere.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/calculate.h"

#include "support/replicates.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

using test::Builder;

struct Case {
    const char* name;
    std::function<void(Builder&)> build;
    std::vector<Receiver> receivers;
    double power = 0.002; ///< the default estimator resolves this share of the mean with 1 SE
    bool is_dark = false; ///< light paths are guided, so all points gather
};

std::vector<Receiver>
grid(const Point3& from, const Vector3& u, const Vector3& v, const Vector3& n) {
    std::vector<Receiver> points;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 3; ++j)
            points.push_back(
                {from + (0.25 * i + 0.1) * u + (0.3 * j + 0.1) * v, UnitVector3(n)});
    return points;
}

void add_box(Builder& b, const Point3& p, const Vector3& size, MaterialId m) {
    const Vector3 x{size.x, 0, 0};
    const Vector3 y{0, size.y, 0};
    const Vector3 z{0, 0, size.z};
    b.add_quad(p, y, x, m);
    b.add_quad(p + z, x, y, m);
    b.add_quad(p, z, y, m);
    b.add_quad(p + x, y, z, m);
    b.add_quad(p, x, z, m);
    b.add_quad(p + y, z, x, m);
}

Case furnished() {
    return {"furnished room, panel and point",
            [](Builder& b) {
                const auto wall = b.add_diffuse(0.5);
                const auto wood = b.add_diffuse(0.35);
                b.add_room({0, 0, 0}, {5, 4, 3}, b.add_diffuse(0.2), b.add_diffuse(0.7), wall);
                add_box(b, {1, 1, 0}, {1.6, 0.8, 0.74}, wood);
                add_box(b, {3.5, 0.2, 0}, {0.5, 1.5, 2.0}, wood);
                b.add_panel({2, 1.5, 2.95}, {0, 0.6, 0}, {0.6, 0, 0}, 4000);
                b.add_point({4.2, 3.2, 2.2}, b.add_isotropic_type(800));
            },
            grid({0, 0, 0.95}, {5, 0, 0}, {0, 4, 0}, {0, 0, 1})};
}

Case mirror_floor() {
    return {"floor that is a fifth mirror, panel and point",
            [](Builder& b) {
                const auto floor =
                    b.add_material({"polished", Opaque{Rgb::grey(0.2), 0.2}, Sides::both});
                b.add_room({0, 0, 0}, {5, 4, 3}, floor, b.add_diffuse(0.7), b.add_diffuse(0.5));
                add_box(b, {1, 1, 0}, {1.0, 0.8, 0.7}, b.add_diffuse(0.3));
                b.add_panel({2, 1.5, 2.95}, {0, 0.6, 0}, {0.6, 0, 0}, 4000);
                b.add_point({4.2, 3.2, 2.2}, b.add_isotropic_type(800));
            },
            grid({0, 0, 2}, {5, 0, 0}, {0, 4, 0}, {0, 0, -1})};
}

Case two_mirrors() {
    return {"mirror wall faces half-mirror wall, point source",
            [](Builder& b) {
                const auto mirror =
                    b.add_material({"mirror", Opaque{Rgb::grey(0.05), 0.8}, Sides::both});
                const auto grey = b.add_diffuse(0.4);
                b.add_quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, grey);
                b.add_quad({0, 0, 3}, {0, 3, 0}, {4, 0, 0}, grey);
                b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 3}, mirror);
                b.add_quad({4, 0, 0}, {0, 0, 3}, {0, 3, 0}, grey);
                b.add_quad({0, 0, 0}, {0, 0, 3}, {4, 0, 0}, grey);
                b.add_quad({0, 3, 0}, {4, 0, 0}, {0, 0, 3}, mirror);
                b.add_panel({2, 1, 2.9}, {0, 0.5, 0}, {0.5, 0, 0}, 3000);
            },
            grid({0, 0, 0.8}, {4, 0, 0}, {0, 3, 0}, {0, 0, 1})};
}

Case behind_glass() {
    return {
        "light from behind a pane, round a partition",
        [](Builder& b) {
            const auto wall = b.add_diffuse(0.5);
            const auto glass = b.add_material({"glass", ClearPane{1.52, 0.95}, Sides::both});
            b.add_room({0, 0, 0}, {6, 3, 2.7}, b.add_diffuse(0.3), b.add_diffuse(0.7), wall);
            b.add_quad({3, 0, 0}, {0, 2, 0}, {0, 0, 2.7}, wall);
            b.add_quad({3, 2, 0}, {0, 1, 0}, {0, 0, 2.7}, glass);
            b.add_panel({1, 1, 2.65}, {0, 0.6, 0}, {0.6, 0, 0}, 5000);
        },
        grid({3, 0, 0.8}, {3, 0, 0}, {0, 3, 0}, {0, 0, 1}),
        0.012,
        true};
}

Case panes_in_a_row() {
    return {
        "two panes in a row and one before a mirror",
        [](Builder& b) {
            const auto wall = b.add_diffuse(0.5);
            // denser than any glass, so that an error in what panes mirror is seen
            const auto glass = b.add_material({"glass", ClearPane{3.0, 0.95}, Sides::both});
            const auto mirror =
                b.add_material({"mirror", Opaque{Rgb::grey(0.05), 0.8}, Sides::both});
            b.add_room({0, 0, 0}, {5, 3, 2.7}, b.add_diffuse(0.3), b.add_diffuse(0.7), wall);
            b.add_quad({2, 0, 0}, {0, 3, 0}, {0, 0, 2.7}, glass);
            b.add_quad({2.1, 0, 0}, {0, 3, 0}, {0, 0, 2.7}, glass);
            b.add_quad({4.5, 0, 0}, {0, 3, 0}, {0, 0, 2.7}, glass);
            b.add_quad({4.8, 0, 0}, {0, 0, 2.7}, {0, 3, 0}, mirror);
            b.add_panel({1, 1, 2.65}, {0, 0.6, 0}, {0.6, 0, 0}, 5000);
        },
        grid({2.2, 0, 0.8}, {2.2, 0, 0}, {0, 3, 0}, {0, 0, 1}),
        0.012};
}

Case coloured_sensors() {
    Case c = furnished();
    c.name = "cylindrical, semi-cylindrical, hemispherical and spherical receivers";
    int i = 0;
    for (Receiver& r : c.receivers) {
        r.kind = static_cast<IlluminanceKind>(1 + i++ % 4);
        r.reference = UnitVector3({1, 0.5, 0});
        r.point.z = 1.2;
    }
    return c;
}

std::string what_the_default_does(const Scene& scene, const std::vector<Receiver>& points) {
    std::vector<CalculationSurface> surfaces(1);
    surfaces[0].receivers = points;
    Settings settings;
    settings.fixed_units = 1;
    return calculate(scene, surfaces, settings).estimator;
}

class Estimators : public testing::TestWithParam<Case> {};

TEST_P(Estimators, AgreeOnEveryProjection) {
    Builder b;
    GetParam().build(b);
    const Scene scene = b.build();
    const auto& points = GetParam().receivers;
    const auto mis = test::sample(scene, points, Estimator::local_estimation_mis, 8, 1);
    const auto local = test::sample(scene, points, Estimator::local_estimation, 8, 11);
    const auto traced = test::sample(scene, points, Estimator::path_tracing, 16, 21);
    const auto bounded = test::sample(scene, points, Estimator::bounded, 8, 31);
    const auto joined = test::sample(scene, points, Estimator::bidirectional, 16, 41);
    // some points gather and some do not, METHODS eq. (140); corners are walked, (122)
    const auto chosen = test::sample(scene, points, Estimator::automatic, 8, 51);
    for (std::uint32_t k = 0; k < 8; ++k) {
        const Estimate a = mis.projection(k);
        const Estimate b1 = local.projection(k);
        const Estimate c = traced.projection(k);
        EXPECT_LT(std::abs(test::z_score(a, c)), test::z_limit)
            << "local estimation with gathering against path tracing, combination " << k << ": "
            << a.mean << " +- " << a.standard_error << ", " << c.mean << " +- "
            << c.standard_error;
        EXPECT_LT(std::abs(test::z_score(b1, c)), test::z_limit)
            << "plain local estimation against path tracing, combination " << k << ": "
            << b1.mean << " +- " << b1.standard_error << ", " << c.mean << " +- "
            << c.standard_error;
        const Estimate d = bounded.projection(k);
        const Estimate e = joined.projection(k);
        EXPECT_LT(std::abs(test::z_score(d, c)), test::z_limit)
            << "bounded kernel against path tracing, combination " << k << ": " << d.mean
            << " +- " << d.standard_error << ", " << c.mean << " +- " << c.standard_error;
        EXPECT_LT(std::abs(test::z_score(e, a)), test::z_limit)
            << "bidirectional against local estimation with gathering, combination " << k
            << ": " << e.mean << " +- " << e.standard_error << ", " << a.mean << " +- "
            << a.standard_error;
        const Estimate f = chosen.projection(k);
        EXPECT_LT(std::abs(test::z_score(f, c)), test::z_limit)
            << "the default against path tracing, combination " << k << ": " << f.mean << " +- "
            << f.standard_error << ", " << c.mean << " +- " << c.standard_error;
        if (k == 0)
            RecordProperty("z",
                           std::to_string(test::z_score(a, c)) + " "
                               + std::to_string(test::z_score(b1, c)) + " "
                               + std::to_string(test::z_score(d, c)) + " "
                               + std::to_string(test::z_score(e, a)));
    }
    const std::string said = what_the_default_does(scene, points);
    EXPECT_NE(said.find("path tracing (0 points)"), std::string::npos) << said;
    EXPECT_EQ(said.find("that gather: 0"), std::string::npos) << said;
    EXPECT_EQ(said.find("that gather: 12") == std::string::npos, !GetParam().is_dark) << said;
    // Power: what the comparison could have seen.
    EXPECT_LT(mis.mean().standard_error, GetParam().power * mis.mean().mean);
}

INSTANTIATE_TEST_SUITE_P(Rooms,
                         Estimators,
                         testing::Values(furnished(),
                                         mirror_floor(),
                                         two_mirrors(),
                                         behind_glass(),
                                         panes_in_a_row(),
                                         coloured_sensors()),
                         [](const auto& test) {
                             std::string name = test.param.name;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c)))
                                     c = '_';
                             return name;
                         });

/// The number that follows some words.
double number_after(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos ? -1.0 : std::stod(text.substr(at + words.size()));
}

/// METHODS eq. (140): a row of points at growing distances from a wall, and only that wall
/// anywhere near.
TEST(WhoGathers, FollowsFromTheDistanceTwiceAsFarToATolerance) {
    Builder b;
    const MaterialId grey = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {12, 10, 9}, grey, grey, grey);
    b.add_panel({6, 5, 8.9}, {0, 1, 0}, {1, 0, 0}, 20000.0);
    const Scene scene = b.build();
    std::vector<CalculationSurface> surfaces(1);
    for (int i = 1; i <= 60; ++i)
        surfaces[0].receivers.push_back({{0.07 * i, 5.0, 0.8}, UnitVector3(Vector3{0, 0, 1})});
    for (const bool is_fixed : {true, false}) {
        Settings settings;
        settings.tolerance = 0.02;
        if (is_fixed)
            settings.fixed_units = 1;
        const std::string said = calculate(scene, surfaces, settings).estimator;
        const double m = number_after(said, "light paths per replicate and unit: ");
        ASSERT_GE(m, 256.0) << said;
        const double reach =
            std::min(4.0, (is_fixed ? 1.0 : 2.0) * std::sqrt(scene.total_area / m));
        const auto expected = std::ranges::count_if(
            surfaces[0].receivers, [&](const Receiver& r) { return r.point.x < reach; });
        EXPECT_EQ(number_after(said, "that gather: "), static_cast<double>(expected)) << said;
        EXPECT_GT(expected, 0);
        EXPECT_LT(expected, 60);
    }
}

} // namespace
} // namespace isolux
