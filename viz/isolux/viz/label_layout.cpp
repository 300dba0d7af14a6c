#include "isolux/viz/label_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace isolux {

namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

struct Axes {
    Point2 along;
    Point2 across;
};

Axes axes_of(const LabelBox& box) {
    const double a = box.turn / degrees_per_radian;
    // y runs down, so a counter-clockwise turn on paper lowers y.
    return {{std::cos(a), -std::sin(a)}, {std::sin(a), std::cos(a)}};
}

double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }

/// Half the box's shadow on a direction of length one.
double reach(const LabelBox& box, const Axes& axes, const Point2& direction) {
    return 0.5 * box.width * std::abs(dot(axes.along, direction))
           + 0.5 * box.height * std::abs(dot(axes.across, direction));
}

std::array<Point2, 4> corners_of(const LabelBox& box) {
    const Axes axes = axes_of(box);
    std::array<Point2, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const double u = (k == 0 || k == 3 ? -0.5 : 0.5) * box.width;
        const double v = (k < 2 ? -0.5 : 0.5) * box.height;
        corners[k] = {box.centre.x + u * axes.along.x + v * axes.across.x,
                      box.centre.y + u * axes.along.y + v * axes.across.y};
    }
    return corners;
}

/// Points at equal steps along a line.
std::vector<Point2> walk(const Polyline& line, double step) {
    std::vector<Point2> points;
    double carried = 0.0;
    for (std::size_t k = 1; k < line.size(); ++k) {
        const Point2& a = line[k - 1];
        const Point2& b = line[k];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        double at = carried;
        for (; at < length; at += step)
            points.push_back(
                {a.x + (b.x - a.x) * at / length, a.y + (b.y - a.y) * at / length});
        carried = at - length;
    }
    return points;
}

double distance_to_chord(const Point2& p, const Point2& a, const Point2& b) {
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double squared = dx * dx + dy * dy;
    double t = squared > 0.0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / squared : 0.0;
    t = std::clamp(t, 0.0, 1.0);
    return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

} // namespace

bool overlap(const LabelBox& a, const LabelBox& b) noexcept {
    const Point2 between{b.centre.x - a.centre.x, b.centre.y - a.centre.y};
    const Axes of_a = axes_of(a);
    const Axes of_b = axes_of(b);
    // Two convex shapes are apart if and only if the normal of one of their sides shows a gap.
    for (const Point2& axis : {of_a.along, of_a.across, of_b.along, of_b.across})
        if (std::abs(dot(between, axis)) >= reach(a, of_a, axis) + reach(b, of_b, axis))
            return false;
    return true;
}

bool is_inside(std::span<const Polyline> loops, const Point2& p) noexcept {
    bool inside = false;
    for (const Polyline& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const Point2& a = loop[k];
            const Point2& b = loop[(k + 1) % loop.size()];
            if ((a.y > p.y) != (b.y > p.y)
                && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
                inside = !inside;
        }
    return inside;
}

bool LabelLayout::is_free(const LabelBox& box,
                          std::span<const Polyline> within) const noexcept {
    for (const Point2& corner : corners_of(box))
        if (!is_inside(within, corner))
            return false;
    return std::none_of(
        boxes_.begin(), boxes_.end(), [&](const LabelBox& b) { return overlap(b, box); });
}

bool LabelLayout::place(const LabelBox& box, std::span<const Polyline> within) {
    if (!is_free(box, within))
        return false;
    boxes_.push_back(box);
    return true;
}

std::optional<LabelBox> place_on_line(LabelLayout& layout,
                                      const Polyline& line,
                                      double width,
                                      double height,
                                      std::span<const Polyline> within) {
    constexpr double step = 0.5;        // mm
    constexpr double shortest = 2.0;    // line length in label widths
    constexpr double straightest = 0.9; // chord / arc below this is a bend
    const std::vector<Point2> points = walk(line, step);
    const auto span = static_cast<std::size_t>(std::ceil(width / step));
    if (static_cast<double>(points.size()) < shortest * static_cast<double>(span))
        return std::nullopt;
    std::optional<LabelBox> best;
    double best_score = straightest;
    const double middle = 0.5 * static_cast<double>(points.size() - span);
    for (std::size_t k = 0; k + span < points.size(); ++k) {
        const Point2& a = points[k];
        const Point2& b = points[k + span];
        const double chord = std::hypot(b.x - a.x, b.y - a.y);
        // Of equally straight places the one nearest to the line's middle.
        const double off_middle = std::abs(static_cast<double>(k) - middle) / (middle + 1.0);
        const double score = chord / (step * static_cast<double>(span)) - 0.02 * off_middle;
        if (score <= best_score)
            continue;
        double turn = -std::atan2(b.y - a.y, b.x - a.x) * degrees_per_radian;
        if (turn > 90.0)
            turn -= 180.0;
        else if (turn <= -90.0)
            turn += 180.0;
        const LabelBox box{{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, width, height, turn};
        if (layout.is_free(box, within)) {
            best = box;
            best_score = score;
        }
    }
    if (best)
        (void)layout.place(*best, within);
    return best;
}

double length_of(const Polyline& line) noexcept {
    double length = 0.0;
    for (std::size_t k = 1; k < line.size(); ++k)
        length += std::hypot(line[k].x - line[k - 1].x, line[k].y - line[k - 1].y);
    return length;
}

std::vector<Polyline> divide(const Polyline& line, std::size_t parts) {
    const double wanted = length_of(line) / static_cast<double>(parts);
    std::vector<Polyline> pieces;
    double gone = 0.0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        if (k > 0)
            gone += std::hypot(line[k].x - line[k - 1].x, line[k].y - line[k - 1].y);
        const bool is_full = gone > wanted * static_cast<double>(pieces.size());
        if (pieces.empty() || (is_full && pieces.size() < parts)) {
            if (!pieces.empty())
                pieces.back().push_back(line[k]);
            pieces.emplace_back();
        }
        pieces.back().push_back(line[k]);
    }
    return pieces;
}

Polyline simplify(const Polyline& line, double tolerance) {
    if (line.size() < 3)
        return line;
    std::vector<char> keep(line.size(), 0);
    keep.front() = keep.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> stack{{0, line.size() - 1}};
    while (!stack.empty()) {
        const auto [first, last] = stack.back();
        stack.pop_back();
        double worst = tolerance;
        std::size_t farthest = first;
        for (std::size_t k = first + 1; k < last; ++k)
            if (const double d = distance_to_chord(line[k], line[first], line[last]);
                d > worst) {
                worst = d;
                farthest = k;
            }
        if (farthest == first)
            continue;
        keep[farthest] = 1;
        stack.emplace_back(first, farthest);
        stack.emplace_back(farthest, last);
    }
    Polyline kept;
    for (std::size_t k = 0; k < line.size(); ++k)
        if (keep[k] != 0)
            kept.push_back(line[k]);
    return kept;
}

} // namespace isolux
