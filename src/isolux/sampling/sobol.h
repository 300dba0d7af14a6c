#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace isolux {

/// Sobol' dimensions served; beyond them use a RandomStream (METHODS "Random numbers").
inline constexpr std::uint32_t sobol_dimensions = 20;

/// Draw `dimension` of point `index` of the plain Sobol' sequence, in [0, 1). For tests:
/// without a scramble there is neither an unbiased estimate nor an error.
/// @pre dimension < sobol_dimensions
[[nodiscard]] double sobol(std::uint32_t index, std::uint32_t dimension) noexcept;

/// Draw `dimension` of point `index` of the Sobol' sequence (Joe and Kuo direction numbers),
/// Owen-scrambled by the hash form with `scramble`. Uniform in [0, 1), 32 bits.
/// Blocks of 2^m points at multiples of 2^m are (t, m, s)-nets.
/// @pre dimension < sobol_dimensions
[[nodiscard]] double
sobol_owen(std::uint32_t index, std::uint32_t dimension, std::uint32_t scramble) noexcept;

/// What a scramble comes to: METHODS eq. (44), s and f.
struct SobolScramble {
    std::uint32_t shift = 0;
    std::uint32_t factor = 1; ///< odd
};

[[nodiscard]] SobolScramble prepare_scramble(std::uint32_t scramble) noexcept;

/// The same for a scramble that is prepared once for many draws.
[[nodiscard]] double
sobol_owen(std::uint32_t index, std::uint32_t dimension, SobolScramble scramble) noexcept;

/// A scramble seed for one dimension of one replicate.
[[nodiscard]] std::uint32_t
make_scramble(std::uint64_t seed, std::uint32_t replicate, std::uint32_t dimension) noexcept;

/// All dimensions of one replicate's sequence: whole points for little more than a single draw.
class ScrambledSobol {
public:
    ScrambledSobol(std::uint64_t seed, std::uint32_t replicate) noexcept;

    /// Some more than there are, for even vectors.
    using Words = std::array<std::uint32_t, (sobol_dimensions + 7) / 8 * 8>;

    /// Point `index`: 2^-32 times word d equals sobol_owen(index, d, make_scramble(seed,
    /// replicate, d)).
    [[nodiscard]] Words words(std::uint32_t index) const noexcept;

private:
    Words shift_{};
    Words factor_{};
};

} // namespace isolux
