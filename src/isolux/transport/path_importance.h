#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "isolux/base/vec.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// Numbers places on surfaces by the way they face, then by their cell of 8 x 8 x 8 over the
/// scene along a curve that keeps neighbours together.
class CellOrder {
public:
    static constexpr std::size_t keys = 6U << 9U;

    CellOrder() = default;

    explicit CellOrder(const Bounds& bounds) : lower_(bounds.lower) {
        const Vector3 size = bounds.upper - bounds.lower;
        const auto scale = [](double s) { return s > 0.0 ? 8.0 / s : 0.0; };
        scale_ = {scale(size.x), scale(size.y), scale(size.z)};
    }

    [[nodiscard]] std::uint32_t key(const Point3& at, const UnitVector3& n) const noexcept {
        const Vector3 p = at - lower_;
        const auto cell = [](double s) {
            return static_cast<std::uint32_t>(std::clamp(s, 0.0, 7.0));
        };
        return facing(n) << 9U | spread(cell(p.x * scale_.x)) << 2U
               | spread(cell(p.y * scale_.y)) << 1U | spread(cell(p.z * scale_.z));
    }

private:
    /// Which way a normal mainly points: 0..5.
    static std::uint32_t facing(const UnitVector3& n) noexcept {
        const double x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
        if (z >= x && z >= y)
            return n.z() < 0.0 ? 0U : 1U;
        if (x >= y)
            return n.x() < 0.0 ? 2U : 3U;
        return n.y() < 0.0 ? 4U : 5U;
    }

    /// The bits of a number below 8, three places apart.
    static constexpr std::uint32_t spread(std::uint32_t x) noexcept {
        return (x & 1U) | (x & 2U) << 2U | (x & 4U) << 4U;
    }

    Point3 lower_;
    Vector3 scale_;
};

/// How many times as often as their flux alone would light paths should visit a place: METHODS
/// eq. (135). Any positive factors leave all means as they are.
class PathImportance {
public:
    /// 1 everywhere.
    PathImportance() = default;

    /// @param factors  by key of the cell order
    PathImportance(const Bounds& bounds, std::vector<float> factors)
        : order_(bounds), factors_(std::move(factors)) {}

    [[nodiscard]] bool is_even() const noexcept { return factors_.empty(); }

    [[nodiscard]] double at(const Point3& place, const UnitVector3& normal) const noexcept {
        return is_even() ? 1.0 : static_cast<double>(factors_[order_.key(place, normal)]);
    }

private:
    CellOrder order_;
    std::vector<float> factors_;
};

} // namespace isolux
