#pragma once

#include <cstddef>
#include <span>

namespace isolux {

/// Systematic draws along a running sum: calls `take(i)` `draws` times, item i in proportion to
/// u[i] (METHODS "Shared cache", step 2). Items of weight 0 are never taken.
/// @param offset  the one random number, in [0, 1)
/// @return        sum of the weights; nothing is taken if it is 0
template <class Take>
double
draw_in_proportion(std::span<const double> u, std::size_t draws, double offset, Take&& take) {
    double total = 0.0;
    for (const double w : u)
        total += w;
    if (!(total > 0.0))
        return 0.0;
    const double step = total / static_cast<double>(draws);
    double running = 0.0;
    std::size_t last = 0;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < u.size() && taken < draws; ++i) {
        if (u[i] <= 0.0)
            continue;
        last = i;
        running += u[i];
        for (; taken < draws && (static_cast<double>(taken) + offset) * step < running; ++taken)
            take(i);
    }
    for (; taken < draws; ++taken) // rounding at the very end
        take(last);
    return total;
}

} // namespace isolux
