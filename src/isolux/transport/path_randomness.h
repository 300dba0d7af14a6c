#pragma once

#include <array>
#include <cstdint>

#include "isolux/sampling/random_stream.h"
#include "isolux/sampling/sobol.h"

namespace isolux {

/// Which draw feeds what on a light path; a new draw takes a new number and moves no old one.
/// Bounce b = 0, 1, 2, ... uses three draws from `first_bounce + 3 b`.
struct PathDimension {
    static constexpr std::uint32_t luminaire = 0;
    static constexpr std::uint32_t place = 1;     ///< and 2
    static constexpr std::uint32_t direction = 3; ///< and 4
    static constexpr std::uint32_t first_bounce = 5;
    static constexpr std::uint32_t event = 0;   ///< within a bounce: roulette and lobe
    static constexpr std::uint32_t scatter = 1; ///< and 2: direction
};

/// The numbers of one replicate's light paths: Owen-scrambled Sobol' points in the first
/// dimensions, counter-based numbers beyond (METHODS "Random numbers").
class PathRandomness {
public:
    PathRandomness(std::uint64_t seed, std::uint32_t replicate)
        : tail_(seed, StreamPurpose::light_path, replicate) {
        for (std::uint32_t d = 0; d < sobol_dimensions; ++d)
            scramble_[d] = make_scramble(seed, replicate, d);
    }

    [[nodiscard]] double operator()(std::uint64_t path,
                                    std::uint32_t dimension) const noexcept {
        if (dimension < sobol_dimensions && path <= 0xffffffffULL)
            return sobol_owen(
                static_cast<std::uint32_t>(path), dimension, scramble_[dimension]);
        return tail_.uniform(path, dimension);
    }

private:
    std::array<std::uint32_t, sobol_dimensions> scramble_{};
    RandomStream tail_;
};

} // namespace isolux
