#include "isolux/sampling/sobol.h"

#include <array>

#include "isolux/base/check.h"
#include "isolux/base/wide_vectors.h"

namespace isolux {

namespace {

/// A primitive polynomial over GF(2) (bit k is the coefficient of x^k) and the first direction
/// integers of its dimension, the recommended choice "D(6)": S. Joe, F. Y. Kuo, Constructing
/// Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput. 30 (2008)
/// 2635-2654.
struct Recurrence {
    unsigned degree;
    std::uint32_t polynomial;
    std::array<std::uint32_t, 7> first;
};

/// Dimension 0 is the van der Corput sequence and needs no recurrence; entry j serves
/// dimension j + 1.
constexpr std::array<Recurrence, sobol_dimensions - 1> recurrences = {{
    {1, 3, {1}},
    {2, 7, {1, 3}},
    {3, 11, {1, 3, 1}},
    {3, 13, {1, 1, 1}},
    {4, 19, {1, 1, 3, 3}},
    {4, 25, {1, 3, 5, 13}},
    {5, 37, {1, 1, 5, 5, 17}},
    {5, 41, {1, 1, 5, 5, 5}},
    {5, 47, {1, 1, 7, 11, 19}},
    {5, 55, {1, 1, 5, 1, 1}},
    {5, 59, {1, 1, 1, 3, 11}},
    {5, 61, {1, 3, 5, 5, 31}},
    {6, 67, {1, 3, 3, 9, 7, 49}},
    {6, 91, {1, 1, 1, 15, 21, 21}},
    {6, 97, {1, 3, 1, 13, 27, 49}},
    {6, 103, {1, 1, 1, 15, 7, 5}},
    {6, 109, {1, 3, 1, 15, 13, 25}},
    {6, 115, {1, 1, 5, 5, 19, 61}},
    {7, 131, {1, 3, 7, 11, 23, 15, 103}},
}};

ISOLUX_INLINE constexpr std::uint32_t reverse_bits(std::uint32_t x) noexcept {
    x = (x & 0x55555555U) << 1U | (x >> 1U & 0x55555555U);
    x = (x & 0x33333333U) << 2U | (x >> 2U & 0x33333333U);
    x = (x & 0x0f0f0f0fU) << 4U | (x >> 4U & 0x0f0f0f0fU);
    x = (x & 0x00ff00ffU) << 8U | (x >> 8U & 0x00ff00ffU);
    return x << 16U | x >> 16U;
}

/// The 32 direction numbers of a dimension, binary point before the top bit (Bratley and Fox,
/// Algorithm 659, ACM TOMS 14 (1988) 88-100).
constexpr std::array<std::uint32_t, 32> make_direction_numbers(std::uint32_t dimension) {
    std::array<std::uint32_t, 32> v{};
    if (dimension == 0) {
        for (unsigned i = 0; i < 32; ++i)
            v[i] = 1U << (31U - i);
        return v;
    }
    const Recurrence& r = recurrences[dimension - 1];
    for (unsigned i = 0; i < r.degree; ++i)
        v[i] = r.first[i] << (31U - i);
    for (unsigned i = r.degree; i < 32; ++i) {
        v[i] = v[i - r.degree] ^ (v[i - r.degree] >> r.degree);
        for (unsigned k = 1; k < r.degree; ++k)
            if ((r.polynomial >> (r.degree - k) & 1U) != 0)
                v[i] ^= v[i - k];
    }
    return v;
}

/// Bits of the index are taken four at a time: one look-up gives the exclusive or of up to four
/// direction numbers, of all dimensions side by side. They are stored with their bits reversed,
/// as the scramble wants them. 12 KiB in all.
constexpr unsigned digit_bits = 4;
constexpr unsigned digits = 1U << digit_bits;
using Words = ScrambledSobol::Words;
using DigitTable = std::array<std::array<Words, digits>, 32 / digit_bits>;

constexpr DigitTable make_table() {
    DigitTable table{};
    for (std::uint32_t d = 0; d < sobol_dimensions; ++d) {
        const std::array<std::uint32_t, 32> v = make_direction_numbers(d);
        for (unsigned place = 0; place < table.size(); ++place)
            for (unsigned digit = 0; digit < digits; ++digit)
                for (unsigned bit = 0; bit < digit_bits; ++bit)
                    if ((digit >> bit & 1U) != 0)
                        table[place][digit][d] ^= reverse_bits(v[place * digit_bits + bit]);
    }
    return table;
}

constexpr DigitTable table = make_table();

std::uint32_t reversed_sobol(std::uint32_t index, std::uint32_t dimension) noexcept {
    std::uint32_t x = 0;
    for (unsigned place = 0; index != 0; ++place, index >>= digit_bits)
        x ^= table[place][index % digits][dimension];
    return x;
}

/// Finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014).
constexpr std::uint64_t mix(std::uint64_t z) noexcept {
    z = (z ^ z >> 30U) * 0xbf58476d1ce4e5b9U;
    z = (z ^ z >> 27U) * 0x94d049bb133111ebU;
    return z ^ z >> 31U;
}

/// A permutation in which bit k of the result depends on bits 0..k of the argument only: in
/// reversed bit order that is a nested scramble. The hash of Laine and Karras (2011) with the
/// constants of N. Vegdahl, "Building a Better LK Hash" (2021), but with a shift and a factor
/// of 32 bits each that are independent. That makes every point uniform, and every pair of
/// points uniform over the pairs with as many common digits, as in a full Owen scramble; on
/// these the variance of an integral depends, and on nothing else.
ISOLUX_INLINE constexpr std::uint32_t
hash_upwards(std::uint32_t x, std::uint32_t shift, std::uint32_t factor) noexcept {
    x ^= x * 0x3d20adeaU;
    x += shift;
    x *= factor;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

ISOLUX_WIDE_VECTORS void scrambled_words(std::uint32_t index,
                                         const Words& shift,
                                         const Words& factor,
                                         Words& x) noexcept {
    x = table[0][index % digits];
    for (unsigned place = 1; (index >>= digit_bits) != 0; ++place) {
        const Words& row = table[place][index % digits];
        for (std::size_t d = 0; d < x.size(); ++d)
            x[d] ^= row[d];
    }
    for (std::size_t d = 0; d < x.size(); ++d)
        x[d] = reverse_bits(hash_upwards(x[d], shift[d], factor[d]));
}

} // namespace

double sobol(std::uint32_t index, std::uint32_t dimension) noexcept {
    ISOLUX_EXPECT(dimension < sobol_dimensions);
    return 0x1.0p-32 * reverse_bits(reversed_sobol(index, dimension));
}

SobolScramble prepare_scramble(std::uint32_t scramble) noexcept {
    const std::uint64_t words = mix(scramble + 0x9e3779b97f4a7c15U);
    return {static_cast<std::uint32_t>(words), static_cast<std::uint32_t>(words >> 32U) | 1U};
}

double
sobol_owen(std::uint32_t index, std::uint32_t dimension, SobolScramble scramble) noexcept {
    ISOLUX_EXPECT(dimension < sobol_dimensions);
    return 0x1.0p-32
           * reverse_bits(
               hash_upwards(reversed_sobol(index, dimension), scramble.shift, scramble.factor));
}

double
sobol_owen(std::uint32_t index, std::uint32_t dimension, std::uint32_t scramble) noexcept {
    return sobol_owen(index, dimension, prepare_scramble(scramble));
}

std::uint32_t
make_scramble(std::uint64_t seed, std::uint32_t replicate, std::uint32_t dimension) noexcept {
    const std::uint64_t place = std::uint64_t{replicate} << 32U | dimension;
    return static_cast<std::uint32_t>(mix(mix(seed + 0x9e3779b97f4a7c15U) ^ place) >> 32U);
}

ScrambledSobol::ScrambledSobol(std::uint64_t seed, std::uint32_t replicate) noexcept {
    for (std::uint32_t d = 0; d < sobol_dimensions; ++d) {
        const SobolScramble s = prepare_scramble(make_scramble(seed, replicate, d));
        shift_[d] = s.shift;
        factor_[d] = s.factor;
    }
}

ScrambledSobol::Words ScrambledSobol::words(std::uint32_t index) const noexcept {
    Words x;
    scrambled_words(index, shift_, factor_, x);
    return x;
}

} // namespace isolux
