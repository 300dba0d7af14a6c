#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/calculate.h"

#include "support/test_scene.h"

/// Do the errors stated for a surface's Em, Emin, Emax, U0 and Ud match the spread of whole,
/// independent calculations? The points share light paths, so their errors are correlated:
/// nothing but replicates can tell (METHODS "Grid statistics").
namespace isolux {
namespace {

constexpr std::size_t runs = 100;

/// A room lit from one end: the minimum lies in the far corners' neighbourhood and is distinct.
Scene make_room() {
    test::Builder b;
    const MaterialId floor = b.add_diffuse(0.2);
    const MaterialId ceiling = b.add_diffuse(0.7);
    const MaterialId walls = b.add_diffuse(0.5);
    b.add_room({0, 0, 0}, {4, 6, 3}, floor, ceiling, walls);
    b.add_point({1.2, 1.5, 2.4}, b.add_isotropic_type(3000.0));
    return b.build();
}

CalculationSurface make_work_plane() {
    return make_grid_surface("work plane",
                             Frame{{0.5, 0.5, 0.75}},
                             Metre(3.0),
                             Metre(5.0),
                             {8, 11},
                             {},
                             IlluminanceKind::planar,
                             {});
}

/// What all runs together say about one quantity.
struct Comparison {
    std::vector<double> values;
    double stated_squared = 0.0;

    void add(const Estimate& e) {
        values.push_back(e.mean);
        stated_squared += e.standard_error * e.standard_error;
    }

    /// Stated error over observed spread.
    [[nodiscard]] double ratio() const {
        const double n = static_cast<double>(values.size());
        const double spread = estimate_from_replicates(values).standard_error * std::sqrt(n);
        return std::sqrt(stated_squared / n) / spread;
    }
};

/// The spread of 100 runs is known to 1/sqrt(2*99) = 7 %: the limits are three of that away;
/// the seeds are fixed.
TEST(GridError, StatedErrorsOfTheSummaryMatchTheSpreadOfWholeRuns) {
    const Scene scene = make_room();
    const CalculationSurface plane = make_work_plane();
    Comparison mean;
    Comparison minimum;
    Comparison maximum;
    Comparison uniformity;
    Comparison diversity;
    for (std::size_t i = 0; i < runs; ++i) {
        Settings settings;
        settings.seed = 1000 + i;
        settings.tolerance = 0.5; // one unit of work
        const Results r = calculate(scene, {&plane, 1}, settings);
        const SurfaceSummary& s = r.surfaces.at(0).summary;
        mean.add(s.mean);
        minimum.add(s.minimum);
        maximum.add(s.maximum);
        uniformity.add(s.uniformity);
        diversity.add(s.diversity);
    }
    for (const Comparison* c : {&mean, &minimum, &maximum, &uniformity, &diversity}) {
        EXPECT_GT(c->ratio(), 0.8);
        EXPECT_LT(c->ratio(), 1.25);
    }
}

} // namespace
} // namespace isolux
