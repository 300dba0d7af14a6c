#include <cmath>

#include <gtest/gtest.h>

#include "isolux/report/budget.h"
#include "isolux/report/numbers.h"

#include "support/sample_results.h"

namespace isolux::report {
namespace {

TEST(Digits, ShowFourThatCountAndNoExponent) {
    EXPECT_EQ(to_digits(512.345), "512.3");
    EXPECT_EQ(to_digits(12345.6), "12346");
    EXPECT_EQ(to_digits(0.0012345), "0.001234");
    EXPECT_EQ(to_digits(1.0), "1.000");
    EXPECT_EQ(to_digits(0.0), "0");
    EXPECT_EQ(to_digits(-3.25), "-3.250");
}

TEST(Percent, ShowsTwoDigits) {
    EXPECT_EQ(to_percent(0.05), "5.0 %");
    EXPECT_EQ(to_percent(0.95), "95 %");
    EXPECT_EQ(to_percent(0.00123), "0.12 %");
    EXPECT_EQ(to_percent(0.0), "0 %");
}

TEST(EstimateCell, ShowsAsManyDecimalsAsItsDoubtAllows) {
    const Cell cell = estimate_cell({512.345, 1.0, 1000000}, 0.95);
    EXPECT_EQ(cell.text, "512.3 ± 2.0");
    EXPECT_EQ(cell.exact, 512.345);
    EXPECT_EQ(estimate_cell({512.345, 0.0, 1}, 0.95).text, "512.3");
}

TEST(Budget, AddsSquaresAndWeighsReflectancesByReflectedLight) {
    SurfaceResult s;
    s.summary.mean = {100.0, 1.0, 1000000};
    s.points.resize(2);
    s.points[0].total.mean = 120.0;
    s.points[0].indirect.mean = 20.0;
    s.points[1].total.mean = 80.0;
    s.points[1].indirect.mean = 30.0;
    const Budget b = make_budget(s, 0.95, {0.03, 0.04, 0.2, 0.12});
    EXPECT_NEAR(b.monte_carlo, 0.0196, 1e-4);
    EXPECT_DOUBLE_EQ(b.reflectance, 0.2 * 0.25);
    EXPECT_NEAR(b.combined,
                std::sqrt(b.monte_carlo * b.monte_carlo + 9e-4 + 16e-4 + 25e-4 + 144e-4),
                1e-12);
    EXPECT_NEAR(b.share(b.monte_carlo) + b.share(b.photometry) + b.share(b.flux)
                    + b.share(b.reflectance) + b.share(b.maintenance),
                1.0,
                1e-12);
}

TEST(Budget, OfADarkSurfaceIsEmpty) {
    EXPECT_EQ(make_budget({}, 0.95, {}).combined, 0.0);
    EXPECT_EQ(Budget{}.share(0.0), 0.0);
}

} // namespace
} // namespace isolux::report
