#include "isolux/sampling/warp.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>

#include "isolux/base/arc_tangent.h"
#include "isolux/base/check.h"
#include "isolux/base/sine_cosine.h"

namespace isolux {

namespace {

using std::numbers::pi;

constexpr double largest_below_one = 0x1.fffffffffffffp-1;

/// Opposite sides equal up to rounding of coordinates of this size.
bool is_parallelogram(std::span<const Point3> p) noexcept {
    constexpr double rounding = 1e-12;
    return p.size() == 4
           && length_squared((p[1] - p[0]) - (p[2] - p[3]))
                  <= rounding * rounding
                         * (length_squared(p[1] - p[0]) + length_squared(p[3] - p[0]));
}

Point3 sample_triangle(
    const Point3& a, const Point3& b, const Point3& c, double u, double v) noexcept {
    const double root = std::sqrt(u);
    return a + root * ((1.0 - v) * (b - a) + v * (c - a));
}

/// Twice the area of triangle k of the fan around the first vertex.
double double_area(std::span<const Point3> p, std::size_t k) noexcept {
    return length(cross(p[k + 1] - p[0], p[k + 2] - p[0]));
}

/// Angle between two planes that meet in the direction `edge`, whose other contents are `p` and
/// `q`: the corner angle of a spherical triangle.
double corner_angle(const Vector3& edge, const Vector3& p, const Vector3& q) noexcept {
    const Vector3 n = cross(edge, p);
    const Vector3 m = cross(edge, q);
    return std::atan2(length(cross(n, m)), dot(n, m));
}

/// [P|Q]: the unit vector of P - (P.Q) Q.
UnitVector3 perpendicular_part(const Vector3& p, const Vector3& q) noexcept {
    return UnitVector3(p - dot(p, q) * q);
}

double unit_sine(double cosine) noexcept {
    return std::sqrt(std::max(0.0, (1.0 - cosine) * (1.0 + cosine)));
}

/// Draws from a running sum, knowing that the entry is in [first, last).
DiscreteSample sample_between(std::span<const double> cumulative,
                              std::size_t first,
                              std::size_t last,
                              double u) noexcept {
    ISOLUX_EXPECT(!cumulative.empty() && cumulative.back() > 0.0);
    // u < 1, so the target is below the total unless rounding lifts it there.
    const double total = cumulative.back();
    const double target = std::min(u * total, total * largest_below_one);
    const auto found =
        std::upper_bound(cumulative.data() + first, cumulative.data() + last, target);
    const auto index = static_cast<std::size_t>(found - cumulative.data());
    const double below = index > 0 ? cumulative[index - 1] : 0.0;
    const double stretched = (target - below) / (cumulative[index] - below);
    return {index, std::clamp(stretched, 0.0, largest_below_one)};
}

} // namespace

Vector3 sample_cosine_hemisphere(double u, double v) noexcept {
    const double radius = std::sqrt(u);
    const SineCosine azimuth = sine_cosine(v);
    return {radius * azimuth.cosine, radius * azimuth.sine, std::sqrt(1.0 - u)};
}

double pdf_cosine_hemisphere(double cos_theta) noexcept {
    return std::max(0.0, cos_theta) / pi;
}

UnitVector3 sample_sphere(double u, double v) noexcept {
    const double z = 1.0 - 2.0 * u;
    const double radius = unit_sine(z);
    const SineCosine azimuth = sine_cosine(v);
    return UnitVector3::from_unit({radius * azimuth.cosine, radius * azimuth.sine, z});
}

Point3 sample_polygon(std::span<const Point3> vertices, double u, double v) noexcept {
    ISOLUX_EXPECT(vertices.size() >= 3);
    if (is_parallelogram(vertices))
        return vertices[0] + u * (vertices[1] - vertices[0]) + v * (vertices[3] - vertices[0]);
    const std::size_t triangles = vertices.size() - 2;
    double total = 0.0;
    for (std::size_t k = 0; k < triangles; ++k)
        total += double_area(vertices, k);
    double left = u * total;
    std::size_t chosen = 0;
    double area = double_area(vertices, 0);
    while (chosen + 1 < triangles && left >= area) {
        left -= area;
        area = double_area(vertices, ++chosen);
    }
    const double stretched = area > 0.0 ? std::min(left / area, 1.0) : 0.0;
    return sample_triangle(
        vertices[0], vertices[chosen + 1], vertices[chosen + 2], stretched, v);
}

Point3 sample_fan(std::span<const Point3> vertices,
                  std::span<const double> running,
                  double u,
                  double v) noexcept {
    ISOLUX_EXPECT(vertices.size() == running.size() + 2);
    const double at = u * running.back();
    const auto found = std::upper_bound(running.begin(), running.end() - 1, at);
    const auto k = static_cast<std::size_t>(found - running.begin());
    const double before = k == 0 ? 0.0 : running[k - 1];
    const double area = running[k] - before;
    const double stretched = area > 0.0 ? std::min((at - before) / area, 1.0) : 0.0;
    return sample_triangle(vertices[0], vertices[k + 1], vertices[k + 2], stretched, v);
}

SphericalRectangle::SphericalRectangle(const Point3& corner,
                                       const Vector3& edge_u,
                                       const Vector3& edge_v,
                                       const Point3& seen_from) noexcept
    : origin_(seen_from) {
    const double width = length(edge_u);
    const double height = length(edge_v);
    ex_ = edge_u / width;
    ey_ = edge_v / height;
    ez_ = cross(ex_, ey_);
    const Vector3 d = corner - seen_from;
    x0_ = dot(d, ex_);
    y0_ = dot(d, ey_);
    z0_ = dot(d, ez_);
    if (z0_ > 0.0) { // the third axis points away from the rectangle
        ez_ = -ez_;
        z0_ = -z0_;
    }
    x1_ = x0_ + width;
    y1_ = y0_ + height;
    constexpr double in_plane = 1e-12; // of the distance to the corner
    if (-z0_ <= in_plane * length(d))
        return;
    // e^(i g) of the four inner angles, each times the lengths of its two planes' normals.
    // Their product turns by g0 + g1 + g2 + g3 = Omega + 2 pi.
    using Complex = std::complex<double>;
    const auto corner_at = [this](double x, double y) {
        return Complex(x * y, -z0_ * std::sqrt(x * x + y * y + z0_ * z0_));
    };
    const auto times = [](Complex a, Complex b) {
        return Complex(a.real() * b.real() - a.imag() * b.imag(),
                       a.real() * b.imag() + a.imag() * b.real());
    };
    const Complex near_side = times(corner_at(x1_, y0_), corner_at(-x1_, y1_)); // g0 + g1
    const Complex far_side = times(corner_at(x0_, y1_), corner_at(-x0_, y0_));  // g2 + g3
    const Complex all = times(near_side, far_side);
    const double turned = arc_tangent(all.imag(), all.real());
    // More than pi only from right above it, nearer than it is wide.
    const bool is_above = std::max(x0_, y0_) < 0.0 && std::min(x1_, y1_) > 0.0 && -z0_ < width;
    omega_ = std::max(0.0, turned < 0.0 && is_above ? turned + 2.0 * pi : turned);
    const double r0 = std::sqrt(z0_ * z0_ + y0_ * y0_);
    const double r1 = std::sqrt(z0_ * z0_ + y1_ * y1_);
    b0_ = -y0_ / r0;
    b1_ = y1_ / r1;
    const double scale = 1.0 / (r0 * r1 * (z0_ * z0_ + x0_ * x0_));
    cos_k_ = scale * far_side.real();
    sin_k_ = -scale * far_side.imag();
}

Point3 SphericalRectangle::sample(double u, double v) const noexcept {
    const SineCosine part = sine_cosine(u * omega_ / (2.0 * pi));
    const double cos_a = part.cosine * cos_k_ - part.sine * sin_k_;
    const double sin_a = part.sine * cos_k_ + part.cosine * sin_k_;
    const double fu = (cos_a * b0_ - b1_) / sin_a;
    const double cu =
        std::clamp(std::copysign(1.0, fu) / std::sqrt(fu * fu + b0_ * b0_), -1.0, 1.0);
    const double x = std::clamp(-cu * z0_ / std::max(unit_sine(cu), 1e-15), x0_, x1_);
    const double d2 = x * x + z0_ * z0_;
    const double h0 = y0_ / std::sqrt(d2 + y0_ * y0_);
    const double h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const double h = h0 + v * (h1 - h0);
    const double y =
        std::clamp(h * std::sqrt(d2) / std::sqrt(std::max(1.0 - h * h, 1e-30)), y0_, y1_);
    return origin_ + x * ex_ + y * ey_ + z0_ * ez_;
}

SphericalTriangle::SphericalTriangle(const UnitVector3& a,
                                     const UnitVector3& b,
                                     const UnitVector3& c) noexcept
    : a_(a), b_(b), c_(c), alpha_(corner_angle(a, b, c)), cos_c_(dot(a, b)) {
    area_ = std::max(0.0, alpha_ + corner_angle(b, c, a) + corner_angle(c, a, b) - pi);
}

UnitVector3 SphericalTriangle::sample(double u, double v) const noexcept {
    const double sin_alpha = std::sin(alpha_);
    const double cos_alpha = std::cos(alpha_);
    const double s = std::sin(u * area_ - alpha_);
    const double t = std::cos(u * area_ - alpha_);
    const double big_u = t - cos_alpha;
    const double big_w = s + sin_alpha * cos_c_;
    const double divisor = (big_w * s + big_u * t) * sin_alpha;
    const double ratio =
        ((big_w * t - big_u * s) * cos_alpha - big_w) / divisor; // m of METHODS eq. (38)
    const double q = divisor != 0.0 ? std::clamp(ratio, -1.0, 1.0) : 1.0;
    const Vector3 c = q * a_ + unit_sine(q) * perpendicular_part(c_, a_);
    const double z = 1.0 - v * (1.0 - dot(c, b_));
    return UnitVector3(z * b_ + unit_sine(z) * perpendicular_part(c, b_));
}

double solid_angle(std::span<const Point3> vertices, const Point3& seen_from) noexcept {
    double sum = 0.0;
    for (std::size_t k = 2; k < vertices.size(); ++k) {
        const Vector3 a = vertices[0] - seen_from;
        const Vector3 b = vertices[k - 1] - seen_from;
        const Vector3 c = vertices[k] - seen_from;
        const double la = length(a);
        const double lb = length(b);
        const double lc = length(c);
        const double triple = dot(a, cross(b, c));
        const double rest = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        if (triple != 0.0)
            sum += 2.0 * std::atan2(std::abs(triple), rest);
    }
    return sum;
}

DiscreteSample sample_cumulative(std::span<const double> cumulative, double u) noexcept {
    return sample_between(cumulative, 0, cumulative.size(), u);
}

CumulativeTable::CumulativeTable(std::vector<double> sums) : sums_(std::move(sums)) {
    const std::size_t steps = std::bit_ceil(sums_.size());
    for (std::size_t k = 0; k <= steps; ++k)
        start_.push_back(static_cast<std::uint32_t>(
            sample_cumulative(sums_, static_cast<double>(k) / static_cast<double>(steps))
                .index));
}

DiscreteSample CumulativeTable::sample(double u) const noexcept {
    const auto k = static_cast<std::size_t>(u * static_cast<double>(start_.size() - 1));
    return sample_between(sums_, start_[k], start_[k + 1] + std::size_t{1}, u);
}

} // namespace isolux
