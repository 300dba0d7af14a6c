#pragma once

#include <span>
#include <vector>

#include "isolux/scene/room.h"

/// Plane geometry of footprints: small polygons, a few hundred corners at most.
namespace isolux {

struct Rectangle2 {
    Point2 lower;
    Point2 upper;

    [[nodiscard]] double width() const noexcept { return upper.x - lower.x; }

    [[nodiscard]] double depth() const noexcept { return upper.y - lower.y; }
};

[[nodiscard]] Rectangle2 bounding_rectangle(std::span<const Point2> outline) noexcept;
[[nodiscard]] double distance(const Point2& a, const Point2& b) noexcept;
/// Even-odd rule; on the border either answer.
[[nodiscard]] bool is_inside(const Point2& p, std::span<const Point2> outline) noexcept;
/// From a point to the nearest place on the border.
[[nodiscard]] double distance_to_border(const Point2& p,
                                        std::span<const Point2> outline) noexcept;
/// Between two borders; 0 where they cross or touch.
[[nodiscard]] double border_distance(std::span<const Point2> a,
                                     std::span<const Point2> b) noexcept;
/// Whether two simple polygons share more than a border; what overlaps by less than 1 mm only
/// touches.
[[nodiscard]] bool do_overlap(const std::vector<Point2>& a, const std::vector<Point2>& b);
/// The polygon with every side moved inwards. Empty where the sides would change their order
/// or cross, as in narrow bays.
/// @pre counter-clockwise
[[nodiscard]] std::vector<Point2> make_inset(std::span<const Point2> outline, double by);
/// Regular polygon with the area of the circle, METHODS "Round outlines".
[[nodiscard]] std::vector<Point2>
make_round_outline(const Point2& centre, double diameter, std::size_t corners);

} // namespace isolux
