#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/viz/contours.h"
#include "isolux/viz/smooth_field.h"

namespace isolux {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

template <class F>
CellField make_field(GridCounts counts, double width, double height, const F& f) {
    CellField field{counts, width, height, {}};
    for (std::size_t j = 0; j < counts.rows; ++j)
        for (std::size_t i = 0; i < counts.columns; ++i)
            field.values.push_back(
                f(width * (static_cast<double>(i) + 0.5) / static_cast<double>(counts.columns),
                  height * (static_cast<double>(j) + 0.5) / static_cast<double>(counts.rows)));
    return field;
}

double area_of(const std::vector<Polyline>& loops) {
    double area = 0.0;
    for (const Polyline& loop : loops)
        area += signed_area(loop);
    return area;
}

// VTK's band filter stores cut points in single precision: up to 2^-24 of 10 m.
constexpr double float_rounding = 10.0 / (1 << 24);
constexpr double rounding = 3.0 * float_rounding;       // of 2 u + v
constexpr double area_rounding = 40.0 * float_rounding; // of a region with 40 m around it

TEST(Contours, OfALinearFieldAreStraightAndWhereTheyMustBe) {
    // E = 100 + 20 u + 10 v: the isolux E = 150 is the line 2 u + v = 5, corner to corner of
    // nothing in particular. Borders included: half a cell is continued in a straight line.
    const auto field =
        make_field({8, 6}, 4, 3, [](double u, double v) { return 100 + 20 * u + 10 * v; });
    const std::vector<double> levels{150};
    const auto contours = make_contours(field, levels);
    ASSERT_EQ(contours.size(), 1u);
    ASSERT_EQ(contours[0].lines.size(), 1u);
    const Polyline& line = contours[0].lines[0];
    for (const Point2& p : line)
        EXPECT_NEAR(2 * p.x + p.y, 5.0, rounding);
    EXPECT_NEAR(std::abs(line.front().y - line.back().y), 3.0, rounding);
    // Right of the line: 12 m2 less the trapezium with sides 2.5 and 1.
    EXPECT_NEAR(area_of(contours[0].region), 12.0 - 3.0 * (2.5 + 1.0) / 2.0, area_rounding);
}

TEST(Contours, ThroughGridPointsExactlyAtALevelStayWhole) {
    // Whole columns of points, and a plateau, lie exactly at the level.
    const auto field = make_field(
        {9, 5}, 9, 5, [](double u, double) { return 100.0 * std::min(5.0, std::floor(u)); });
    const std::vector<double> levels{300, 500};
    const auto contours = make_contours(field, levels);
    EXPECT_NEAR(area_of(contours[0].region), 5.0 * 5.5, 0.01);
    EXPECT_NEAR(area_of(contours[1].region), 5.0 * 3.5, 0.01);
}

TEST(Contours, OfAHillAreClosedRings) {
    const auto field = make_field({24, 24}, 6, 6, [](double u, double v) {
        return 1000 * std::exp(-0.5 * ((u - 3) * (u - 3) + (v - 3) * (v - 3)));
    });
    const std::vector<double> levels{200, 500};
    for (const Contour& c : make_contours(field, levels)) {
        ASSERT_EQ(c.lines.size(), 1u);
        EXPECT_EQ(c.lines[0].front(), c.lines[0].back());
        // The true ring has the area 2 pi ln(1000 / level). Cubic interpolation over steps of
        // h = 0.25 with second derivatives of order 1: relative error of order h^2 / 8.
        const double truth = 2.0 * std::numbers::pi * std::log(1000.0 / c.level);
        EXPECT_NEAR(area_of(c.region) / truth, 1.0, 0.25 * 0.25 / 8.0);
    }
}

TEST(Contours, LeaveHolesOut) {
    auto field = make_field({4, 4}, 4, 4, [](double u, double v) { return u + v; });
    for (const std::size_t cell : {10u, 11u, 14u, 15u}) // an L is left
        field.values[cell] = nothing;
    EXPECT_NEAR(area_of(outline_of_cells(field)), 12.0, area_rounding);
    const std::vector<double> levels{-1.0, 4.0};
    const auto contours = make_contours(field, levels);
    EXPECT_NEAR(area_of(contours[0].region), 12.0, area_rounding);
    for (const Polyline& line : contours[1].lines)
        for (const Point2& p : line)
            EXPECT_FALSE(p.x > 2 + rounding && p.y > 2 + rounding);
}

TEST(Outline, RunsAlongTheSidesThatOneCellHasAlone) {
    auto field = make_field({5, 4}, 5, 4, [](double u, double v) { return u + v; });
    for (const std::size_t cell : {1u, 7u, 12u, 19u}) // two notches, and holes that touch
        field.values[cell] = nothing;
    const Bands whole = cut_into_bands(field, {});
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (std::size_t k = 0; k < whole.polygons.size(); ++k) {
        const auto corners = whole.corners_of(k);
        for (std::size_t i = 0; i < corners.size(); ++i)
            sides.insert({corners[i], corners[(i + 1) % corners.size()]});
    }
    using Ends = std::array<double, 4>;
    std::vector<Ends> alone;
    for (const auto& [from, to] : sides)
        if (!sides.contains({to, from})) {
            const Point2 a = whole.points[from];
            const Point2 b = whole.points[to];
            alone.push_back({a.x, a.y, b.x, b.y});
        }
    std::vector<Ends> outline;
    for (const Polyline& loop : outline_of_cells(field))
        for (std::size_t i = 0; i + 1 < loop.size(); ++i)
            outline.push_back({loop[i].x, loop[i].y, loop[i + 1].x, loop[i + 1].y});
    std::ranges::sort(alone);
    std::ranges::sort(outline);
    EXPECT_EQ(outline, alone);
}

TEST(Bands, CoverTheFieldOnceEachWithItsOwnLight) {
    const auto field =
        make_field({8, 6}, 4, 3, [](double u, double v) { return 100 + 20 * u + 10 * v; });
    const std::vector<double> levels{120, 150};
    const Bands bands = cut_into_bands(field, levels);
    std::array<double, 3> area{};
    for (std::size_t k = 0; k < bands.polygons.size(); ++k) {
        Polyline polygon;
        for (const std::uint32_t corner : bands.corners_of(k))
            polygon.push_back(bands.points[corner]);
        area.at(bands.polygons[k].band) += signed_area(polygon);
    }
    // 2 u + v below 2 is a triangle; below 5 a trapezium, as above.
    EXPECT_NEAR(area[0], 1.0, area_rounding);
    EXPECT_NEAR(area[1], 3.0 * (2.5 + 1.0) / 2.0 - 1.0, area_rounding);
    EXPECT_NEAR(area[2], 12.0 - 3.0 * (2.5 + 1.0) / 2.0, area_rounding);
}

TEST(Contours, WorkOnOneRowAndOnOneCell) {
    const auto row = make_field({10, 1}, 10, 1, [](double u, double) { return u; });
    const std::vector<double> levels{5.0};
    const auto contours = make_contours(row, levels);
    EXPECT_NEAR(area_of(contours[0].region), 5.0, area_rounding);
    const auto cell = make_field({1, 1}, 2, 3, [](double, double) { return 7.0; });
    EXPECT_NEAR(area_of(outline_of_cells(cell)), 6.0, area_rounding);
    EXPECT_TRUE(make_contours(cell, {}).empty());
}

TEST(FillCells, ContinuesAPlaneAndOnlyWhereWanted) {
    auto field = make_field({5, 5}, 5, 5, [](double u, double v) { return 100 + 10 * u + v; });
    const double truth = field.values[24];
    field.values[24] = nothing;
    field.values[4] = nothing;
    std::vector<bool> wanted(25, false);
    wanted[24] = true;
    const CellField filled = fill_cells(field, wanted);
    EXPECT_NEAR(filled.values[24], truth, 1e-9);
    EXPECT_TRUE(std::isnan(filled.values[4]));
}

TEST(SmoothField, PassesThroughTheValuesAndNeverBeyondThem) {
    ValueTable cells{6, 5, {}};
    for (std::size_t k = 0; k < 30; ++k)
        cells.values.push_back(static_cast<double>((k * 7919) % 101));
    const auto [low, high] = std::minmax_element(cells.values.begin(), cells.values.end());
    const ValueTable nodes = smooth_to_lattice(cells, 4);
    ASSERT_EQ(nodes.columns, 25u);
    ASSERT_EQ(nodes.rows, 21u);
    for (std::size_t j = 0; j < 5; ++j)
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(nodes.at(4 * i + 2, 4 * j + 2), cells.at(i, j), 1e-12 * 101);
    for (const double v : nodes.values) {
        EXPECT_GE(v, *low);
        EXPECT_LE(v, *high);
    }
}

TEST(SmoothField, HasNoPreferredDirection) {
    ValueTable cells{4, 4, {1, 5, 2, 9, 3, 3, 8, 1, 0, 7, 7, 2, 6, 4, 1, 5}};
    ValueTable turned{4, 4, {}};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            turned.values.push_back(cells.at(i, j));
    const ValueTable a = smooth_to_lattice(cells, 6);
    const ValueTable b = smooth_to_lattice(turned, 6);
    for (std::size_t j = 0; j < a.rows; ++j)
        for (std::size_t i = 0; i < a.columns; ++i)
            EXPECT_NEAR(a.at(i, j), b.at(j, i), 1e-12);
}

} // namespace
} // namespace isolux
