// METHODS 7.2 rows 8 and 22: directions drawn from a table have exactly its density; smooth
// direct light by scrambled nets converges faster than 1/n.

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "isolux/transport/emission.h"
#include "isolux/transport/point_randomness.h"
#include "isolux/transport/table_sampler.h"

#include "support/statistics.h"
#include "support/test_scene.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

/// A table of random candelas with a dark sector; planes over `last_plane` degrees, as files of
/// different symmetry store them once they are spread out.
IntensityDistribution random_table(double plane_step, double last_plane, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> u(0.0, 1000.0);
    std::vector<Angle> planes;
    for (double c = 0.0; c <= last_plane + 1e-9; c += plane_step)
        planes.push_back(degrees(c));
    std::vector<Angle> gammas;
    for (double g = 0.0; g <= 180.0; g += 12.5)
        gammas.push_back(degrees(g));
    gammas.push_back(degrees(180.0));
    std::vector<double> candela;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = 0; j < gammas.size(); ++j)
            candela.push_back(j > 12 ? 0.0 : u(engine));
    // Where the table closes its circle it repeats its first plane.
    if (last_plane == 360.0)
        std::copy_n(candela.begin(),
                    gammas.size(),
                    candela.end() - static_cast<std::ptrdiff_t>(gammas.size()));
    return {planes, gammas, candela};
}

/// Flux through a patch of the sphere by the midpoint rule.
double flux_through(const TableSampler& sampler, double c0, double c1, double g0, double g1) {
    constexpr int n = 60;
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double c = c0 + (c1 - c0) * (i + 0.5) / n;
            const double g = g0 + (g1 - g0) * (j + 0.5) / n;
            const UnitVector3 w(
                {std::sin(g) * std::cos(c), std::sin(g) * std::sin(c), -std::cos(g)});
            sum += sampler.pdf(w) * std::sin(g);
        }
    return sum * (c1 - c0) / n * (g1 - g0) / n;
}

class TableDirections : public testing::TestWithParam<double> {};

TEST_P(TableDirections, FallIntoTwoHundredPatchesAsTheTableSays) {
    const IntensityDistribution table =
        random_table(GetParam() / 8.0, GetParam(), static_cast<unsigned>(GetParam()));
    const TableSampler sampler(table);
    constexpr int columns = 20;
    constexpr int rows = 10;
    constexpr int draws = 200000;
    std::vector<double> observed(columns * rows, 0.0);
    std::mt19937_64 engine(11);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (int i = 0; i < draws; ++i) {
        const double a = u(engine);
        const Vector3 w = sampler.sample(a, u(engine));
        const double gamma = std::acos(std::clamp(-w.z, -1.0, 1.0));
        double c = std::atan2(w.y, w.x);
        c += c < 0.0 ? 2.0 * pi : 0.0;
        const int column = std::min(columns - 1, static_cast<int>(c / (2.0 * pi) * columns));
        const int row = std::min(rows - 1, static_cast<int>(gamma / pi * rows));
        observed[static_cast<std::size_t>(row * columns + column)] += 1.0;
    }
    std::vector<double> seen;
    std::vector<double> expected;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            const double share = flux_through(sampler,
                                              2.0 * pi * c / columns,
                                              2.0 * pi * (c + 1) / columns,
                                              pi * r / rows,
                                              pi * (r + 1) / rows);
            const double count = observed[static_cast<std::size_t>(r * columns + c)];
            if (share * draws < 5.0) {
                EXPECT_LT(count, 40.0) << "hardly any light there";
                continue;
            }
            seen.push_back(count);
            expected.push_back(share * draws);
        }
    EXPECT_GT(seen.size(), 150U);
    // What the quadrature misses is shared out, so that both sum to the draws.
    double sum_seen = 0.0;
    double sum_expected = 0.0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        sum_seen += seen[i];
        sum_expected += expected[i];
    }
    EXPECT_NEAR(sum_expected, sum_seen, 0.002 * draws);
    for (double& e : expected)
        e *= sum_seen / sum_expected;
    EXPECT_GT(test::chi_square_tail(seen, expected), test::chi_square_false_alarm);
}

