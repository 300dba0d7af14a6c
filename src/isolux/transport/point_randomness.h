#pragma once

#include <array>
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
    PointRandomness() = default;

    PointRandomness(std::uint64_t seed,
                    StreamPurpose purpose,
                    std::uint32_t replicate,
                    std::uint64_t receiver)
        : tail_(seed, purpose, replicate), receiver_(receiver) {
        const auto low = tail_.words(receiver, first_scramble / 4);
        const auto high = tail_.words(receiver, first_scramble / 4 + 1);
        for (std::uint32_t d = 0; d < nets; ++d)
            scramble_[d] = prepare_scramble(d < 4 ? low[d] : high[d - 4]);
    }

    /// Draw `dimension` of sample `index`; nets of the receiver's own for the first dimensions.
    [[nodiscard]] double operator()(std::uint32_t index,
                                    std::uint32_t dimension) const noexcept {
        if (dimension < nets)
            return sobol_owen(index, dimension, scramble_[dimension]);
        return tail_.uniform(item(index), (index << 11U) + dimension);
    }

    /// Dimensions of the nets; a sample's later draws come four at a time.
    static constexpr std::uint32_t nets = 6;

    /// Draws 4 block, ..., 4 block + 3 of a sample. @pre 4 block >= nets
    [[nodiscard]] std::array<double, 4> four(std::uint32_t index,
                                             std::uint32_t block) const noexcept {
        return tail_.uniform4(item(index), (index << 9U) + block);
    }

private:
    // A sample may use 2^11 numbers before it meets those of the next one.
    static constexpr std::uint32_t first_scramble = 0xffffff00U;

    /// The bits of a large sample number that the dimension has no room for.
    [[nodiscard]] std::uint64_t item(std::uint32_t index) const noexcept {
        return receiver_ + (std::uint64_t{index >> 21U} << 40U);
    }

    RandomStream tail_{0, StreamPurpose::gather, 0};
    std::uint64_t receiver_ = 0;
    std::array<SobolScramble, nets> scramble_{};
};

/// The numbers of one sample, one after the other.
class NumberSequence {
public:
    NumberSequence() = default;

    NumberSequence(const PointRandomness& random, std::uint32_t sample) noexcept
        : random_(&random), sample_(sample) {}

    [[nodiscard]] double next() noexcept {
        const std::uint32_t d = dimension_++;
        if (d < first_block)
            return (*random_)(sample_, d);
        if (d % 4 == 0)
            four_ = random_->four(sample_, d / 4);
        return four_[d % 4];
    }

private:
    static constexpr std::uint32_t first_block = (PointRandomness::nets + 3) / 4 * 4;

    const PointRandomness* random_ = nullptr;
    std::uint32_t sample_ = 0;
    std::uint32_t dimension_ = 0;
    std::array<double, 4> four_{};
};

} // namespace isolux
