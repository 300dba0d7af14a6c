#pragma once

#include <array>
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
    test,
    tracing ///< paths from points
};

/// Four 32-bit words of the counter-based generator Philox 4x32-10: a keyed bijection of the
/// 128-bit counter (Salmon, Moraes, Dror, Shaw, SC11, doi:10.1145/2063384.2063405).
[[nodiscard]] std::array<std::uint32_t, 4>
philox_block(const std::array<std::uint32_t, 4>& counter,
             const std::array<std::uint32_t, 2>& key) noexcept;

/// Counter-based random numbers (Philox 4x32-10): positioned, not advanced. Draw `dimension` of
/// item `index` is a pure function of (seed, purpose, replicate, index, dimension), whoever
/// asks and in whatever order.
class RandomStream {
public:
    /// @pre replicate < 2^24: it shares a counter word with the purpose
    constexpr RandomStream(std::uint64_t seed,
                           StreamPurpose purpose,
                           std::uint32_t replicate) noexcept
        : seed_(seed), purpose_(purpose), replicate_(replicate) {}

    /// Uniform in [0, 1), a multiple of 2^-32.
    [[nodiscard]] double uniform(std::uint64_t index, std::uint32_t dimension) const noexcept;

    /// Draws 4 block, ..., 4 block + 3 for the price of one: `uniform4(i, b)[k]` equals
    /// `uniform(i, 4 b + k)`.
    [[nodiscard]] std::array<double, 4> uniform4(std::uint64_t index,
                                                 std::uint32_t block) const noexcept;

    /// 32 random bits: the ones behind `uniform`.
    [[nodiscard]] std::uint32_t bits(std::uint64_t index,
                                     std::uint32_t dimension) const noexcept;

    /// Four words of 32 random bits for the price of one.
    [[nodiscard]] std::array<std::uint32_t, 4> words(std::uint64_t index,
                                                     std::uint32_t block) const noexcept;

private:
    std::uint64_t seed_;
    StreamPurpose purpose_;
    std::uint32_t replicate_;
};

} // namespace isolux
