#pragma once

#include <cstdint>
#include <span>

#include "isolux/base/colour.h"

namespace isolux {

/// Where the light that reaches neighbouring points is written down, lx: as a whole, and, where
/// asked for, by the luminaires' sources. Refers to memory of its owner; adds, never clears.
struct LightLedger {
    std::span<Rgb> total; ///< by point
    /// For every luminaire the number of its source; empty: not told apart.
    std::span<const std::uint32_t> source_of;
    std::span<double> by_source; ///< Y-sum, [source][point]; empty: not told apart

    void add(std::size_t point, std::size_t luminaire, const Rgb& light) const noexcept {
        total[point] += light;
        if (!by_source.empty())
            by_source[source_of[luminaire] * total.size() + point] += luminance_sum(light);
    }
};

} // namespace isolux
