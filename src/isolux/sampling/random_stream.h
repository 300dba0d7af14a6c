#pragma once

#include <cstdint>

namespace isolux {

/// What a stream of random numbers is for. Streams of different purposes never meet.
enum class StreamPurpose : std::uint32_t {
    light_path,
    gather,
    subset,
    direct,
    selection,
    pilot,
    test
};

/// Counter-based random numbers (Philox 4x32-10; Salmon et al., SC11): positioned, not
/// advanced. Draw `dimension` of item `index` is a pure function of (seed, purpose, replicate,
/// index, dimension), whoever asks and in whatever order.
class RandomStream {
public:
    constexpr RandomStream(std::uint64_t seed,
                           StreamPurpose purpose,
                           std::uint32_t replicate) noexcept
        : seed_(seed), purpose_(purpose), replicate_(replicate) {}

    /// Uniform in [0, 1), a multiple of 2^-32.
    [[nodiscard]] double uniform(std::uint64_t index, std::uint32_t dimension) const noexcept;

    /// 32 random bits.
    [[nodiscard]] std::uint32_t bits(std::uint64_t index,
                                     std::uint32_t dimension) const noexcept;

private:
    std::uint64_t seed_;
    StreamPurpose purpose_;
    std::uint32_t replicate_;
};

} // namespace isolux
