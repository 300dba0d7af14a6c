#include "isolux/measure/grid_statistics.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "isolux/base/check.h"

namespace isolux {

namespace {

constexpr std::size_t fewest_to_split = 4; ///< two replicates in each half

double count_of(std::size_t n) noexcept { return static_cast<double>(n); }

double mean_of(std::span<const double> values) noexcept {
    double sum = 0.0;
    for (const double v : values)
        sum += v;
    return values.empty() ? 0.0 : sum / count_of(values.size());
}

double ratio(double numerator, double denominator) noexcept {
    return denominator != 0.0 ? numerator / denominator : 0.0;
}

double smallest(std::span<const double> values) noexcept {
    return *std::ranges::min_element(values);
}

double largest(std::span<const double> values) noexcept {
    return *std::ranges::max_element(values);
}

/// Sum over the replicates first, first + stride, ... for every point.
std::vector<double>
sum_rows(const ReplicateTable& table, std::size_t first, std::size_t stride) {
    std::vector<double> sums(table.points, 0.0);
    for (std::size_t r = first; r < table.replicates; r += stride) {
        const std::span<const double> row = table.row(r);
        for (std::size_t p = 0; p < table.points; ++p)
            sums[p] += row[p];
    }
    return sums;
}

std::vector<double> point_means(const ReplicateTable& table) {
    std::vector<double> means = sum_rows(table, 0, 1);
    for (double& m : means)
        m /= count_of(table.replicates);
    return means;
}

/// Value and error from T of all and T_(-r) of all but one.
Estimate combine_jackknife(double all, std::span<const double> without) noexcept {
    const double n = count_of(without.size());
    const double centre = mean_of(without);
    double squares = 0.0;
    for (const double t : without)
        squares += (t - centre) * (t - centre);
    return {n * all - (n - 1.0) * centre, std::sqrt((n - 1.0) / n * squares), without.size()};
}

/// Ratio of two replicate means with the delete-one jackknife.
Estimate estimate_ratio(std::span<const double> numerator,
                        std::span<const double> denominator) {
    double n = 0.0;
    double d = 0.0;
    for (std::size_t r = 0; r < numerator.size(); ++r) {
        n += numerator[r];
        d += denominator[r];
    }
    std::vector<double> without;
    for (std::size_t r = 0; r < numerator.size(); ++r)
        without.push_back(ratio(n - numerator[r], d - denominator[r]));
    return combine_jackknife(ratio(n, d), without);
}

/// What one half of the replicates says about the points the other half chose.
struct HalfSummary {
    std::size_t replicates = 0;
    Estimate minimum;
    Estimate maximum;
    Estimate uniformity;
    Estimate diversity;
};

HalfSummary summarise_half(const ReplicateTable& table, std::size_t parity) {
    const std::vector<double> others = sum_rows(table, 1 - parity, 2);
    const auto low =
        static_cast<std::size_t>(std::ranges::min_element(others) - others.begin());
    const auto high =
        static_cast<std::size_t>(std::ranges::max_element(others) - others.begin());
    std::vector<double> minimum;
    std::vector<double> maximum;
    std::vector<double> mean;
    for (std::size_t r = parity; r < table.replicates; r += 2) {
        const std::span<const double> row = table.row(r);
        minimum.push_back(row[low]);
        maximum.push_back(row[high]);
        mean.push_back(mean_of(row));
    }
    return {minimum.size(),
            estimate_from_replicates(minimum),
            estimate_from_replicates(maximum),
            estimate_ratio(minimum, mean),
            estimate_ratio(minimum, maximum)};
}

/// The two halves are independent of each other but for the choice of the points.
Estimate
average_halves(const HalfSummary& a, const HalfSummary& b, Estimate HalfSummary::*what) {
    const std::size_t all = a.replicates + b.replicates;
    const double wa = count_of(a.replicates) / count_of(all);
    const double wb = count_of(b.replicates) / count_of(all);
    return {wa * (a.*what).mean + wb * (b.*what).mean,
            std::hypot(wa * (a.*what).standard_error, wb * (b.*what).standard_error),
            all};
}

/// The value of (40) may be high and that of all replicates is low, since each knows which of
/// several like points is the extreme one to its own noise only: what they differ by counts as
/// an error beside the others, METHODS eq. (123).
Estimate widen(Estimate split, double plug_in) noexcept {
    split.standard_error = std::hypot(split.standard_error, split.mean - plug_in);
    return split;
}

/// Too few replicates to split: plug-in values.
SurfaceSummary summarise_few(const ReplicateTable& table) {
    using Means = std::span<const double>;
    const auto plug_in = [&](const auto& functional) {
        Estimate e = jackknife(table, functional);
        e.mean = functional(point_means(table));
        return e;
    };
    SurfaceSummary s;
    s.minimum = plug_in(smallest);
    s.maximum = plug_in(largest);
    s.uniformity = plug_in([](Means m) { return ratio(smallest(m), mean_of(m)); });
    s.diversity = plug_in([](Means m) { return ratio(smallest(m), largest(m)); });
    return s;
}

} // namespace

Estimate jackknife(const ReplicateTable& table,
                   const std::function<double(std::span<const double>)>& functional) {
    ISOLUX_EXPECT(table.values.size() == table.replicates * table.points);
    if (table.replicates == 0)
        return {};
    if (table.replicates == 1)
        return {functional(table.row(0)), 0.0, 1};
    const std::vector<double> sums = sum_rows(table, 0, 1);
    std::vector<double> means(table.points);
    std::vector<double> without;
    for (std::size_t r = 0; r < table.replicates; ++r) {
        const std::span<const double> row = table.row(r);
        for (std::size_t p = 0; p < table.points; ++p)
            means[p] = (sums[p] - row[p]) / count_of(table.replicates - 1);
        without.push_back(functional(means));
    }
    return combine_jackknife(functional(point_means(table)), without);
}

SurfaceSummary summarise(const ReplicateTable& table) {
    ISOLUX_EXPECT(table.values.size() == table.replicates * table.points);
    if (table.replicates == 0 || table.points == 0)
        return {};
    const std::vector<double> means = point_means(table);
    SurfaceSummary s =
        table.replicates < fewest_to_split ? summarise_few(table) : SurfaceSummary{};
    s.plug_in_minimum = smallest(means);
    s.plug_in_maximum = largest(means);
    if (table.replicates >= fewest_to_split) {
        const HalfSummary a = summarise_half(table, 0);
        const HalfSummary b = summarise_half(table, 1);
        s.minimum = widen(average_halves(a, b, &HalfSummary::minimum), s.plug_in_minimum);
        s.maximum = widen(average_halves(a, b, &HalfSummary::maximum), s.plug_in_maximum);
        s.uniformity = widen(average_halves(a, b, &HalfSummary::uniformity),
                             ratio(s.plug_in_minimum, mean_of(means)));
        s.diversity = widen(average_halves(a, b, &HalfSummary::diversity),
                            ratio(s.plug_in_minimum, s.plug_in_maximum));
    }
    std::vector<double> replicate_means;
    for (std::size_t r = 0; r < table.replicates; ++r)
        replicate_means.push_back(mean_of(table.row(r)));
    s.mean = estimate_from_replicates(replicate_means);
    return s;
}

} // namespace isolux
