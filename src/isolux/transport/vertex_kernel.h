#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "isolux/base/receiver.h"

namespace isolux {

/// How the local estimate shares paths with the gather rays.
enum class Weighting {
    alone,    ///< plain local estimation: every vertex counts in full, METHODS eq. (6)
    balanced, ///< balance heuristic against gather rays, METHODS eq. (10)
};

/// Up to 256 vertices as the vectorised kernel reads them: rows of 16, of which only the first
/// `rows` are filled; an empty place has no strength. Positions are relative to the centre of
/// the cache.
struct alignas(64) VertexBlock {
    static constexpr std::size_t columns = 16;
    static constexpr std::size_t most_rows = 16;
    static constexpr std::size_t size = columns * most_rows;
    using Values = std::array<float, size>;

    Values x{}, y{}, z{};    ///< m
    Values nx{}, ny{}, nz{}; ///< normal of the lit side
    Values strength{};       ///< alpha rho / pi, the Y-sum, lm/sr
    Values rival{};          ///< n2 h/(pi n1 p1) of one gather ray, m2: METHODS eq. (60)

    std::array<float, 3> lower{}; ///< box of the positions
    std::array<float, 3> upper{};
    std::array<float, 3> common_normal{}; ///< 0 where the normals differ
    std::uint32_t rows = 0;
};

/// A receiver as the kernel sees it, relative to the centre of the cache.
struct KernelReceiver {
    std::array<float, 3> at{};
    std::array<float, 3> axis{};
    std::array<float, 3> across{}; ///< semi-cylindrical: unit vector towards the reference
    float rays = 1.0F;             ///< gather rays that the estimate shares its paths with
};

/// Unshadowed local estimate of every vertex at every receiver times its weight, METHODS eq.
/// (60): lm/m2 before division by the number of paths. No rays.
///
/// The instruction set is chosen when the program runs: SSE4.2, AVX2 or AVX-512. The last two
/// give the same bits; SSE4.2 has no fused multiplication and may differ in the last ones.
/// @param kind         of all receivers
/// @param u            [receiver][block][row][column]; left as it was where a column's sum is 0
/// @param column_sums  [receiver][block][column]: over the rows, in order
void weigh_vertices(std::span<const VertexBlock> blocks,
                    IlluminanceKind kind,
                    Weighting weighting,
                    std::span<const KernelReceiver> receivers,
                    std::span<float> u,
                    std::span<float> column_sums) noexcept;

/// The instruction set that weigh_vertices uses on this machine.
[[nodiscard]] const char* vertex_kernel_instructions() noexcept;

} // namespace isolux
