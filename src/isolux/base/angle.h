#pragma once

#include <compare>
#include <numbers>

namespace isolux {

/// A plane angle. Degrees exist in files only; build one with `degrees(30)` or `radians(x)`.
class Angle {
public:
    constexpr Angle() noexcept = default;

    [[nodiscard]] static constexpr Angle from_radians(double value) noexcept {
        Angle a;
        a.radians_ = value;
        return a;
    }

    [[nodiscard]] constexpr double in_radians() const noexcept { return radians_; }

    [[nodiscard]] constexpr double in_degrees() const noexcept {
        return radians_ * (180.0 / std::numbers::pi);
    }

    friend constexpr auto operator<=>(const Angle&, const Angle&) = default;

    friend constexpr Angle operator+(Angle a, Angle b) noexcept {
        return from_radians(a.radians_ + b.radians_);
    }

    friend constexpr Angle operator-(Angle a, Angle b) noexcept {
        return from_radians(a.radians_ - b.radians_);
    }

    friend constexpr Angle operator*(double s, Angle a) noexcept {
        return from_radians(s * a.radians_);
    }

private:
    double radians_ = 0.0;
};

[[nodiscard]] constexpr Angle radians(double value) noexcept {
    return Angle::from_radians(value);
}

[[nodiscard]] constexpr Angle degrees(double value) noexcept {
    return Angle::from_radians(value * (std::numbers::pi / 180.0));
}

} // namespace isolux
