#pragma once

#include <optional>
#include <span>
#include <vector>

#include "isolux/viz/drawing.h"

namespace isolux {

/// A rectangle about its centre, turned counter-clockwise on a page whose y runs down. mm.
struct LabelBox {
    Point2 centre;
    double width = 0.0;
    double height = 0.0;
    double turn = 0.0; ///< degrees
};

[[nodiscard]] bool overlap(const LabelBox& a, const LabelBox& b) noexcept;

/// Even-odd test of a point against closed loops.
[[nodiscard]] bool is_inside(std::span<const Polyline> loops, const Point2& p) noexcept;

/// Gives room on paper to whoever asks first.
class LabelLayout {
public:
    /// True, and the room is taken, if `box` lies inside the closed loops `within` (even-odd)
    /// and meets no box placed before.
    bool place(const LabelBox& box, std::span<const Polyline> within);

    [[nodiscard]] bool is_free(const LabelBox& box,
                               std::span<const Polyline> within) const noexcept;

    [[nodiscard]] const std::vector<LabelBox>& boxes() const noexcept { return boxes_; }

private:
    std::vector<LabelBox> boxes_;
};

/// The straightest free place for a label on a line, text upright and along the line; nothing
/// if the line is too short or too curved everywhere. The room is taken.
std::optional<LabelBox> place_on_line(LabelLayout& layout,
                                      const Polyline& line,
                                      double width,
                                      double height,
                                      std::span<const Polyline> within);

/// The line cut into `parts` pieces of equal length.
[[nodiscard]] std::vector<Polyline> divide(const Polyline& line, std::size_t parts);

[[nodiscard]] double length_of(const Polyline& line) noexcept;

/// The line without the points that matter less than `tolerance` (Douglas and Peucker 1973).
[[nodiscard]] Polyline simplify(const Polyline& line, double tolerance);

} // namespace isolux
