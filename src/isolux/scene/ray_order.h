#pragma once

#include <cstdint>

namespace isolux {

/// How the rays of a packet lie to each other. It changes how fast they are and, up to
/// rounding, nothing else.
enum class RayOrder : std::uint8_t {
    bundled,   ///< side by side all the way: from one place to one luminaire, say
    scattered, ///< to or from anywhere
};

} // namespace isolux
