#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/measure/surface_grid.h"

namespace isolux {
namespace {

constexpr double pi = 3.14159265358979323846;

double spacing(double u, double v) { return in_metre(standard_spacing(Metre(u), Metre(v))); }

GridCounts counts(double u, double v, GridRounding rule) {
    return make_standard_grid(Metre(u), Metre(v), rule);
}

struct SpacingCase {
    double side;
    double p; ///< of the table printed with the rule, to its digits
    double digit;
};

TEST(StandardGrid, SpacingMatchesPublishedTable) {
    for (const SpacingCase& c : std::vector<SpacingCase>{{2.0, 0.325, 5e-4},
                                                         {5.0, 0.616, 5e-4},
                                                         {10.0, 1.0, 1e-12},
                                                         {50.0, 3.08, 5e-3},
                                                         {100.0, 5.0, 1e-12}}) {
        EXPECT_NEAR(spacing(c.side, c.side), c.p, c.digit) << c.side << " m";
        EXPECT_NEAR(spacing(0.6 * c.side, c.side), c.p, c.digit) << c.side << " m";
    }
}

TEST(StandardGrid, SpacingNeverExceedsTenMetres) {
    EXPECT_LT(spacing(269.0, 269.0), 10.0);
    EXPECT_EQ(spacing(270.0, 270.0), 10.0);
    EXPECT_EQ(spacing(3000.0, 2000.0), 10.0);
}

TEST(StandardGrid, ShorterSideDecidesFromRatioTwoOn) {
    EXPECT_DOUBLE_EQ(spacing(19.99, 10.0), 0.2 * std::pow(5.0, std::log10(19.99)));
    EXPECT_DOUBLE_EQ(spacing(20.0, 10.0), 1.0);
    EXPECT_DOUBLE_EQ(spacing(10.0, 20.0), 1.0);
    EXPECT_DOUBLE_EQ(spacing(10.0, 20.0 * (1.0 - 1e-14)), 1.0);
    EXPECT_DOUBLE_EQ(spacing(300.0, 10.0), 1.0);
}

TEST(StandardGrid, RoundingUpKeepsBothSpacingsAtOrBelowP) {
    // 5 m x 4 m: p = 0.6160, 5/p = 8.12, 4/p = 6.49.
    EXPECT_EQ(counts(5, 4, GridRounding::up).columns, 9U);
    EXPECT_EQ(counts(5, 4, GridRounding::up).rows, 7U);
    EXPECT_EQ(counts(4, 5, GridRounding::up).columns, 7U);
    EXPECT_EQ(counts(10, 10, GridRounding::up).columns, 10U);
    EXPECT_EQ(counts(30, 2, GridRounding::up).columns, 93U);
    EXPECT_EQ(counts(30, 2, GridRounding::up).rows, 7U);
}

TEST(StandardGrid, RoundingErrorOfTheSideAddsNoPoint) {
    EXPECT_EQ(counts(10.000000000000002, 8.000000000000002, GridRounding::up).columns, 10U);
    EXPECT_EQ(counts(10.000000000000002, 8.000000000000002, GridRounding::up).rows, 8U);
    EXPECT_EQ(counts(10.001, 8.0, GridRounding::up).columns, 11U);
    EXPECT_EQ(counts(10.0, 8.001, GridRounding::up).rows, 9U);
}

TEST(StandardGrid, NearestRoundingDividesTheOtherSideByTheSpacingFound) {
    // 5 m x 4 m: 8.12 -> 8 points, spacing 0.625; 4/0.625 = 6.4 -> 6 points.
    EXPECT_EQ(counts(5, 4, GridRounding::nearest).columns, 8U);
    EXPECT_EQ(counts(5, 4, GridRounding::nearest).rows, 6U);
    // 2.2 m x 1.2 m: p = 0.3473; 6.34 -> 6 points, spacing 0.3667; 1.2/0.3667 = 3.27 -> 3
    // points, where 1.2/p = 3.46.
    EXPECT_EQ(counts(1.2, 2.2, GridRounding::nearest).rows, 6U);
    EXPECT_EQ(counts(1.2, 2.2, GridRounding::nearest).columns, 3U);
    // 30 m x 2 m: the short side leads; 6.15 -> 6 points, spacing 1/3; 90 points along.
    EXPECT_EQ(counts(30, 2, GridRounding::nearest).columns, 90U);
    EXPECT_EQ(counts(30, 2, GridRounding::nearest).rows, 6U);
}

TEST(StandardGrid, OddRoundingPutsAPointInTheMiddle) {
    EXPECT_EQ(counts(5, 4, GridRounding::odd).columns, 9U);
    EXPECT_EQ(counts(5, 4, GridRounding::odd).rows, 7U);
    EXPECT_EQ(counts(10, 10, GridRounding::odd).columns, 11U);
}

TEST(StandardGrid, CellsAreNeverTwiceAsLongAsWide) {
    for (double u = 0.1; u < 400.0; u *= 1.137)
        for (double v = 0.1; v < 400.0; v *= 1.171)
            for (const GridRounding rule :
                 {GridRounding::up, GridRounding::nearest, GridRounding::odd}) {
                const GridCounts n = counts(u, v, rule);
                const double dx = u / static_cast<double>(n.columns);
                const double dy = v / static_cast<double>(n.rows);
                EXPECT_LE(std::max(dx / dy, dy / dx), 2.0) << u << " x " << v;
                if (rule != GridRounding::nearest) {
                    EXPECT_LE(std::max(dx, dy), spacing(u, v) * (1 + 1e-8)) << u << " x " << v;
                }
            }
}

const UnitVector3 east = UnitVector3::from_unit({1, 0, 0});

TEST(GridSurface, PutsPointsAtCellCentresColumnsFirst) {
    const Frame corner{{1, 2, 0.75}};
    const CalculationSurface s = make_grid_surface(
        "desk", corner, Metre(3.0), Metre(1.0), {3, 2}, {}, IlluminanceKind::planar, east);
    ASSERT_EQ(s.receivers.size(), 6U);
    EXPECT_EQ(s.name, "desk");
    EXPECT_EQ(s.receivers[0].point, (Point3{1.5, 2.25, 0.75}));
    EXPECT_EQ(s.receivers[1].point, (Point3{2.5, 2.25, 0.75}));
    EXPECT_EQ(s.receivers[5].point, (Point3{3.5, 2.75, 0.75}));
    ASSERT_TRUE(s.grid.has_value());
    EXPECT_EQ(s.grid->counts.columns, 3U);
    EXPECT_EQ(s.grid->counts.rows, 2U);
    EXPECT_EQ(s.grid->cell_of_point, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
    for (const Receiver& r : s.receivers)
        EXPECT_EQ(r.axis, UnitVector3{});
}

/// A wall: x runs along +y, "up the surface" is +z, the normal points to +x.
Frame wall_frame() {
    return {{4, 0, 0},
            UnitVector3::from_unit({0, 1, 0}),
            UnitVector3::from_unit({0, 0, 1}),
            UnitVector3::from_unit({1, 0, 0})};
}

TEST(GridSurface, FollowsTheFrameOfASlopedSurface) {
    const CalculationSurface s = make_grid_surface(
        "wall", wall_frame(), Metre(2), Metre(4), {1, 2}, {}, IlluminanceKind::planar, east);
    ASSERT_EQ(s.receivers.size(), 2U);
    EXPECT_EQ(s.receivers[0].point, (Point3{4, 1, 1}));
    EXPECT_EQ(s.receivers[1].point, (Point3{4, 1, 3}));
    EXPECT_EQ(s.receivers[0].axis, east);
}

TEST(GridSurface, CylindersStandUprightOnAnySurface) {
    const UnitVector3 up = UnitVector3::from_unit({0, 0, 1});
    const UnitVector3 south = UnitVector3::from_unit({0, -1, 0});
    const auto axis = [&](IlluminanceKind kind) {
        const CalculationSurface s =
            make_grid_surface("s", wall_frame(), Metre(1), Metre(1), {1, 1}, {}, kind, south);
        EXPECT_EQ(s.receivers.at(0).kind, kind);
        EXPECT_EQ(s.receivers.at(0).reference, south);
        return s.receivers.at(0).axis;
    };
    EXPECT_EQ(axis(IlluminanceKind::cylindrical), up);
    EXPECT_EQ(axis(IlluminanceKind::semi_cylindrical), up);
    EXPECT_EQ(axis(IlluminanceKind::hemispherical), east);
    EXPECT_EQ(axis(IlluminanceKind::planar), east);
}

TEST(GridSurface, LeavesOutWhatLiesOutsideAnLShape) {
    // 4 x 4 cells of 1 m; the L lacks the upper right 2 m x 2 m.
    const std::vector<Point3> l{
        {0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}};
    const CalculationSurface s = make_grid_surface(
        "L", {}, Metre(4), Metre(4), {4, 4}, l, IlluminanceKind::planar, east);
    EXPECT_EQ(s.grid->cell_of_point,
              (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13}));
    EXPECT_EQ(s.receivers.size(), 12U);
    EXPECT_EQ(s.receivers.back().point, (Point3{1.5, 3.5, 0}));
    EXPECT_EQ(s.outline, l);
}

TEST(GridSurface, CountsPointsOnTheOutlineAsInside) {
    // The diagonal of the square runs through cell centres; an edge runs through y = 0.5.
    const std::vector<Point3> triangle{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}};
    const CalculationSurface s = make_grid_surface(
        "half", {}, Metre(4), Metre(4), {4, 4}, triangle, IlluminanceKind::planar, east);
    EXPECT_EQ(s.receivers.size(), 10U);
    const std::vector<Point3> band{{0, 0.5, 0}, {4, 0.5, 0}, {4, 1, 0}, {0, 1, 0}};
    const CalculationSurface b = make_grid_surface(
        "band", {}, Metre(4), Metre(4), {4, 4}, band, IlluminanceKind::planar, east);
    EXPECT_EQ(b.receivers.size(), 4U);
}

TEST(GridSurface, AreaOfThePointsConvergesToTheAreaOfTheOutline) {
    // A regular 40-gon of radius 1, at a place far from the origin and turned in its plane.
    Frame corner{{1000, -2000, 3}};
    corner = rotate(corner, UnitVector3::from_unit({0, 0, 1}), degrees(20));
    std::vector<Point3> polygon;
    for (int i = 0; i < 40; ++i) {
        const double a = 2.0 * pi * i / 40.0;
        polygon.push_back(corner.point_from_local({1.0 + std::cos(a), 1.0 + std::sin(a), 0.0}));
    }
    const CalculationSurface s = make_grid_surface(
        "disc", corner, Metre(2), Metre(2), {200, 200}, polygon, IlluminanceKind::planar, east);
    const double area = 0.5 * 40.0 * std::sin(2.0 * pi / 40.0);
    // Lattice points in a convex body: the error is at most the cells the border crosses.
    EXPECT_NEAR(static_cast<double>(s.receivers.size()) * 1e-4, area, 2.0 * pi * 0.01);
}

} // namespace
} // namespace isolux
