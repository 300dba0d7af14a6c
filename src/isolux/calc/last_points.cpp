#include "isolux/calc/last_points.h"

#include <algorithm>
#include <numeric>

namespace isolux {

double share_missing(const Advance& a) noexcept {
    constexpr double doubt = 1.3; // the error is itself an estimate
    constexpr double least = 0.25;
    return std::max(least, doubt * (a.excess - 1.0));
}

double units_missing(const Advance& a) noexcept {
    return static_cast<double>(a.units) * share_missing(a);
}

double growth_for(std::vector<double> units) {
    constexpr double to_be_sure = 2.0;
    if (units.empty())
        return 1.0;
    const auto most =
        units.begin() + static_cast<std::ptrdiff_t>((4 * units.size() + 4) / 5 - 1);
    std::nth_element(units.begin(), most, units.end());
    return std::max(1.0, to_be_sure * *most);
}

std::vector<std::size_t> choose_traced(std::span<const Finish> points, double paths_cost) {
    // Who needs most units leaves first: the paths are walked for the longest of those who
    // stay. Whoever is cheaper to trace anyway leaves with them.
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].units > points[b].units;
    });
    const auto stays = [](const Finish& p) { return p.units * p.unit_cost; };
    double rest = 0.0; // of all who are not forced to leave, each in its cheaper way
    for (const Finish& p : points)
        rest += std::min(stays(p), p.traced);
    std::vector<double> longest(points.size() + 1, 0.0); // units of those from k on who stay
    for (std::size_t k = points.size(); k-- > 0;) {
        const Finish& p = points[order[k]];
        longest[k] = stays(p) <= p.traced ? p.units : longest[k + 1];
    }
    double forced = 0.0;
    double least = 0.0;
    std::size_t leaving = 0;
    for (std::size_t k = 0; k <= order.size(); ++k) {
        const double cost = forced + rest + longest[k] * paths_cost;
        if (k == 0 || cost < least) {
            least = cost;
            leaving = k;
        }
        if (k < order.size()) {
            const Finish& p = points[order[k]];
            forced += p.traced;
            rest -= std::min(stays(p), p.traced);
        }
    }
    std::vector<std::size_t> traced(order.begin(),
                                    order.begin() + static_cast<std::ptrdiff_t>(leaving));
    for (std::size_t k = leaving; k < order.size(); ++k)
        if (points[order[k]].traced < stays(points[order[k]]))
            traced.push_back(order[k]);
    std::sort(traced.begin(), traced.end());
    return traced;
}

} // namespace isolux
