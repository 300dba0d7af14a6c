#pragma once

/// How often gather rays find a vertex near the surface they met, METHODS eq. (144).
namespace isolux {

/// C: vertices that a gather ray looks at before it takes one.
inline constexpr double most_preferred = 16.0;

/// Nearness at which a vertex is found as often as by an even draw.
inline constexpr double usual_nearness = 0.25;

/// h: so many times as many gather rays find a chain that went on from its vertex to a surface
/// as if they drew the vertex evenly. Both weights of METHODS eq. (10) count with it.
/// @param nearness  A cos cos/(pi d2) T: how dense the chain is at the surface if it goes on,
/// in shares of an even density. 0: the vertex was drawn evenly
[[nodiscard]] inline double preference(double nearness) noexcept {
    return nearness > 0.0
               ? most_preferred / (1.0 + (most_preferred - 1.0) * usual_nearness / nearness)
               : 1.0;
}

} // namespace isolux
