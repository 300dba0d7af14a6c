#include "isolux/viz/space_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace isolux {

SpaceView::SpaceView(const ViewAngles& angles, const Box& box)
    : box_(box), centre_{box.x + 0.5 * box.width, box.y + 0.5 * box.height} {
    constexpr double radian = std::numbers::pi / 180.0;
    const double a = angles.azimuth * radian;
    const double e = angles.elevation * radian;
    to_eye_ = UnitVector3::from_unit(
        {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)});
    right_ = UnitVector3::from_unit({-std::sin(a), std::cos(a), 0.0});
    up_ = UnitVector3(cross(to_eye_, right_));
}

void SpaceView::fit(const std::vector<SpacePiece>& pieces, double rim) {
    Extent e;
    for (const SpacePiece& p : pieces)
        for (const Point3& c : p.corners)
            e.include(flat(c));
    if (e.is_empty() || !(e.width() > 0.0) || !(e.height() > 0.0))
        return;
    scale_ =
        std::min((box_.width - 2.0 * rim) / e.width(), (box_.height - 2.0 * rim) / e.height());
    centre_ = {box_.x + 0.5 * box_.width - scale_ * 0.5 * (e.low.x + e.high.x),
               box_.y + 0.5 * box_.height + scale_ * 0.5 * (e.low.y + e.high.y)};
}

Point2 SpaceView::flat(const Point3& p) const {
    return {dot(p - Point3{}, right_), dot(p - Point3{}, up_)};
}

Point2 SpaceView::on_page(const Point3& p) const {
    const Point2 f = flat(p);
    return {centre_.x + scale_ * f.x, centre_.y - scale_ * f.y};
}

double SpaceView::depth(const SpacePiece& piece) const {
    double sum = 0.0;
    for (const Point3& c : piece.corners)
        sum += dot(c - Point3{}, to_eye_);
    return sum / static_cast<double>(piece.corners.size());
}

double SpaceView::light_on(const std::vector<Point3>& corners) const {
    Vector3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (corners.size() > 3) // a quadrilateral may have lost one of its triangles
        n = n + cross(corners[2] - corners[0], corners[3] - corners[0]);
    const double size = length(n);
    if (!(size > 0.0))
        return 1.0;
    const UnitVector3 lamp(Vector3(to_eye_) + 0.5 * Vector3(up_) - 0.3 * Vector3(right_));
    return 0.62 + 0.45 * std::abs(dot(n, lamp)) / size;
}

void SpaceView::paint(Drawing& page, std::vector<SpacePiece> pieces) const {
    std::stable_sort(pieces.begin(), pieces.end(), [&](const auto& a, const auto& b) {
        return depth(a) < depth(b);
    });
    for (const SpacePiece& p : pieces) {
        Shape s;
        s.lines.emplace_back();
        for (const Point3& c : p.corners)
            s.lines.front().push_back(on_page(c));
        s.ends = p.ends;
        if (p.ends == Ends::closed)
            s.fill = p.fill;
        s.stroke = p.stroke;
        s.opacity = p.opacity;
        page.items.emplace_back(std::move(s));
    }
}

Colour shade(const Colour& colour, double light) {
    const auto channel = [&](std::uint8_t v) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(v * light, 0.0, 255.0)));
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

} // namespace isolux
