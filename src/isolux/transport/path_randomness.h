#pragma once

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
        : sobol_(seed, replicate), tail_(seed, StreamPurpose::light_path, replicate) {}

    /// The numbers of one path, or of one branch of a path.
    class Draws {
    public:
        [[nodiscard]] double operator()(std::uint32_t dimension) const noexcept {
            return dimension < nets_ ? 0x1.0p-32 * words_[dimension]
                                     : tail_->uniform(path_, dimension);
        }

    private:
        friend class PathRandomness;

        const RandomStream* tail_ = nullptr;
        std::uint64_t path_ = 0;
        std::uint32_t nets_ = 0; ///< so many dimensions are Sobol' points
        ScrambledSobol::Words words_;
    };

    [[nodiscard]] Draws draws(std::uint64_t path) const noexcept {
        Draws d;
        d.tail_ = &tail_;
        d.path_ = path;
        if (path <= 0xffffffffULL) {
            d.nets_ = sobol_dimensions;
            d.words_ = sobol_.words(static_cast<std::uint32_t>(path));
        }
        return d;
    }

    [[nodiscard]] double operator()(std::uint64_t path,
                                    std::uint32_t dimension) const noexcept {
        return draws(path)(dimension);
    }

private:
    ScrambledSobol sobol_;
    RandomStream tail_;
};

} // namespace isolux
