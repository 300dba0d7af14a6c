#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/sampling/random_stream.h"

#include "support/statistics.h"

namespace isolux {
namespace {

using Words = std::array<std::uint32_t, 4>;

// Known answers published with Random123 (file kat_vectors, generator philox4x32, 10 rounds).
TEST(Philox, GivesThePublishedKnownAnswers) {
    EXPECT_EQ(philox_block({0, 0, 0, 0}, {0, 0}),
              (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox_block({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
                           {0xffffffff, 0xffffffff}),
              (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox_block({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
                           {0xa4093822, 0x299f31d0}),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, PutsSeedIndexDimensionPurposeAndReplicateIntoTheCounter) {
    const RandomStream stream(0x0123456789abcdefULL, StreamPurpose::direct, 0x000abcde);
    const Words expected =
        philox_block({0x55667788, 0x11223344, 9, 0x030abcde}, {0x89abcdef, 0x01234567});
    for (std::uint32_t k = 0; k < 4; ++k)
        EXPECT_EQ(stream.bits(0x1122334455667788ULL, 36 + k), expected[k]);
}

TEST(RandomStream, DrawsFourAtOnceTheSameNumbersAsOneByOne) {
    const RandomStream stream(7, StreamPurpose::gather, 3);
    for (std::uint32_t block = 0; block < 5; ++block) {
        const std::array<double, 4> four = stream.uniform4(11, block);
        for (std::uint32_t k = 0; k < 4; ++k)
            EXPECT_EQ(four[k], stream.uniform(11, 4 * block + k));
    }
}

TEST(RandomStream, IsUniformOverIndexAndOverDimension) {
    constexpr std::size_t cells = 256;
    constexpr std::size_t draws = 1 << 16;
    const RandomStream stream(42, StreamPurpose::test, 0);
    std::vector<double> by_index(cells), by_dimension(cells);
    for (std::uint32_t i = 0; i < draws; ++i) {
        by_index[static_cast<std::size_t>(cells * stream.uniform(i, 1))] += 1.0;
        by_dimension[static_cast<std::size_t>(cells * stream.uniform(5, i))] += 1.0;
    }
    const std::vector<double> expected(cells, static_cast<double>(draws) / cells);
    EXPECT_GT(test::chi_square_tail(by_index, expected), test::chi_square_false_alarm);
    EXPECT_GT(test::chi_square_tail(by_dimension, expected), test::chi_square_false_alarm);
}

TEST(RandomStream, NeverReachesOne) {
    // The largest value is 1 - 2^-32; a conversion that rounds up would give 1.
    const RandomStream stream(1, StreamPurpose::test, 0);
    for (std::uint32_t i = 0; i < 1000; ++i)
        EXPECT_EQ(stream.uniform(i, 0) * 0x1.0p32, static_cast<double>(stream.bits(i, 0)));
}

} // namespace
} // namespace isolux
