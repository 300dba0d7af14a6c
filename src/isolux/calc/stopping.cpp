#include "isolux/calc/stopping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isolux {

StoppingRule::StoppingRule(double tolerance, double confidence, std::size_t values)
    : tolerance_(tolerance),
      miscoverage_((1.0 - confidence) / static_cast<double>(std::max<std::size_t>(1, values))) {
}

double StoppingRule::factor(std::size_t check, std::size_t replicates) const {
    constexpr double pi = std::numbers::pi;
    const double j = static_cast<double>(check) + 1.0;
    const double spent = miscoverage_ * 6.0 / (pi * pi * j * j);
    return student_quantile(1.0 - spent, static_cast<double>(replicates - 1));
}

bool StoppingRule::is_met(const Estimate& e, std::size_t check, double floor) const {
    if (e.samples < 2 || e.standard_error == 0.0)
        return true;
    const double half = factor(check, e.samples) * e.standard_error;
    return half <= tolerance_ * std::max(std::abs(e.mean), floor);
}

} // namespace isolux
