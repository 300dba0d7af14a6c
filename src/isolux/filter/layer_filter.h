#pragma once

#include "isolux/filter/filter_settings.h"
#include "isolux/filter/gaussian_filter.h"

namespace isolux {

/// A quantity of two halves, filtered and verified.
struct FilteredLayer {
    Plane mean;   ///< of both halves, with the chosen widths
    Halves fixed; ///< with the rule's width
    Plane scale;  ///< chosen factor of the width, a pixel; 0: nothing filtered
};

[[nodiscard]] FilteredLayer filter_layer(const FilterSites& sites,
                                         const Halves& raw,
                                         const FilterSettings& settings,
                                         bool indirect);

/// Reflected light: the widths are chosen by luminance and used for all
/// channels.
struct FilteredIndirect {
    Planes3 colour; ///< lx by channel
    Halves raw;     ///< lx, luminance_sum of the channels
    Halves fixed;   ///< of these, with the rule's width
    Plane scale;
};

[[nodiscard]] FilteredIndirect filter_indirect(const FilterSites& sites,
                                               const IndirectLayer& indirect,
                                               const FilterSettings& settings);

} // namespace isolux
