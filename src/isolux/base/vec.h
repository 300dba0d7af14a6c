#pragma once

#include <array>
#include <cmath>

/// Places and directions. Points and vectors are different types: the difference of two points
/// is a vector, a unit vector is made only by normalising. Right-handed, z up, metres.
namespace isolux {

struct Vector3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

constexpr Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

constexpr Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

constexpr Vector3 operator-(const Vector3& a) noexcept { return {-a.x, -a.y, -a.z}; }

constexpr Vector3 operator*(double s, const Vector3& a) noexcept {
    return {s * a.x, s * a.y, s * a.z};
}

constexpr Vector3 operator*(const Vector3& a, double s) noexcept { return s * a; }

constexpr Vector3 operator/(const Vector3& a, double s) noexcept { return (1.0 / s) * a; }

constexpr double dot(const Vector3& a, const Vector3& b) noexcept {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr Vector3 cross(const Vector3& a, const Vector3& b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

constexpr double length_squared(const Vector3& a) noexcept { return dot(a, a); }

inline double length(const Vector3& a) noexcept { return std::sqrt(dot(a, a)); }

/// A direction of length one. The zero vector has no direction; normalising it gives +z, so
/// that no NaN is ever born here. Callers that care test the length first.
class UnitVector3 {
public:
    constexpr UnitVector3() noexcept = default;

    explicit UnitVector3(const Vector3& v) noexcept {
        const double l = length(v);
        if (l > 0.0)
            v_ = v / l;
    }

    /// Takes a vector that is of unit length by construction, e.g. from sines and cosines.
    [[nodiscard]] static constexpr UnitVector3 from_unit(const Vector3& v) noexcept {
        UnitVector3 u;
        u.v_ = v;
        return u;
    }

    constexpr operator const Vector3&() const noexcept {
        return v_;
    } // NOLINT: a direction is a vector

    [[nodiscard]] constexpr double x() const noexcept { return v_.x; }

    [[nodiscard]] constexpr double y() const noexcept { return v_.y; }

    [[nodiscard]] constexpr double z() const noexcept { return v_.z; }

    constexpr UnitVector3 operator-() const noexcept { return from_unit(-v_); }

    friend constexpr bool operator==(const UnitVector3&, const UnitVector3&) = default;

private:
    Vector3 v_{0.0, 0.0, 1.0};
};

struct Point3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    friend constexpr bool operator==(const Point3&, const Point3&) = default;
};

constexpr Vector3 operator-(const Point3& a, const Point3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

constexpr Point3 operator+(const Point3& p, const Vector3& v) noexcept {
    return {p.x + v.x, p.y + v.y, p.z + v.z};
}

constexpr Point3 operator-(const Point3& p, const Vector3& v) noexcept {
    return {p.x - v.x, p.y - v.y, p.z - v.z};
}

inline double distance(const Point3& a, const Point3& b) noexcept { return length(a - b); }

constexpr Point3 midpoint(const Point3& a, const Point3& b) noexcept {
    return a + 0.5 * (b - a);
}

/// Two unit vectors that complete `n` to a right-handed orthonormal basis (t, b, n).
/// Branch-free form of Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1),
/// 2017.
struct Basis {
    UnitVector3 t;
    UnitVector3 b;
    UnitVector3 n;

    [[nodiscard]] Vector3 to_world(const Vector3& local) const noexcept {
        return local.x * Vector3(t) + local.y * Vector3(b) + local.z * Vector3(n);
    }

    [[nodiscard]] Vector3 to_local(const Vector3& world) const noexcept {
        return {dot(t, world), dot(b, world), dot(n, world)};
    }
};

inline Basis make_basis(const UnitVector3& n) noexcept {
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z());
    const double c = n.x() * n.y() * a;
    return {UnitVector3::from_unit({1.0 + sign * n.x() * n.x() * a, sign * c, -sign * n.x()}),
            UnitVector3::from_unit({c, sign + n.y() * n.y() * a, -n.y()}),
            n};
}

} // namespace isolux
