#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <boost/random/sobol.hpp>
#include <gtest/gtest.h>

#include "isolux/sampling/sobol.h"

#include "support/statistics.h"

namespace isolux {
namespace {

constexpr std::uint32_t scramble_of(std::uint32_t d) {
    return 0x9e3779b9U * (d + 1) ^ 0x5bd1e995U;
}

/// Every elementary interval 2^-k x 2^-(m-k) holds exactly one of the 2^m points.
template <class X, class Y> bool is_0m2_net(unsigned m, X&& x, Y&& y) {
    for (unsigned k = 0; k <= m; ++k) {
        std::set<std::uint64_t> cells;
        for (std::uint32_t i = 0; i < 1U << m; ++i) {
            const auto column =
                static_cast<std::uint64_t>(std::ldexp(x(i), static_cast<int>(k)));
            const auto row =
                static_cast<std::uint64_t>(std::ldexp(y(i), static_cast<int>(m - k)));
            cells.insert(column << 32U | row);
        }
        if (cells.size() != 1U << m)
            return false;
    }
    return true;
}

TEST(Sobol, StartsAsPublished) {
    // First points of dimensions 0, 1, 2 in natural (not Gray code) order.
    const double expected[8][3] = {{0, 0, 0},
                                   {0.5, 0.5, 0.5},
                                   {0.25, 0.75, 0.75},
                                   {0.75, 0.25, 0.25},
                                   {0.125, 0.625, 0.375},
                                   {0.625, 0.125, 0.875},
                                   {0.375, 0.375, 0.625},
                                   {0.875, 0.875, 0.125}};
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::uint32_t d = 0; d < 3; ++d)
            EXPECT_EQ(sobol(i, d), expected[i][d]) << "point " << i << " dimension " << d;
}

// Boost.Random walks through the same points in the order of the Gray code, without the first.
TEST(Sobol, EveryDimensionEqualsBoostRandom) {
    boost::random::sobol_engine<std::uint32_t, 32> engine(sobol_dimensions);
    for (std::uint32_t i = 1; i < 1024; ++i)
        for (std::uint32_t d = 0; d < sobol_dimensions; ++d)
            ASSERT_EQ(std::ldexp(sobol(i ^ i >> 1U, d), 32), engine())
                << "point " << i << " dimension " << d;
    EXPECT_EQ(sobol(0, 19), 0.0);
}

TEST(Sobol, FirstTwoDimensionsAreA0m2Net) {
    for (unsigned m = 1; m <= 10; ++m)
        for (const std::uint32_t block : {0U, 1U, 5U})
            EXPECT_TRUE(is_0m2_net(
                m,
                [=](std::uint32_t i) { return sobol((block << m) + i, 0); },
                [=](std::uint32_t i) { return sobol((block << m) + i, 1); }))
                << "m " << m << " block " << block;
}

TEST(Sobol, ScrambleKeepsThe0m2Net) {
    for (unsigned m = 1; m <= 10; ++m)
        EXPECT_TRUE(is_0m2_net(
            m,
            [=](std::uint32_t i) { return sobol_owen((3U << m) + i, 0, scramble_of(0)); },
            [=](std::uint32_t i) { return sobol_owen((3U << m) + i, 1, scramble_of(1)); }))
            << "m " << m;
}

TEST(Sobol, EveryDimensionStratifiesEveryBlock) {
    constexpr unsigned m = 12;
    for (std::uint32_t d = 0; d < sobol_dimensions; ++d)
        for (const std::uint32_t block : {0U, 1U, 77U, (1U << (32 - m)) - 1U}) {
            std::vector<bool> seen(1U << m);
            for (std::uint32_t i = 0; i < 1U << m; ++i)
                seen[static_cast<std::size_t>(
                    std::ldexp(sobol_owen((block << m) + i, d, scramble_of(d)), m))] = true;
            for (const bool s : seen)
                ASSERT_TRUE(s) << "dimension " << d << " block " << block;
        }
}

TEST(Sobol, DimensionsDiffer) {
    std::set<std::vector<double>> distinct;
    for (std::uint32_t d = 0; d < sobol_dimensions; ++d) {
        std::vector<double> points;
        for (std::uint32_t i = 0; i < 256; ++i)
            points.push_back(sobol(i, d));
        distinct.insert(points);
    }
    EXPECT_EQ(distinct.size(), sobol_dimensions);
}

// Unbiasedness needs each single point to be uniform over the scrambles.
TEST(SobolOwen, EveryPointIsUniformOverTheScrambles) {
    constexpr std::size_t cells = 256;
    constexpr std::uint32_t draws = 1 << 16;
    const std::vector<double> expected(cells, static_cast<double>(draws) / cells);
    for (const std::uint32_t index : {0U, 1U, 2U, 1023U, 0x80000000U})
        for (const std::uint32_t d : {0U, 1U, 7U, 19U}) {
            std::vector<double> top(cells), low(cells);
            for (std::uint32_t r = 0; r < draws; ++r) {
                const double x = sobol_owen(index, d, make_scramble(5, r, d));
                top[static_cast<std::size_t>(cells * x)] += 1.0;
                const auto bits = static_cast<std::uint32_t>(std::ldexp(x, 32));
                low[bits & 255U] += 1.0;
            }
            EXPECT_GT(test::chi_square_tail(top, expected), test::chi_square_false_alarm)
                << "index " << index << " dimension " << d;
            EXPECT_GT(test::chi_square_tail(low, expected), test::chi_square_false_alarm)
                << "lowest bits, index " << index << " dimension " << d;
        }
}

// In an Owen scramble two points that share their first k binary digits and differ in the next
// are independent and uniform below that digit.
TEST(SobolOwen, PairsOfPointsAreIndependentBelowTheirCommonDigits) {
    constexpr std::size_t side = 16;
    constexpr std::uint32_t draws = 1 << 16;
    const std::vector<double> expected(side * side, static_cast<double>(draws) / (side * side));
    for (const unsigned common : {0U, 3U, 8U, 12U}) {
        const std::uint32_t other =
            1U << common; // van der Corput: first differs in digit `common`
        std::vector<double> counts(side * side);
        for (std::uint32_t r = 0; r < draws; ++r) {
            const std::uint32_t seed = make_scramble(9, r, 0);
            const double below = std::ldexp(1.0, static_cast<int>(common) + 1);
            const double a = sobol_owen(0, 0, seed) * below;
            const double b = sobol_owen(other, 0, seed) * below;
            const auto i = static_cast<std::size_t>(side * (a - std::floor(a)));
            const auto j = static_cast<std::size_t>(side * (b - std::floor(b)));
            counts[i * side + j] += 1.0;
        }
        EXPECT_GT(test::chi_square_tail(counts, expected), test::chi_square_false_alarm)
            << "common digits " << common;
    }
}

// Smooth integrands over nets: the variance over scrambles falls like n^-3 (Owen 1997), far
// faster than the 1/n of independent points; a broken scramble gives 1/n or no variance at all.
TEST(SobolOwen, VarianceOfASmoothIntegralFallsLikeTheThirdPower) {
    const auto integral = [](std::uint32_t n, std::uint32_t replicate) {
        const std::uint32_t su = make_scramble(1, replicate, 0);
        const std::uint32_t sv = make_scramble(1, replicate, 1);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < n; ++i)
            sum += std::exp(sobol_owen(i, 0, su) + sobol_owen(i, 1, sv));
        return sum / n;
    };
    const double truth = (std::exp(1.0) - 1.0) * (std::exp(1.0) - 1.0);
    Estimate few, many;
    few = test::over_seeds(
        [&](std::size_t s) { return integral(16, static_cast<std::uint32_t>(s)); });
    many = test::over_seeds(
        [&](std::size_t s) { return integral(1024, static_cast<std::uint32_t>(s)); });
    EXPECT_LT(std::abs(test::z_score(few, truth)), test::z_limit);
    EXPECT_LT(std::abs(test::z_score(many, truth)), test::z_limit);
    const double slope =
        2.0 * std::log(many.standard_error / few.standard_error) / std::log(64.0);
    EXPECT_LT(slope, -2.0);
}

TEST(Sobol, WholePointsAreTheSingleDraws) {
    for (const std::uint32_t replicate : {0U, 15U, 0xfffffeU}) {
        const ScrambledSobol sequence(12, replicate);
        for (std::uint32_t i = 0; i < 300; ++i) {
            const std::uint32_t index = i < 256 ? i : i * 0x9e3779b9U;
            const ScrambledSobol::Words words = sequence.words(index);
            for (std::uint32_t d = 0; d < sobol_dimensions; ++d)
                ASSERT_EQ(0x1.0p-32 * words[d],
                          sobol_owen(index, d, make_scramble(12, replicate, d)));
        }
    }
}

TEST(MakeScramble, DependsOnEveryArgument) {
    std::set<std::uint32_t> distinct;
    std::size_t made = 0;
    for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL, 1ULL << 32U, 1ULL << 63U})
        for (std::uint32_t replicate = 0; replicate < 16; ++replicate)
            for (std::uint32_t d = 0; d < sobol_dimensions; ++d, ++made)
                distinct.insert(make_scramble(seed, replicate, d));
    EXPECT_EQ(distinct.size(), made); // 1600 of 2^32: a coincidence has probability 3e-4
}

} // namespace
} // namespace isolux
