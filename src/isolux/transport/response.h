#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/receiver.h"

/// What a receiver makes of light from a direction: R(w) of METHODS eq. (1) and its table.
namespace isolux {

/// Response of the receiver to luminance arriving from the unit direction `w` (pointing away
/// from the receiver). Integrated over the sphere every kind gives pi.
[[nodiscard]] inline double evaluate_response(const Receiver& receiver,
                                              const Vector3& w) noexcept {
    constexpr double pi = std::numbers::pi;
    const double cosine = dot(receiver.axis, w);
    switch (receiver.kind) {
    case IlluminanceKind::planar:
        return std::max(0.0, cosine);
    case IlluminanceKind::cylindrical:
        return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)) / pi;
    case IlluminanceKind::semi_cylindrical: {
        // sin(theta) (1 + cos(phi)) / pi, where sin(theta) cos(phi) is the component along the
        // horizontal reference direction.
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        const Vector3 flat = Vector3(receiver.reference)
                             - dot(receiver.reference, receiver.axis) * Vector3(receiver.axis);
        const double size = length(flat);
        const double along = size > 0.0 ? dot(flat, w) / size : 0.0;
        return std::max(0.0, sine + along) / pi;
    }
    case IlluminanceKind::hemispherical:
        return 0.25 * std::max(0.0, 1.0 + cosine);
    case IlluminanceKind::mean_spherical:
        return 0.25;
    }
    return 0.0;
}

/// Whether light can reach the receiver from its front side only.
[[nodiscard]] inline bool is_planar(const Receiver& receiver) noexcept {
    return receiver.kind == IlluminanceKind::planar;
}

/// A gather direction: cosine-weighted for a plane, uniform on the sphere for the other kinds.
[[nodiscard]] UnitVector3
sample_response(const Receiver& receiver, double u, double v) noexcept;

/// Density of sample_response, per steradian.
[[nodiscard]] inline double pdf_response(const Receiver& receiver, const Vector3& w) noexcept {
    constexpr double pi = std::numbers::pi;
    if (!is_planar(receiver))
        return 1.0 / (4.0 * pi);
    return std::max(0.0, dot(receiver.axis, w)) / pi;
}

} // namespace isolux
