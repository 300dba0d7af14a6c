#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>

#include "isolux/photometry/intensity_distribution.h"
#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<Angle> in_angles(std::initializer_list<double> values) {
    std::vector<Angle> angles;
    for (const double v : values)
        angles.push_back(degrees(v));
    return angles;
}

std::vector<Angle> evenly(double first, double last, int intervals) {
    std::vector<Angle> angles;
    for (int i = 0; i <= intervals; ++i)
        angles.push_back(degrees(first + (last - first) * i / intervals));
    return angles;
}

template <class F>
IntensityDistribution
tabulate(std::vector<Angle> planes, std::vector<Angle> gammas, F f, TablePole pole = {}) {
    std::vector<double> candela;
    for (const Angle c : planes)
        for (const Angle g : gammas)
            candela.push_back(f(c.in_degrees(), g.in_degrees()));
    return {std::move(planes), std::move(gammas), std::move(candela), pole};
}

UnitVector3 towards(double c, double gamma) {
    const double p = degrees(c).in_radians();
    const double g = degrees(gamma).in_radians();
    return UnitVector3({std::sin(g) * std::cos(p), std::sin(g) * std::sin(p), -std::cos(g)});
}

/// Linear in C and in gamma: a bilinear interpolant must reproduce it everywhere.
double ramp(double c, double gamma) { return 100.0 + 0.5 * c + 2.0 * gamma; }

TEST(IntensityDistribution, IsExactForALinearTableWithEvenSteps) {
    const auto table = tabulate(evenly(0, 90, 6), evenly(0, 90, 18), ramp);
    for (double c = 0.5; c < 90; c += 7.3)
        for (double g = 0.1; g < 90; g += 3.7) {
            EXPECT_NEAR(table.evaluate(towards(c, g)).value(), ramp(c, g), 1e-9);
            EXPECT_NEAR(table.evaluate(degrees(c), degrees(g)).value(), ramp(c, g), 1e-9);
        }
}

TEST(IntensityDistribution, IsExactForALinearTableWithUnevenSteps) {
    const auto table =
        tabulate(in_angles({0, 1, 20, 33, 90}), in_angles({0, 2, 3, 40, 60, 61, 90}), ramp);
    for (double c = 0.5; c < 90; c += 7.3)
        for (double g = 0.1; g < 90; g += 3.7)
            EXPECT_NEAR(table.evaluate(towards(c, g)).value(), ramp(c, g), 1e-9);
}

TEST(IntensityDistribution, GivesTheTablesOwnValuesAtItsNodes) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> value(0.0, 1000.0);
    const auto table = tabulate(
        evenly(0, 360, 24), evenly(0, 180, 72), [&](double, double) { return value(random); });
    for (std::size_t p = 0; p + 1 < table.planes().size(); ++p)
        for (std::size_t g = 1; g + 1 < table.gammas().size(); ++g) {
            const auto d = table.direction(table.planes()[p], table.gammas()[g]);
            EXPECT_NEAR(table.evaluate(d).value(), table.at(p, g).value(), 1e-9);
        }
}

TEST(IntensityDistribution, TakesTheAzimuthModuloATurn) {
    const auto table = tabulate(evenly(0, 360, 36), evenly(0, 180, 18), [](double c, double g) {
        return 5.0 + std::cos(c * pi / 180.0) + g;
    });
    EXPECT_NEAR(table.evaluate(degrees(-25), degrees(50)).value(),
                table.evaluate(degrees(335), degrees(50)).value(),
                1e-10);
    EXPECT_NEAR(table.evaluate(degrees(725), degrees(50)).value(),
                table.evaluate(degrees(5), degrees(50)).value(),
                1e-10);
    EXPECT_NEAR(table.evaluate(degrees(360), degrees(50)).value(), 56.0, 1e-10);
}

TEST(IntensityDistribution, IsZeroOutsideTheTabulatedGammas) {
    const auto table =
        tabulate(evenly(0, 360, 1), evenly(30, 90, 6), [](double, double) { return 7.0; });
    EXPECT_EQ(table.evaluate(towards(10, 29)).value(), 0.0);
    EXPECT_EQ(table.evaluate(towards(10, 91)).value(), 0.0);
    EXPECT_EQ(table.evaluate(towards(10, 30)).value(), 7.0);
    EXPECT_EQ(table.evaluate(towards(10, 90)).value(), 7.0);
}

TEST(IntensityDistribution, IsZeroOutsideAPartialAzimuthRange) {
    const auto front =
        tabulate(evenly(-90, 90, 18), evenly(0, 180, 18), [](double, double) { return 100.0; });
    EXPECT_EQ(front.evaluate(towards(89, 90)).value(), 100.0);
    EXPECT_EQ(front.evaluate(towards(-89, 90)).value(), 100.0);
    EXPECT_EQ(front.evaluate(towards(90, 90)).value(), 100.0);
    EXPECT_EQ(front.evaluate(towards(-90, 90)).value(), 100.0);
    EXPECT_EQ(front.evaluate(towards(91, 90)).value(), 0.0);
    EXPECT_EQ(front.evaluate(towards(269, 90)).value(), 0.0);
    EXPECT_NEAR(front.flux().value(), 200.0 * pi, 1e-9);
    EXPECT_NEAR(front.flux_trapezoid().value(), 200.0 * pi, 1e-9);
}

