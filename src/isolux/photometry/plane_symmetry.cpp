#include "isolux/photometry/plane_symmetry.h"

#include <algorithm>
#include <cmath>

namespace isolux {

namespace {

/// Into [0, 360), multiples of 90 made exact.
double reduce(double degrees) noexcept {
    double d = degrees - 360.0 * std::floor(degrees / 360.0);
    if (const double nearest = 90.0 * std::round(d / 90.0);
        std::abs(d - nearest) < 0.5 * same_file_angle)
        d = nearest;
    return d >= 360.0 ? 0.0 : d;
}

std::vector<double> images(double c, PlaneSymmetry symmetry) {
    switch (symmetry) {
    case PlaneSymmetry::quadrant:
        return {c, 180.0 - c, 180.0 + c, 360.0 - c};
    case PlaneSymmetry::bilateral_0_180:
        return {c, 360.0 - c};
    case PlaneSymmetry::bilateral_90_270:
        return {c, 180.0 - c};
    case PlaneSymmetry::rotational:
    case PlaneSymmetry::none:
        break;
    }
    return {c};
}

} // namespace

std::string to_string(PlaneSymmetry symmetry) {
    switch (symmetry) {
    case PlaneSymmetry::none:
        return "none";
    case PlaneSymmetry::rotational:
        return "rotational";
    case PlaneSymmetry::quadrant:
        return "quadrant";
    case PlaneSymmetry::bilateral_0_180:
        return "bilateral 0-180";
    case PlaneSymmetry::bilateral_90_270:
        return "bilateral 90-270";
    }
    return "unknown";
}

bool is_same_angle(double a, double b) noexcept { return std::abs(a - b) < same_file_angle; }

std::vector<ExpandedPlane> expand_planes(std::span<const double> stored,
                                         PlaneSymmetry symmetry) {
    if (symmetry == PlaneSymmetry::rotational)
        return {{0.0, 0}, {360.0, 0}};
    std::vector<ExpandedPlane> planes;
    for (std::size_t i = 0; i < stored.size(); ++i)
        for (const double c : images(stored[i], symmetry))
            planes.push_back({reduce(c), i});
    std::ranges::sort(planes, {}, &ExpandedPlane::degrees);
    std::vector<ExpandedPlane> circle;
    for (const ExpandedPlane& p : planes)
        if (circle.empty() || !is_same_angle(circle.back().degrees, p.degrees))
            circle.push_back(p);
        else
            circle.back().stored = std::min(circle.back().stored, p.stored);
    circle.push_back({circle.front().degrees + 360.0, circle.front().stored});
    return circle;
}

std::vector<Angle> to_angles(std::span<const ExpandedPlane> planes) {
    std::vector<Angle> angles;
    angles.reserve(planes.size());
    for (const ExpandedPlane& p : planes)
        angles.push_back(degrees(p.degrees));
    return angles;
}

} // namespace isolux
