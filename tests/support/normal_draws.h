#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace isolux::test {

/// Standard normal numbers that are the same on every machine and standard library (the
/// algorithm of std::normal_distribution is not fixed by the standard). Box-Muller.
class NormalDraws {
public:
    explicit NormalDraws(std::uint64_t seed) : engine_(seed) {}

    double operator()() {
        const double r = std::sqrt(-2.0 * std::log(1.0 - uniform()));
        return r * std::cos(2.0 * std::numbers::pi * uniform());
    }

    /// In [0, 1).
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 engine_;
};

} // namespace isolux::test
