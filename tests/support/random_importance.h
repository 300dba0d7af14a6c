#pragma once

#include <cmath>
#include <vector>

#include "isolux/sampling/random_stream.h"
#include "isolux/scene/scene.h"
#include "isolux/transport/path_importance.h"

namespace isolux::test {

/// Factors between 1 and 40 without any sense.
inline PathImportance random_importance(const Scene& scene, std::uint64_t seed) {
    const RandomStream random(seed, StreamPurpose::test, 0);
    std::vector<float> factors(CellOrder::keys);
    for (std::size_t k = 0; k < factors.size(); ++k)
        factors[k] = static_cast<float>(std::pow(40.0, random.uniform(k, 0)));
    return {scene.bounds, std::move(factors)};
}

} // namespace isolux::test
