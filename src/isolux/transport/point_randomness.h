#pragma once

#include <cstdint>

#include "isolux/sampling/random_stream.h"
#include "isolux/sampling/sobol.h"

namespace isolux {

/// The numbers of one receiver in one replicate for one purpose: a scrambled Sobol' sequence of
/// its own in the first dimensions, counter-based numbers beyond. Independent of the light
/// paths' numbers; a shared scramble would couple the two ends of a connection (METHODS "Random
/// numbers").
class PointRandomness {
public:
    PointRandomness(std::uint64_t seed,
                    StreamPurpose purpose,
                    std::uint32_t replicate,
                    std::uint64_t receiver)
        : tail_(seed, purpose, replicate), receiver_(receiver) {}

    /// Draw `dimension` of sample `index`; nets of the receiver's own for the first dimensions.
    [[nodiscard]] double operator()(std::uint32_t index,
                                    std::uint32_t dimension) const noexcept {
        if (dimension < nets)
            return sobol_owen(index, dimension, tail_.bits(receiver_, scrambles + dimension));
        return tail_.uniform(receiver_, (index << 11U) + dimension);
    }

private:
    // A sample may use 2^11 numbers before it meets those of the next one.
    static constexpr std::uint32_t nets = 6;
    static constexpr std::uint32_t scrambles = 0xffffff00U;

    RandomStream tail_;
    std::uint64_t receiver_;
};

/// The numbers of one sample, one after the other.
class NumberSequence {
public:
    NumberSequence(const PointRandomness& random, std::uint32_t sample) noexcept
        : random_(&random), sample_(sample) {}

    [[nodiscard]] double next() noexcept { return (*random_)(sample_, dimension_++); }

private:
    const PointRandomness* random_;
    std::uint32_t sample_;
    std::uint32_t dimension_ = 0;
};

} // namespace isolux
