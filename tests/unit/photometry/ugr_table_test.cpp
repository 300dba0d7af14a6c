#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "isolux/photometry/position_index.h"
#include "isolux/photometry/quantities.h"
#include "isolux/photometry/ugr_table.h"

#include "support/photometric_files.h"

namespace isolux {
namespace {

constexpr double pi = std::numbers::pi;

LuminairePhotometry panel(double x, double y, double axial_candela) {
    std::vector<Angle> gammas;
    std::vector<double> candela;
    for (int plane = 0; plane < 2; ++plane)
        for (int g = 0; g <= 360; ++g) {
            if (plane == 0)
                gammas.push_back(degrees(0.25 * g));
            candela.push_back(axial_candela
                              * std::max(0.0, std::cos(degrees(0.25 * g).in_radians())));
        }
    const LuminousOpening opening{OpeningShape::rectangle, Metre(x), Metre(y), Metre()};
    return {.format = PhotometricFormat::eulumdat,
            .photometric_type = 'C',
            .symmetry = {},
            .planes_in_file = 0,
            .gammas_in_file = 0,
            .manufacturer = {},
            .name = {},
            .catalogue_number = {},
            .distribution = {{degrees(0), degrees(360)}, std::move(gammas), std::move(candela)},
            .opening = opening,
            .housing = opening,
            .is_absolute = true,
            .declared_flux = std::nullopt,
            .lamp_sets = {},
            .input_watts = 0.0};
}

TEST(GuthIndex, IsOneOnTheLineOfSightAndGrowsAwayFromIt) {
    EXPECT_DOUBLE_EQ(guth_position_index(degrees(0), degrees(30)), 1.0);
    EXPECT_LT(guth_position_index(degrees(10), degrees(30)),
              guth_position_index(degrees(20), degrees(30)));
    // the UGR reference scene of nine panels, first panel
    EXPECT_NEAR(guth_position_index(degrees(56.02724), degrees(57.38076)), 5.931357, 1e-5);
}

TEST(TabulatedIndex, IsThePrintedTableWithinAndNothingBeyond) {
    EXPECT_DOUBLE_EQ(tabulated_position_index(0, 0).value(), 1.0);
    EXPECT_DOUBLE_EQ(tabulated_position_index(0.5, 0.5).value(), 2.91);
    EXPECT_NEAR(tabulated_position_index(1.9, 3.0).value(), 16.0, 1e-12);
    EXPECT_NEAR(
        tabulated_position_index(0.55, 0.55).value(), (2.91 + 3.10 + 3.40 + 3.60) / 4, 1e-9);
    EXPECT_FALSE(tabulated_position_index(1.75, 0.05)); // blank in print
    EXPECT_FALSE(tabulated_position_index(2.0, 1.0));
    EXPECT_FALSE(tabulated_position_index(1.0, 3.1));
    EXPECT_FALSE(tabulated_position_index(std::nan(""), 1.0));
    // a slip of a finger among 600 numbers would stand out against the formula, which was
    // fitted to them: at most 11 % apart where print is not blank
    for (int h = 0; h <= 17; ++h)
        for (int w = 0; w <= 30; ++w) {
            const double height = 0.1 * h, sideways = 0.1 * w;
            const double formula =
                guth_position_index(radians(std::atan(std::hypot(height, sideways))),
                                    radians(std::atan2(sideways, height)));
            EXPECT_NEAR(
                tabulated_position_index(height, sideways).value() / formula, 1.0, 0.112)
                << height << " " << sideways;
        }
}

/// Light that starts with the same illuminance everywhere stays uniform where all surfaces have
/// one reflectance: the indirect part is direct * rho / (1 - rho), whatever the shape. View
/// factors that do not close, or an elimination gone wrong, break it.
TEST(WallIlluminance, KeepsTheBalanceOfABoxOfOneReflectance) {
    const double rho = 0.6, x = 3, y = 5, h = 2;
    const double plane = x * y, walls = 2 * (x + y) * h, direct = 70;
    const std::array<Lumen, 3> uniform{
        Lumen(direct * plane), Lumen(direct * walls), Lumen(direct * plane)};
    EXPECT_NEAR(indirect_wall_illuminance(x, y, h, uniform, {rho, rho, rho}).value(),
                direct * rho / (1 - rho),
                1e-9);
}

TEST(WallIlluminance, IsOneBounceWhereOnlyTheFloorReflects) {
    // floor to walls: 1 - F, with F of two parallel unit squares at distance 1
    const double parallel_unit_squares = 0.199825;
    const std::array<Lumen, 3> flux{Lumen(0), Lumen(0), Lumen(1000)};
    const double walls = 4.0;
    EXPECT_NEAR(indirect_wall_illuminance(1, 1, 1, flux, {0, 0, 0.2}).value(),
                0.2 * 1000 * (1 - parallel_unit_squares) / walls,
                1e-3);
}

TEST(WallIlluminance, AddsUpWhatStartsAnywhere) {
    const UgrReflectances r{0.7, 0.5, 0.2};
    const auto at = [&](double c, double w, double f) {
        return indirect_wall_illuminance(4, 8, 2, {Lumen(c), Lumen(w), Lumen(f)}, r).value();
    };
    EXPECT_NEAR(at(100, 200, 300), at(100, 0, 0) + at(0, 200, 0) + at(0, 0, 300), 1e-9);
    EXPECT_NEAR(
        indirect_wall_illuminance(4, 8, 2, {Lumen(9), Lumen(9), Lumen(9)}, {0, 0, 0}).value(),
        0.0,
        1e-12);
}

/// Room 2H x 2H at S = H: four luminaires, summed here by hand.
TEST(UgrTable, IsTheFormulaInASmallRoom) {
    const double axial = 1000, side = 0.6;
    const auto l = panel(side, side, axial);
    const auto table = make_ugr_table(l, 1.0);
    ASSERT_TRUE(table.has_value());
    // the two at y = 1 are too high for the table of position indices; those at y = 3 lie at
    // height 2/3, sideways 1/3, between its nodes 3.25 3.90 and 3.30 3.90
    double glare = 0;
    for (int side_of_observer = 0; side_of_observer < 2; ++side_of_observer) {
        const double r2 = 1 + 9 + 4, cosine = 2 / std::sqrt(r2);
        const double p = (2 * (3.25 / 3 + 3.90 * 2 / 3) + (3.30 / 3 + 3.90 * 2 / 3)) / 3;
        const double luminance = axial / (side * side);
        glare += luminance * luminance * side * side * cosine / r2 / (p * p);
    }
    // a Lambertian point over a rectangle: closed-form corner configurations give the floor's
    // share
    const auto corner = [](double a, double b) { // flux on a x b below its corner, cd * sr
        const auto term = [](double u, double v) {
            const double s = std::sqrt(u * u + 4);
            return 0.5 * u / s * std::atan(v / s);
        };
        return term(a, b) + term(b, a);
    };
    double floor = 0;
    for (const double a : {1.0, 3.0})
        for (const double b : {1.0, 3.0})
            floor += axial * corner(a, b);
    floor *= 4; // each luminaire sees the four rectangles of the one in the corner
    const double all = 4 * pi * axial;
    const double lb =
        indirect_wall_illuminance(
            4, 4, 2, {Lumen(0), Lumen(all - floor), Lumen(floor)}, {0.7, 0.5, 0.2})
            .value()
        / pi;
    const double expected = 8 * std::log10(0.25 * glare / lb);
    // rays are half a degree apart, so the edge of the floor is known to about 1 % of its flux,
    // and 1 % of the background is 0.03 UGR
    EXPECT_NEAR(table->crosswise[0][0], expected, 0.03);
    EXPECT_NEAR(table->endwise[0][0], expected, 0.03);
}

TEST(UgrTable, RisesWithDarkerRoomsAndByEightForTenTimesTheLight) {
    const auto l = panel(0.6, 0.6, 1000), brighter = panel(0.6, 0.6, 10000);
    const auto table = make_ugr_table(l), ten = make_ugr_table(brighter);
    for (std::size_t r = 0; r < ugr_rooms.size(); ++r) {
        EXPECT_LT(table->crosswise[r][0], table->crosswise[r][1]);
        EXPECT_LT(table->crosswise[r][0], table->crosswise[r][2]);
        EXPECT_LT(table->crosswise[r][3], table->crosswise[r][4]);
        EXPECT_NEAR(ten->crosswise[r][2], table->crosswise[r][2] + 8, 1e-9);
    }
}

TEST(UgrTable, TurnsWithTheLengthOfTheLuminaire) {
    // light along x only where the body is long in y, and the same luminaire turned by 90
    // degrees
    const auto make = [](bool length_is_x) {
        auto l = panel(length_is_x ? 1.2 : 0.3, length_is_x ? 0.3 : 1.2, 1000);
        std::vector<Angle> planes, gammas;
        std::vector<double> candela;
        for (int c = 0; c <= 360; c += 15) {
            planes.push_back(degrees(c));
            for (int g = 0; g <= 90; g += 5) {
                if (c == 0)
                    gammas.push_back(degrees(g));
                const double across = std::cos(degrees(length_is_x ? c - 90 : c).in_radians());
                candela.push_back(1000 * std::cos(degrees(g).in_radians() * 0.999)
                                  * (0.3 + across * across));
            }
        }
        l.distribution = {std::move(planes), std::move(gammas), std::move(candela)};
        return l;
    };
    const auto y = make_ugr_table(make(false)), x = make_ugr_table(make(true));
    for (std::size_t r = 0; r < ugr_rooms.size(); ++r)
        for (std::size_t k = 0; k < ugr_reflectances.size(); ++k) {
            EXPECT_NEAR(y->crosswise[r][k], x->crosswise[r][k], 1e-6);
            EXPECT_NEAR(y->endwise[r][k], x->endwise[r][k], 1e-6);
            EXPECT_GT(y->crosswise[r][k], y->endwise[r][k]);
        }
}

using PrintedTable = std::array<std::array<double, 10>, 19>; ///< crosswise, then endwise

/// The example of CIE 190:2010, S = H.
constexpr PrintedTable example_of_cie_190{{
    {8.9, 10.5, 9.3, 10.8, 11.1, 10.7, 12.2, 11.0, 12.5, 12.9},
    {10.5, 11.9, 10.8, 12.2, 12.6, 12.4, 13.8, 12.8, 14.2, 14.5},
    {11.0, 12.3, 11.4, 12.6, 13.0, 13.1, 14.5, 13.5, 14.8, 15.2},
    {11.5, 12.7, 11.9, 13.1, 13.5, 13.6, 14.8, 14.0, 15.2, 15.6},
    {11.7, 12.9, 12.2, 13.3, 13.7, 13.8, 14.9, 14.2, 15.3, 15.7},
    {12.0, 13.2, 12.5, 13.5, 14.0, 13.8, 15.0, 14.3, 15.3, 15.8},
    {9.6, 11.0, 10.0, 11.3, 11.7, 11.0, 12.4, 11.4, 12.7, 13.1},
    {11.4, 12.5, 11.8, 12.9, 13.3, 13.0, 14.1, 13.4, 14.5, 14.9},
    {12.0, 13.0, 12.4, 13.4, 13.9, 13.9, 14.9, 14.3, 15.3, 15.7},
    {12.7, 13.5, 13.1, 14.0, 14.4, 14.5, 15.4, 15.0, 15.8, 16.3},
    {13.0, 13.8, 13.5, 14.2, 14.7, 14.7, 15.5, 15.2, 16.0, 16.4},
    {13.4, 14.1, 13.8, 14.6, 15.0, 14.8, 15.6, 15.3, 16.0, 16.5},
    {12.4, 13.2, 12.8, 13.6, 14.1, 14.0, 14.8, 14.5, 15.3, 15.8},
    {13.2, 13.8, 13.7, 14.3, 14.8, 14.8, 15.4, 15.3, 15.9, 16.4},
    {13.6, 14.2, 14.1, 14.7, 15.2, 15.0, 15.6, 15.5, 16.1, 16.6},
    {14.1, 14.7, 14.6, 15.1, 15.7, 15.2, 15.7, 15.7, 16.2, 16.8},
    {12.4, 13.1, 12.9, 13.6, 14.1, 14.0, 14.8, 14.5, 15.2, 15.7},
    {13.2, 13.8, 13.8, 14.3, 14.8, 14.8, 15.4, 15.3, 15.9, 16.4},
    {13.7, 14.3, 14.3, 14.8, 15.3, 15.1, 15.6, 15.6, 16.1, 16.7},
}};

/// The same luminaire in Relux, S = 0.25 H; 0 stands for "below 10". From the reference data of
/// github.com/123VincentB/eulumdat-ugr, sample 11.
constexpr PrintedTable example_in_relux{{
    {0, 11.1, 0, 11.4, 11.8, 11.1, 12.6, 11.4, 13.0, 13.3},
    {10.8, 12.2, 11.1, 12.5, 12.9, 12.6, 14.0, 12.9, 14.3, 14.7},
    {11.2, 12.6, 11.6, 12.9, 13.3, 13.2, 14.6, 13.6, 14.9, 15.3},
    {11.7, 12.9, 12.1, 13.3, 13.7, 13.7, 14.9, 14.1, 15.3, 15.7},
    {11.9, 13.1, 12.3, 13.5, 13.9, 13.8, 15.0, 14.2, 15.4, 15.8},
    {12.2, 13.3, 12.6, 13.7, 14.1, 13.8, 15.0, 14.3, 15.4, 15.8},
    {10.3, 11.7, 10.7, 12.0, 12.4, 11.5, 12.9, 11.9, 13.2, 13.6},
    {11.7, 12.8, 12.1, 13.2, 13.6, 13.2, 14.4, 13.6, 14.7, 15.2},
    {12.3, 13.3, 12.7, 13.7, 14.2, 14.0, 15.0, 14.5, 15.5, 15.9},
    {12.9, 13.8, 13.3, 14.2, 14.7, 14.6, 15.5, 15.1, 16.0, 16.4},
    {13.2, 14.0, 13.7, 14.5, 14.9, 14.8, 15.6, 15.3, 16.1, 16.5},
    {13.5, 14.3, 14.0, 14.8, 15.3, 14.9, 15.7, 15.4, 16.1, 16.6},
    {12.6, 13.5, 13.1, 13.9, 14.4, 14.2, 15.0, 14.6, 15.5, 15.9},
    {13.3, 14.0, 13.8, 14.5, 15.0, 14.8, 15.5, 15.3, 16.0, 16.5},
    {13.8, 14.4, 14.3, 14.9, 15.4, 15.1, 15.7, 15.6, 16.2, 16.7},
    {14.3, 14.8, 14.8, 15.3, 15.8, 15.3, 15.8, 15.8, 16.3, 16.8},
    {12.7, 13.4, 13.1, 13.9, 14.4, 14.2, 15.0, 14.7, 15.4, 15.9},
    {13.4, 14.0, 13.9, 14.6, 15.0, 14.9, 15.5, 15.4, 16.0, 16.5},
    {13.9, 14.4, 14.4, 14.9, 15.4, 15.2, 15.7, 15.7, 16.2, 16.7},
}};

void expect_printed(const UgrTable& table, const PrintedTable& printed) {
    for (std::size_t room = 0; room < printed.size(); ++room)
        for (std::size_t k = 0; k < 5; ++k)
            for (const auto& [ours, theirs] :
                 {std::pair{table.crosswise[room][k], printed[room][k]},
                  std::pair{table.endwise[room][k], printed[room][k + 5]}}) {
                // half a digit of theirs, and their zones of 10 degrees and rounded factors
                if (theirs > 0.0)
                    EXPECT_NEAR(ours, theirs, 0.05 + 0.1) << "room " << room << ", set " << k;
                else
                    EXPECT_LT(ours, 10.05);
            }
}

TEST(UgrTable, IsThePrintedOneOfTheExampleLuminaire) {
    ISOLUX_NEEDS_CORPUS();
    const auto luminaire = corpus::read("valid", "cie190-table7.ldt").value;
    expect_printed(make_ugr_table(luminaire, 1.0).value(), example_of_cie_190);
    expect_printed(make_ugr_table(luminaire, 0.25).value(), example_in_relux);
}

TEST(UgrTable, NeedsALuminousArea) {
    auto l = panel(0.6, 0.6, 1000);
    l.opening = {};
    EXPECT_FALSE(make_ugr_table(l).has_value());
}

} // namespace
} // namespace isolux
