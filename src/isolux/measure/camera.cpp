#include "isolux/measure/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isolux {

namespace {

/// A place of the unit disc, uniform; concentric squares become concentric circles (Shirley,
/// Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997).
std::array<double, 2> place_on_disc(double u, double v) noexcept {
    constexpr double quarter = std::numbers::pi / 4.0;
    const double a = 2.0 * u - 1.0;
    const double b = 2.0 * v - 1.0;
    if (a == 0.0 && b == 0.0)
        return {0.0, 0.0};
    const bool is_wide = std::abs(a) > std::abs(b);
    const double r = is_wide ? a : b;
    const double phi = is_wide ? quarter * (b / a) : 2.0 * quarter - quarter * (a / b);
    return {r * std::cos(phi), r * std::sin(phi)};
}

bool is_fisheye(Projection p) noexcept {
    return p != Projection::perspective && p != Projection::orthographic;
}

/// METHODS eq. (83), r in units of the focal length.
double radius_of(Projection p, double theta) noexcept {
    switch (p) {
    case Projection::equal_area:
        return 2.0 * std::sin(0.5 * theta);
    case Projection::stereographic:
        return 2.0 * std::tan(0.5 * theta);
    case Projection::perspective:
        return std::tan(theta);
    default:
        return theta;
    }
}

double angle_of(Projection p, double r) noexcept {
    switch (p) {
    case Projection::equal_area:
        return 2.0 * std::asin(std::min(1.0, 0.5 * r));
    case Projection::stereographic:
        return 2.0 * std::atan(0.5 * r);
    default:
        return r;
    }
}

UnitVector3 right_of(const UnitVector3& forward, const Vector3& up) noexcept {
    const Vector3 across = cross(forward, up);
    // Looking along "up", a plan has north at its top, and what looks along y has z there.
    if (length(across) > 1e-9 * length(up))
        return UnitVector3(across);
    const bool is_vertical = std::abs(forward.z()) > 0.5;
    return UnitVector3(cross(forward, is_vertical ? Vector3{0, 1, 0} : Vector3{0, 0, 1}));
}

} // namespace

CameraRays::CameraRays(const Camera& camera) noexcept
    : projection_(camera.projection), origin_(camera.position),
      forward_(camera.target - camera.position), right_(right_of(forward_, camera.up)),
      up_(UnitVector3(cross(right_, forward_))),
      centre_x_(0.5 * static_cast<double>(camera.columns)),
      centre_y_(0.5 * static_cast<double>(camera.rows)), scale_(1.0),
      lens_radius_(camera.projection == Projection::perspective ? camera.lens_radius : 0.0),
      focus_(camera.focus_distance > 0.0 ? camera.focus_distance
                                         : distance(camera.target, camera.position)) {
    const double half = 0.5 * camera.field_of_view.in_radians();
    if (is_fisheye(projection_)) {
        limit_ = half;
        scale_ = radius_of(projection_, half) / std::min(centre_x_, centre_y_);
    } else if (projection_ == Projection::orthographic) {
        scale_ = 0.5 * camera.width / centre_x_;
    } else {
        scale_ = std::tan(half) / centre_x_;
    }
}

std::optional<SightLine>
CameraRays::sight_line(double x, double y, double lens_u, double lens_v) const noexcept {
    const double a = (x - centre_x_) * scale_;
    const double b = (centre_y_ - y) * scale_;
    const Vector3 in_plane = a * Vector3(right_) + b * Vector3(up_);
    if (projection_ == Projection::orthographic)
        return SightLine{origin_ + in_plane, forward_};
    if (is_fisheye(projection_)) {
        const double r = std::sqrt(a * a + b * b);
        const double theta = angle_of(projection_, r);
        if (theta > limit_)
            return std::nullopt;
        if (r == 0.0)
            return SightLine{origin_, forward_};
        return SightLine{origin_,
                         UnitVector3(std::cos(theta) * Vector3(forward_)
                                     + (std::sin(theta) / r) * in_plane)};
    }
    const Vector3 through = Vector3(forward_) + in_plane;
    if (lens_radius_ <= 0.0)
        return SightLine{origin_, UnitVector3(through)};
    const auto [u, v] = place_on_disc(lens_u, lens_v);
    const Point3 eye = origin_ + lens_radius_ * (u * Vector3(right_) + v * Vector3(up_));
    return SightLine{eye, UnitVector3(origin_ + focus_ * through - eye)};
}

double CameraRays::lens_shift(double depth) const noexcept {
    if (lens_radius_ <= 0.0 || depth <= 0.0)
        return 0.0;
    return lens_radius_ / (focus_ * scale_) * (focus_ / depth - 1.0);
}

} // namespace isolux