TEST_P(TableDirections, HaveTheFluxOfAFineQuadrature) {
    const IntensityDistribution table =
        random_table(GetParam() / 8.0, GetParam(), static_cast<unsigned>(GetParam()));
    const TableSampler sampler(table);
    // The interpolant is bilinear in C and gamma, so whole cells integrate exactly in C.
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < table.planes().size(); ++i)
        for (std::size_t j = 0; j + 1 < table.gammas().size(); ++j) {
            const double g0 = table.gammas()[j].in_radians();
            const double g1 = table.gammas()[j + 1].in_radians();
            const double dc =
                table.planes()[i + 1].in_radians() - table.planes()[i].in_radians();
            constexpr int n = 4000;
            for (int k = 0; k < n; ++k) {
                const double t = (k + 0.5) / n;
                const double low =
                    0.5 * (in_candela(table.at(i, j)) + in_candela(table.at(i + 1, j)));
                const double high =
                    0.5 * (in_candela(table.at(i, j + 1)) + in_candela(table.at(i + 1, j + 1)));
                sum += dc * (g1 - g0) / n * ((1.0 - t) * low + t * high)
                       * std::sin(g0 + t * (g1 - g0));
            }
        }
    EXPECT_NEAR(in_lumen(table.flux()), sum * (360.0 / GetParam()), 1e-7 * sum);
    EXPECT_NEAR(sampler.flux(), in_lumen(table.flux()), 1e-9 * sampler.flux());
}

TEST_P(TableDirections, KnowTheIntensityThere) {
    const IntensityDistribution table =
        random_table(GetParam() / 8.0, GetParam(), static_cast<unsigned>(GetParam()));
    const TableSampler sampler(table);
    std::mt19937_64 engine(12);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (int i = 0; i < 20000; ++i) {
        const double a = u(engine);
        const TableDraw draw = sampler.draw(a, u(engine));
        EXPECT_NEAR(length(draw.direction), 1.0, 1e-14);
        ASSERT_NEAR(draw.candela, in_candela(table.evaluate(draw.direction)), 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Symmetries, TableDirections, testing::Values(360.0));

/// Variance between replicates of the illuminance of a panel, n samples each.
double variance_of_direct_light(const Emission& emission, std::uint32_t n) {
    constexpr std::uint32_t replicates = 64;
    const Point3 at{0.3, -0.2, 0.0};
    const OpeningView view = emission.view(0, at);
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t r = 0; r < replicates; ++r) {
        const PointRandomness random(3, StreamPurpose::direct, r, 17);
        double e = 0.0;
        for (std::uint32_t i = 0; i < n; ++i) {
            const EmissionPoint from = view.sample(random(i, 0), random(i, 1));
            const Vector3 d = at - from.position;
            const UnitVector3 w(d);
            e += emission.evaluate(from, w) * -w.z() / (length_squared(d) * view.pdf(from)) / n;
        }
        sum += e;
        squares += e * e;
    }
    const double mean = sum / replicates;
    return (squares / replicates - mean * mean) * replicates / (replicates - 1.0);
}

TEST(ScrambledNets, LetSmoothDirectLightConvergeFasterThanOneOverN) {
    test::Builder b;
    const auto floor = b.add_diffuse(0.5);
    b.add_quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}, floor);
    b.add_panel({-0.6, -0.15, 2.0}, {0, 0.3, 0}, {1.2, 0, 0}, 3000.0);
    const Scene scene = b.build();
    const Emission emission(scene);
    // Least squares through log variance over log n.
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, count = 0.0;
    for (std::uint32_t n = 1U << 6U; n <= 1U << 14U; n *= 2) {
        const double x = std::log(static_cast<double>(n));
        const double y = std::log(variance_of_direct_light(emission, n));
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
        count += 1.0;
    }
    const double slope = (count * sxy - sx * sy) / (count * sxx - sx * sx);
    EXPECT_LT(slope, -1.5);
    RecordProperty("slope", std::to_string(slope));
}

} // namespace
} // namespace isolux
