#include <cmath>
#include <numbers>

#include "isolux/photometry/quantities.h"

namespace isolux {

namespace {

constexpr double quarter_pi = std::numbers::pi / 4.0;

/// Sides of a EULUMDAT box: each of the four has its own luminous height.
double side_area(const LuminairePhotometry& l, double x, double y, const UnitVector3& w) {
    const LuminousOpening& o = l.opening;
    double towards_x = o.extent_z.value();
    double towards_y = o.extent_z.value();
    if (l.side_heights) {
        towards_x = (*l.side_heights)[w.x() >= 0.0 ? 0 : 2].value();
        towards_y = (*l.side_heights)[w.y() >= 0.0 ? 1 : 3].value();
    }
    return y * towards_x * std::abs(w.x()) + x * towards_y * std::abs(w.y());
}

/// An elliptic cylinder with its axis along a: silhouette of the mantle and one end.
/// b, c: diameters along the other two axes; wa, wb, wc: the direction's components.
double cylinder_area(double length, double b, double c, double wa, double wb, double wc) {
    return length * std::hypot(b * wc, c * wb) + quarter_pi * b * c * std::abs(wa);
}

} // namespace

SquareMetre projected_luminous_area(const LuminairePhotometry& l, const UnitVector3& w) {
    const double x = l.opening.extent_x.value();
    const double y = l.opening.extent_y.value();
    const double z = l.opening.extent_z.value();
    switch (l.opening.shape) {
    case OpeningShape::point:
        break;
    case OpeningShape::rectangle:
        return SquareMetre(x * y * std::abs(w.z()));
    case OpeningShape::box:
        return SquareMetre(x * y * std::abs(w.z()) + side_area(l, x, y, w));
    case OpeningShape::ellipse:
        return SquareMetre(quarter_pi * x * y * std::abs(w.z()));
    case OpeningShape::vertical_cylinder:
        return SquareMetre(cylinder_area(z, x, y, w.z(), w.x(), w.y()));
    case OpeningShape::cylinder_along_x:
        return SquareMetre(cylinder_area(x, y, z, w.x(), w.y(), w.z()));
    case OpeningShape::cylinder_along_y:
        return SquareMetre(cylinder_area(y, z, x, w.y(), w.z(), w.x()));
    case OpeningShape::ellipsoid:
        return SquareMetre(quarter_pi
                           * std::hypot(y * z * w.x(), x * z * w.y(), x * y * w.z()));
    case OpeningShape::vertical_ellipse:
        return SquareMetre(quarter_pi * y * z * std::abs(w.x()));
    }
    return SquareMetre();
}

std::optional<CandelaPerSquareMetre>
mean_luminance(const LuminairePhotometry& l, Angle plane, Angle gamma) {
    const double s = std::sin(gamma.in_radians());
    const UnitVector3 w({s * std::cos(plane.in_radians()),
                         s * std::sin(plane.in_radians()),
                         -std::cos(gamma.in_radians())});
    const SquareMetre area = projected_luminous_area(l, w);
    constexpr double nothing_seen = 1e-12; // m2
    if (area.value() <= nothing_seen)
        return std::nullopt;
    return luminance_of(l.distribution.evaluate(w), area);
}

} // namespace isolux