TEST(IntensityDistribution, LiesOnItsSideForTypeB) {
    // V and H as in the file: 500 + 3 H + 2 V; the direction is (cosH sinV, -sinH, -cosH cosV)
    const auto table = tabulate(
        evenly(-90, 90, 36),
        evenly(0, 180, 36),
        [](double v, double g) { return 500.0 + 3.0 * (g - 90.0) + 2.0 * v; },
        TablePole::lateral);
    for (double v = -80; v <= 80; v += 11)
        for (double h = -80; h <= 80; h += 13) {
            const double vr = v * pi / 180.0, hr = h * pi / 180.0;
            const UnitVector3 d(
                {std::cos(hr) * std::sin(vr), -std::sin(hr), -std::cos(hr) * std::cos(vr)});
            EXPECT_NEAR(table.evaluate(d).value(), 500.0 + 3.0 * h + 2.0 * v, 1e-9);
            EXPECT_NEAR(length(table.direction(degrees(v), degrees(h + 90)) - d), 0.0, 1e-15);
        }
    EXPECT_EQ(table.evaluate(UnitVector3({0, 0, 1})).value(), 0.0);
}

TEST(IntensityDistribution, IntegratesAUniformTableExactlyByBothRules) {
    const auto table = tabulate(in_angles({0, 10, 100, 360}),
                                in_angles({0, 1, 50, 180}),
                                [](double, double) { return 100.0; });
    EXPECT_NEAR(table.flux().value(), 400.0 * pi, 1e-9);
    EXPECT_NEAR(table.flux_trapezoid().value(), 400.0 * pi, 1e-9);
}

/// The interpolant's integral has no closed form in common functions other than eq. (4), so
/// eq. (4) is held against a fine midpoint sum over the interpolant itself.
TEST(IntensityDistribution, FluxIsTheIntegralOfWhatEvaluateGives) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> value(0.0, 1000.0);
    for (const TablePole pole : {TablePole::nadir, TablePole::lateral}) {
        const auto table = tabulate(
            in_angles({-90, -30, 0, 45, 90}),
            in_angles({0, 0.5, 20, 90, 150}),
            [&](double, double) { return value(random); },
            pole);
        const int n = 1800;
        double sum = 0.0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double c = -90.0 + 180.0 * (i + 0.5) / n;
                const double g = 150.0 * (j + 0.5) / n;
                const double cell = degrees(180.0 / n).in_radians()
                                    * (std::cos(degrees(150.0 * j / n).in_radians())
                                       - std::cos(degrees(150.0 * (j + 1) / n).in_radians()));
                sum += table.evaluate(degrees(c), degrees(g)).value() * cell;
            }
        // nodes coincide with cell edges, so the midpoint rule's error is of second order:
        // below (150 degrees / 1800)^2 = 2e-6 of the flux
        EXPECT_NEAR(table.flux().value() / sum, 1.0, 2e-6);
    }
}

TEST(IntensityDistribution, FluxOfNarrowCellsDoesNotCancel) {
    // a cone of 0.001 degree steps: I = g (linear), flux = 2 pi (sin g - g cos g) * 180/pi
    const auto table = tabulate(
        evenly(0, 360, 1), evenly(0, 0.1, 100), [](double, double g) { return 1e6 * g; });
    const double g = 0.1 * pi / 180.0;
    const double expected =
        2.0 * pi * 1e6 * 180.0 / pi * (g * g * g / 3.0) * (1.0 - g * g / 10.0);
    EXPECT_NEAR(table.flux().value() / expected, 1.0, 1e-12);
}

TEST(IntensityDistribution, KnowsItsMaximum) {
    const auto table = tabulate(evenly(0, 90, 3), evenly(0, 90, 3), ramp);
    EXPECT_DOUBLE_EQ(table.max_intensity().value(), ramp(90, 90));
}

TEST(LuminairePhotometry, NamesItsFormatsAndShapes) {
    EXPECT_EQ(to_string(PhotometricFormat::lm63_2019), "LM-63-2019");
    EXPECT_EQ(to_string(PhotometricFormat::lm63_1986), "LM-63-1986");
    EXPECT_EQ(to_string(PhotometricFormat::eulumdat), "EULUMDAT");
    EXPECT_EQ(to_string(OpeningShape::vertical_cylinder), "vertical cylinder");
    EXPECT_EQ(to_string(OpeningShape::cylinder_along_y), "cylinder along y");
}

} // namespace
} // namespace isolux
