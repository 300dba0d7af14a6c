#include "isolux/validate/form_factor.h"

#include <cmath>
#include <numbers>

#include "isolux/base/check.h"

// Both by J. R. Howell, A Catalog of Radiation Heat Transfer Configuration Factors, C-11 and
// C-14.
namespace isolux {

using std::numbers::pi;

double parallel_form_factor(double a, double b, double c) noexcept {
    ISOLUX_EXPECT(a > 0.0 && b > 0.0 && c > 0.0);
    const double x = a / c;
    const double y = b / c;
    const double p = std::hypot(1.0, x);
    const double q = std::hypot(1.0, y);
    return 2.0 / (pi * x * y)
           * (std::log(p * q / std::sqrt(1.0 + x * x + y * y)) + x * q * std::atan(x / q)
              + y * p * std::atan(y / p) - x * std::atan(x) - y * std::atan(y));
}

double perpendicular_form_factor(double edge, double depth, double height) noexcept {
    ISOLUX_EXPECT(edge > 0.0 && depth > 0.0 && height > 0.0);
    const double h2 = (height / edge) * (height / edge);
    const double w2 = (depth / edge) * (depth / edge);
    const double h = std::sqrt(h2);
    const double w = std::sqrt(w2);
    const double s = std::sqrt(h2 + w2);
    const double all = 1.0 + h2 + w2;
    const double logarithm = std::log((1.0 + w2) * (1.0 + h2) / all)
                             + w2 * std::log(w2 * all / ((1.0 + w2) * (h2 + w2)))
                             + h2 * std::log(h2 * all / ((1.0 + h2) * (h2 + w2)));
    return (w * std::atan(1.0 / w) + h * std::atan(1.0 / h) - s * std::atan(1.0 / s)
            + 0.25 * logarithm)
           / (pi * w);
}

} // namespace isolux
