#include "isolux/sampling/random_stream.h"

#include <Random123/philox.h>

#include "isolux/base/check.h"

namespace isolux {

namespace {

constexpr double two_to_minus_32 = 0x1.0p-32;

} // namespace

std::array<std::uint32_t, 4> philox_block(const std::array<std::uint32_t, 4>& counter,
                                          const std::array<std::uint32_t, 2>& key) noexcept {
    const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
    const r123::Philox4x32::key_type k = {{key[0], key[1]}};
    const r123::Philox4x32::ctr_type r = r123::Philox4x32{}(c, k);
    return {r[0], r[1], r[2], r[3]};
}

std::array<std::uint32_t, 4> RandomStream::words(std::uint64_t index,
                                                 std::uint32_t block) const noexcept {
    ISOLUX_EXPECT(replicate_ < (1U << 24U));
    const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
    return philox_block({low(index),
                         low(index >> 32U),
                         block,
                         static_cast<std::uint32_t>(purpose_) << 24U | replicate_},
                        {low(seed_), low(seed_ >> 32U)});
}

std::uint32_t RandomStream::bits(std::uint64_t index, std::uint32_t dimension) const noexcept {
    return words(index, dimension / 4)[dimension % 4];
}

double RandomStream::uniform(std::uint64_t index, std::uint32_t dimension) const noexcept {
    return two_to_minus_32 * bits(index, dimension);
}

std::array<double, 4> RandomStream::uniform4(std::uint64_t index,
                                             std::uint32_t block) const noexcept {
    const std::array<std::uint32_t, 4> w = words(index, block);
    return {two_to_minus_32 * w[0],
            two_to_minus_32 * w[1],
            two_to_minus_32 * w[2],
            two_to_minus_32 * w[3]};
}

} // namespace isolux
