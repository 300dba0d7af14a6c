#include "isolux/viz/map_values.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "isolux/viz/colour_scale.h"
#include "isolux/viz/plan_symbols.h"

namespace isolux {

namespace {

constexpr double value_size = 2.3;   // mm
constexpr double contour_size = 2.3; // mm
constexpr double air = 0.8;          // mm, left and right of a label together

Point2 baseline_of(const Point2& middle, double size) {
    return {middle.x, middle.y + 0.5 * cap_height * size};
}

} // namespace

void ValueWriter::write_on_bands(const PaintedBands& bands) {
    constexpr double one_label_for = 130.0; // mm of line
    if (!range_.is_flat()) {
        write_extreme(range_.darkest, "▼", bands.border);
        write_extreme(range_.brightest, "▲", bands.border);
    }
    for (const IsoluxLine& isolux : bands.lines)
        for (const Polyline& line : isolux.lines) {
            const auto labels = 1 + static_cast<std::size_t>(length_of(line) / one_label_for);
            for (const Polyline& piece : divide(line, labels))
                label_line(isolux.level, piece, bands.border);
        }
    const GridLayout& grid = *result_.surface.grid;
    const GridCounts n = grid.counts;
    const GridCounts step = thinning(grid);
    const auto is_chosen = [](std::size_t at, std::size_t count, std::size_t every) {
        return at % every == ((count - 1) % every) / 2;
    };
    for (std::size_t p = 0; p < result_.points.size(); ++p)
        if (is_chosen(grid.cell_of_point[p] % n.columns, n.columns, step.columns)
            && is_chosen(grid.cell_of_point[p] / n.columns, n.rows, step.rows))
            write_value(p, bands.border);
}

/// Every how many points a value is written; where not all fit, so many fewer that lines stay
/// visible between them.
GridCounts ValueWriter::thinning(const GridLayout& grid) const {
    const double widest =
        page_.ruler().width(format_lux(range_.maximum), value_size, Weight::normal);
    const auto every = [&](double side, std::size_t count, double tight, double loose) {
        const double pitch = page_.mm_per_metre() * side / static_cast<double>(count);
        return pitch > tight ? 1 : static_cast<std::size_t>(std::ceil(loose / pitch));
    };
    return {every(grid.width, grid.counts.columns, 1.3 * widest, 2.2 * widest),
            every(grid.height, grid.counts.rows, 1.5 * value_size, 3.0 * value_size)};
}

Text ValueWriter::value_text(std::size_t point, const std::string& mark) const {
    const double value = result_.points[point].total.mean;
    Text t;
    t.text = mark + format_lux(value);
    t.size = value_size;
    t.anchor = Anchor::middle;
    t.weight = mark.empty() ? Weight::normal : Weight::bold;
    t.colour = ink::black;
    t.halo = scale_.colour_of(value);
    return t;
}

void ValueWriter::write_value(std::size_t point, const std::vector<Polyline>& border) {
    Text t = value_text(point, "");
    const Point2 at = place_of(point);
    const double width = page_.ruler().width(t.text, t.size, t.weight) + air;
    if (!layout_.place({at, width, value_size, 0.0}, border))
        return;
    t.at = baseline_of(at, value_size);
    page_.add(std::move(t));
}

/// Always written: beside its point where that is near the border.
void ValueWriter::write_extreme(std::size_t point,
                                const std::string& mark,
                                const std::vector<Polyline>& border) {
    Text t = value_text(point, mark);
    const double width = page_.ruler().width(t.text, t.size, t.weight) + air;
    const Point2 at = place_of(point);
    const auto try_place = [&](const Point2& centre, const std::vector<Polyline>& within) {
        if (!layout_.place({centre, width, value_size, 0.0}, within))
            return false;
        t.at = baseline_of(centre, value_size);
        page_.add(t);
        return true;
    };
    for (const double up : {0.0, -0.5 * value_size, 0.5 * value_size})
        for (const double aside : {0.0, 0.5, -0.5, 1.0, -1.0})
            if (try_place({at.x + aside * width, at.y + up}, border))
                return;
    (void)try_place(at, frame_);
}

void ValueWriter::label_line(double level,
                             const Polyline& line,
                             const std::vector<Polyline>& border) {
    Text t;
    t.text = format_break(level);
    t.size = contour_size;
    t.anchor = Anchor::middle;
    t.weight = Weight::bold;
    t.colour = ink::black;
    t.halo = scale_.colour_of(level);
    const double width = page_.ruler().width(t.text, t.size, t.weight) + air;
    const auto box = place_on_line(layout_, line, width, contour_size, border);
    if (!box)
        return;
    const double down = 0.5 * cap_height * contour_size;
    const double turn = box->turn * std::numbers::pi / 180.0;
    t.turn = box->turn;
    t.at = {box->centre.x + down * std::sin(turn), box->centre.y + down * std::cos(turn)};
    page_.add(std::move(t));
}

Point2 ValueWriter::place_of(std::size_t point) const {
    return page_.to_page(view_.project(result_.surface.receivers[point].point));
}

void ValueWriter::write_dots() {
    constexpr double radius = 1.3; // mm
    for (std::size_t p = 0; p < result_.points.size(); ++p) {
        const Point2 at = place_of(p);
        Shape dot;
        dot.lines = {circle(at, radius)};
        dot.fill = scale_.colour_of(result_.points[p].total.mean);
        dot.stroke = Stroke{ink::black, 0.2};
        page_.add(std::move(dot));
        (void)layout_.place({at, 2.0 * radius, 2.0 * radius, 0.0}, frame_);
    }
    for (std::size_t p = 0; p < result_.points.size(); ++p) {
        const Point2 at = place_of(p);
        Text t = value_text(p, "");
        t.halo = ink::white;
        const double width = page_.ruler().width(t.text, t.size, t.weight);
        for (const double side : {-1.0, 1.0}) {
            const Point2 middle{at.x, at.y + side * (radius + 0.3 + 0.5 * value_size)};
            if (!layout_.place({middle, width, value_size, 0.0}, frame_))
                continue;
            t.at = baseline_of(middle, value_size);
            page_.add(std::move(t));
            break;
        }
    }
}

} // namespace isolux
