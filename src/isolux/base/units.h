#pragma once

#include <compare>

/// Photometric quantities as types (CIE S 017, EN 12665). Interfaces speak types; kernels
/// unwrap by name, `in_lux(e)`, and compute in double.
namespace isolux {

template <class Unit> class Quantity {
public:
    constexpr Quantity() noexcept = default;

    explicit constexpr Quantity(double value) noexcept : value_(value) {}

    [[nodiscard]] constexpr double value() const noexcept { return value_; }

    friend constexpr auto operator<=>(const Quantity&, const Quantity&) = default;

    friend constexpr Quantity operator+(Quantity a, Quantity b) noexcept {
        return Quantity(a.value_ + b.value_);
    }

    friend constexpr Quantity operator-(Quantity a, Quantity b) noexcept {
        return Quantity(a.value_ - b.value_);
    }

    friend constexpr Quantity operator*(double s, Quantity a) noexcept {
        return Quantity(s * a.value_);
    }

    friend constexpr Quantity operator*(Quantity a, double s) noexcept { return s * a; }

    friend constexpr Quantity operator/(Quantity a, double s) noexcept {
        return Quantity(a.value_ / s);
    }

    friend constexpr double operator/(Quantity a, Quantity b) noexcept {
        return a.value_ / b.value_;
    }

    constexpr Quantity& operator+=(Quantity b) noexcept {
        value_ += b.value_;
        return *this;
    }

private:
    double value_ = 0.0;
};

using Lux = Quantity<struct LuxUnit>;         ///< illuminance, lm/m2
using Candela = Quantity<struct CandelaUnit>; ///< luminous intensity, lm/sr
using Lumen = Quantity<struct LumenUnit>;     ///< luminous flux
using CandelaPerSquareMetre = Quantity<struct CandelaPerSquareMetreUnit>; ///< luminance
using Metre = Quantity<struct MetreUnit>;
using SquareMetre = Quantity<struct SquareMetreUnit>;
using Steradian = Quantity<struct SteradianUnit>;

constexpr double in_lux(Lux e) noexcept { return e.value(); }

constexpr double in_candela(Candela i) noexcept { return i.value(); }

constexpr double in_lumen(Lumen f) noexcept { return f.value(); }

constexpr double in_candela_per_square_metre(CandelaPerSquareMetre l) noexcept {
    return l.value();
}

constexpr double in_metre(Metre l) noexcept { return l.value(); }

constexpr SquareMetre operator*(Metre a, Metre b) noexcept {
    return SquareMetre(a.value() * b.value());
}

constexpr Lux operator/(Lumen f, SquareMetre a) noexcept { return Lux(f.value() / a.value()); }

constexpr Lux operator/(Candela i, SquareMetre d2) noexcept {
    return Lux(i.value() / d2.value());
}

constexpr Lumen operator*(Candela i, Steradian w) noexcept {
    return Lumen(i.value() * w.value());
}

constexpr CandelaPerSquareMetre luminance_of(Candela i, SquareMetre projected_area) noexcept {
    return CandelaPerSquareMetre(i.value() / projected_area.value());
}

} // namespace isolux
