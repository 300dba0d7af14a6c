#include "isolux/viz/smooth_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "isolux/base/check.h"

namespace isolux {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Slope at a value between the secants on its two sides, after Steffen, for equal steps.
double inner_slope(double before, double after) noexcept {
    if (before * after <= 0.0)
        return 0.0;
    const double size =
        std::min({std::abs(before), std::abs(after), 0.25 * std::abs(before + after)});
    return std::copysign(2.0 * size, before);
}

/// Slope at the end of a run from the parabola through its last three values, after Steffen.
double end_slope(double secant, double next_secant) noexcept {
    const double slope = 1.5 * secant - 0.5 * next_secant;
    if (slope * secant <= 0.0)
        return 0.0;
    return std::abs(slope) > 2.0 * std::abs(secant) ? 2.0 * secant : slope;
}

std::vector<double> slopes_of(std::span<const double> run) {
    const std::size_t n = run.size();
    std::vector<double> slope(n, 0.0);
    if (n < 2)
        return slope;
    const auto secant = [&](std::size_t k) { return run[k + 1] - run[k]; };
    for (std::size_t k = 1; k + 1 < n; ++k)
        slope[k] = inner_slope(secant(k - 1), secant(k));
    slope[0] = n == 2 ? secant(0) : end_slope(secant(0), secant(1));
    slope[n - 1] = n == 2 ? secant(0) : end_slope(secant(n - 2), secant(n - 3));
    return slope;
}

/// Value at `x`, counted in cells from the left border of the run's first cell.
double evaluate(std::span<const double> run, std::span<const double> slope, double x) noexcept {
    const double at = x - 0.5;
    if (at <= 0.0)
        return run.front() + at * slope.front();
    const auto last = static_cast<double>(run.size() - 1);
    if (at >= last)
        return run.back() + (at - last) * slope.back();
    const auto k = static_cast<std::size_t>(at);
    const double t = at - static_cast<double>(k);
    const double secant = run[k + 1] - run[k];
    const double a = slope[k] + slope[k + 1] - 2.0 * secant;
    const double b = 3.0 * secant - 2.0 * slope[k] - slope[k + 1];
    return run[k] + t * (slope[k] + t * (b + t * a));
}

/// Stretches every row to nodes; runs of values between gaps are treated one by one.
ValueTable stretch_rows(const ValueTable& cells, std::size_t steps) {
    ValueTable nodes{cells.columns * steps + 1, cells.rows, {}};
    nodes.values.assign(nodes.columns * nodes.rows, nothing);
    for (std::size_t row = 0; row < cells.rows; ++row) {
        const std::span all(cells.values.data() + row * cells.columns, cells.columns);
        for (std::size_t first = 0; first < cells.columns;) {
            std::size_t end = first;
            while (end < cells.columns && !std::isnan(all[end]))
                ++end;
            if (end == first) {
                ++first;
                continue;
            }
            const std::span run = all.subspan(first, end - first);
            const std::vector<double> slope = slopes_of(run);
            for (std::size_t i = 0; i <= run.size() * steps; ++i)
                nodes.values[row * nodes.columns + first * steps + i] =
                    evaluate(run, slope, static_cast<double>(i) / static_cast<double>(steps));
            first = end;
        }
    }
    return nodes;
}

ValueTable transpose(const ValueTable& t) {
    ValueTable r{t.rows, t.columns, {}};
    r.values.reserve(t.values.size());
    for (std::size_t column = 0; column < t.columns; ++column)
        for (std::size_t row = 0; row < t.rows; ++row)
            r.values.push_back(t.at(column, row));
    return r;
}

} // namespace

ValueTable smooth_to_lattice(const ValueTable& cells, std::size_t steps) {
    ISOLUX_EXPECT(steps >= 2 && steps % 2 == 0);
    double lowest = HUGE_VAL;
    double highest = -HUGE_VAL;
    for (const double v : cells.values)
        if (!std::isnan(v)) {
            lowest = std::min(lowest, v);
            highest = std::max(highest, v);
        }
    // Rows first and columns first differ a little (the slopes are not linear in the values):
    // the mean of both has no preferred direction.
    ValueTable nodes = transpose(stretch_rows(transpose(stretch_rows(cells, steps)), steps));
    const ValueTable other =
        stretch_rows(transpose(stretch_rows(transpose(cells), steps)), steps);
    for (std::size_t k = 0; k < nodes.values.size(); ++k)
        nodes.values[k] =
            std::clamp(0.5 * (nodes.values[k] + other.values[k]), lowest, highest);
    return nodes;
}

} // namespace isolux
