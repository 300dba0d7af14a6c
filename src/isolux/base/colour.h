#pragma once

#include <algorithm>

namespace isolux {

/// Three colour channels (linear, Rec. 709 primaries). A luminaire of white light is {1, 1, 1},
/// so that the Y-sum of a result is in lx or cd/m2; see METHODS.md, "Channels".
struct Rgb {
    double r = 0.0;
    double g = 0.0;
    double b = 0.0;

    [[nodiscard]] static constexpr Rgb grey(double v) noexcept { return {v, v, v}; }

    friend constexpr bool operator==(const Rgb&, const Rgb&) = default;

    constexpr Rgb& operator+=(const Rgb& o) noexcept {
        r += o.r;
        g += o.g;
        b += o.b;
        return *this;
    }
};

constexpr Rgb operator+(const Rgb& a, const Rgb& b) noexcept {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
}

constexpr Rgb operator-(const Rgb& a, const Rgb& b) noexcept {
    return {a.r - b.r, a.g - b.g, a.b - b.b};
}

constexpr Rgb operator*(const Rgb& a, const Rgb& b) noexcept {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}

constexpr Rgb operator*(double s, const Rgb& a) noexcept { return {s * a.r, s * a.g, s * a.b}; }

/// Photometric sum Y of the channels (Rec. ITU-R BT.709). The blue weight is one minus the
/// others, so that a grey value is its own Y to the last bit of the weights.
constexpr double luminance_sum(const Rgb& c) noexcept {
    constexpr double wr = 0.2126;
    constexpr double wg = 0.7152;
    return wr * c.r + wg * c.g + (1.0 - wr - wg) * c.b;
}

constexpr bool is_grey(const Rgb& c) noexcept { return c.r == c.g && c.g == c.b; }

constexpr double max_channel(const Rgb& c) noexcept { return std::max({c.r, c.g, c.b}); }

} // namespace isolux
