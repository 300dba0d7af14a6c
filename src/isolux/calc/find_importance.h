#pragma once

#include <span>

#include "isolux/base/receiver.h"
#include "isolux/transport/vertex_cache.h"

namespace isolux {

/// A point as the importance of light paths sees it.
struct ImportancePoint {
    const Receiver* receiver = nullptr;
    Point3 at;          ///< where its rays start
    double value = 0.0; ///< illuminance, about, or what it is held to if it is darker, lx
};

/// Where light paths should go, METHODS eq. (135), from the vertices of a pilot. Even where no
/// point is much darker than the others and than surfaces are in the mean.
[[nodiscard]] PathImportance find_importance(const Scene& scene,
                                             std::span<const VertexCache> caches,
                                             std::span<const ImportancePoint> points);

} // namespace isolux
