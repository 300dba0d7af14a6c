#include "isolux/viz/map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "isolux/viz/colour_scale.h"
#include "isolux/viz/contours.h"
#include "isolux/viz/label_layout.h"
#include "isolux/viz/map_page.h"
#include "isolux/viz/map_text.h"
#include "isolux/viz/plan_symbols.h"
#include "isolux/viz/surface_view.h"

namespace isolux {

namespace {

constexpr double value_size = 2.3;      // mm
constexpr double contour_size = 2.3;    // mm
constexpr double finest_detail = 0.015; // mm, a tenth of the thinnest line

/// Breaks and colours of one map, and which colour a value has.
struct Scale {
    std::vector<double> breaks;
    std::vector<Colour> colours;

    [[nodiscard]] const Colour& colour_of(double value) const {
        const auto above = std::upper_bound(breaks.begin(), breaks.end(), value);
        return colours[static_cast<std::size_t>(above - breaks.begin())];
    }
};

/// One isolux value's lines on the page.
struct IsoluxLine {
    double level = 0.0;
    std::vector<Polyline> lines;
};

struct Range {
    double minimum = 0.0;
    double maximum = 0.0;
    std::size_t darkest = 0; ///< point
    std::size_t brightest = 0;
};

Range find_range(const std::vector<PointResult>& points) {
    Range r;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (points[p].total.mean < points[r.darkest].total.mean)
            r.darkest = p;
        if (points[p].total.mean > points[r.brightest].total.mean)
            r.brightest = p;
    }
    if (!points.empty()) {
        r.minimum = points[r.darkest].total.mean;
        r.maximum = points[r.brightest].total.mean;
    }
    return r;
}

Scale make_scale(const SurfaceResult& result, const Range& range, double confidence) {
    Scale scale;
    scale.breaks =
        choose_breaks(range.minimum, range.maximum, typical_half_width(result, confidence));
    scale.colours = band_colours(scale.breaks.size() + 1);
    return scale;
}

ColourLegend make_legend(const Scale& scale, const Range& range) {
    ColourLegend legend{"lx", scale.colours, {}, format_lux(range.minimum), ""};
    for (const double b : scale.breaks)
        legend.breaks.push_back(format_break(b));
    if (!scale.breaks.empty())
        legend.highest = format_lux(range.maximum);
    return legend;
}

const Stroke object_line{ink::grey, 0.18, 0.0};
const Stroke room_line{ink::black, 0.6, 0.0};
const Stroke surface_line{ink::black, 0.25, 0.0};
const LuminaireStyle luminaire_style{{{60, 60, 60}, 0.2, 0.0}, {}, Direction::tick};
const Stroke isolux_line{ink::black, 0.15, 0.0};

/// One surface on its page.
class MapPainter {
public:
    MapPainter(const SurfaceResult& result, const Plan& plan, const MapNotes& notes)
        : result_(result), view_(make_surface_view(result.surface)),
          visible_(select_visible(plan, result.surface, view_)),
          range_(find_range(result.points)),
          scale_(make_scale(result, range_, notes.confidence)),
          page_(describe_result(result, notes),
                map_extent(surface_extent(result.surface, view_), visible_),
                axis_names(),
                make_legend(scale_, range_),
                entries()) {}

    Drawing paint() && {
        page_.open_clip(frame_);
        draw_faces(page_, visible_.objects, ink::furniture);
        std::vector<IsoluxLine> lines;
        if (result_.surface.grid)
            lines = paint_bands(*result_.surface.grid);
        draw_lines(page_, visible_.objects, object_line);
        draw_lines(page_, visible_.rooms, room_line);
        for (const PlanLuminaire& l : visible_.luminaires)
            draw_luminaire(page_, l, luminaire_style);
        if (result_.surface.grid)
            paint_values(*result_.surface.grid, lines);
        else
            paint_points();
        page_.close_clip();
        return std::move(page_).finish();
    }

private:
    [[nodiscard]] std::array<std::string, 2> axis_names() const {
        return view_.is_plan ? std::array<std::string, 2>{"x", "y"}
                             : std::array<std::string, 2>{"u", "v"};
    }

    [[nodiscard]] bool are_points() const {
        return std::all_of(visible_.luminaires.begin(),
                           visible_.luminaires.end(),
                           [](const PlanLuminaire& l) { return l.body.empty(); });
    }

    [[nodiscard]] std::vector<LegendEntry> entries() const {
        std::vector<LegendEntry> list;
        if (!visible_.luminaires.empty())
            list.push_back(
                luminaire_entry(luminaire_style, are_points(), "luminaire, mark: C0"));
        if (!visible_.objects.empty())
            list.push_back(area_entry(ink::furniture, object_line, "object"));
        if (!visible_.rooms.empty())
            list.push_back(line_entry(room_line, "room"));
        if (result_.surface.grid && range_.maximum > range_.minimum)
            list.push_back({{}, "▼ lowest, ▲ highest"});
        return list;
    }

    /// The surface's border on the page: its outline, else its cells.
    [[nodiscard]] std::vector<Polyline> border(const CellField& field,
                                               const GridLayout& grid) const {
        std::vector<Polyline> loops;
        if (result_.surface.outline.size() >= 3) {
            loops.emplace_back();
            for (const Point3& p : result_.surface.outline)
                loops.back().push_back(page_.to_page(view_.project(p)));
        } else {
            loops = page_.to_page(view_.project(outline_of_cells(field), grid));
            for (Polyline& loop : loops)
                loop = simplify(loop, finest_detail);
        }
        return loops;
    }

    /// Cells that lie inside the outline at least in part.
    [[nodiscard]] std::vector<bool> cells_inside(const GridLayout& grid) const {
        constexpr int samples = 5; // each way
        std::vector<Polyline> loop(1);
        for (const Point3& p : result_.surface.outline) {
            const Vector3 local = grid.frame.point_to_local(p);
            loop.front().push_back({local.x, local.y});
        }
        const double du = grid.width / static_cast<double>(grid.counts.columns);
        const double dv = grid.height / static_cast<double>(grid.counts.rows);
        std::vector<bool> inside;
        for (std::size_t row = 0; row < grid.counts.rows; ++row)
            for (std::size_t column = 0; column < grid.counts.columns; ++column) {
                bool found = false;
                for (int k = 0; k < samples * samples && !found; ++k)
                    found = is_inside(
                        loop,
                        {du * (static_cast<double>(column) + (k % samples + 0.5) / samples),
                         dv * (static_cast<double>(row) + (k / samples + 0.5) / samples)});
                inside.push_back(found);
            }
        return inside;
    }

    /// Paints the bands, each over the darker ones, and the isolux lines. Returns the lines.
    std::vector<IsoluxLine> paint_bands(const GridLayout& grid) {
        std::vector<double> values;
        for (const PointResult& p : result_.points)
            values.push_back(p.total.mean);
        CellField field = make_cell_field(grid, values);
        border_ = border(field, grid);
        if (result_.surface.outline.size() >= 3)
            field = fill_cells(std::move(field), cells_inside(grid));
        page_.open_clip(border_);
        Shape ground;
        ground.lines = border_;
        ground.fill = scale_.colours.front();
        page_.add(std::move(ground));
        std::vector<IsoluxLine> lines;
        const std::vector<Contour> contours = make_contours(field, scale_.breaks);
        for (std::size_t k = 0; k < contours.size(); ++k) {
            Shape region;
            region.lines = on_paper(contours[k].region, grid);
            region.fill = scale_.colours[k + 1];
            page_.add(std::move(region));
            lines.push_back({contours[k].level, on_paper(contours[k].lines, grid)});
        }
        for (const IsoluxLine& isolux : lines) {
            Shape s;
            s.lines = isolux.lines;
            s.ends = Ends::open;
            s.stroke = isolux_line;
            page_.add(std::move(s));
        }
        page_.close_clip();
        Shape outline;
        outline.lines = border_;
        outline.stroke = surface_line;
        page_.add(std::move(outline));
        return lines;
    }

    [[nodiscard]] std::vector<Polyline> on_paper(const std::vector<Polyline>& grid_lines,
                                                 const GridLayout& grid) const {
        std::vector<Polyline> lines = page_.to_page(view_.project(grid_lines, grid));
        for (Polyline& line : lines)
            line = simplify(line, finest_detail);
        return lines;
    }

    void paint_values(const GridLayout& grid, const std::vector<IsoluxLine>& lines) {
        LabelLayout layout;
        if (range_.maximum > range_.minimum) {
            place_extreme(layout, range_.darkest, "▼");
            place_extreme(layout, range_.brightest, "▲");
        }
        label_lines(layout, lines);
        const GridCounts n = grid.counts;
        const GridCounts step = thinning(grid);
        const auto is_chosen = [](std::size_t at, std::size_t count, std::size_t every) {
            return at % every == ((count - 1) % every) / 2;
        };
        for (std::size_t p = 0; p < result_.points.size(); ++p)
            if (is_chosen(grid.cell_of_point[p] % n.columns, n.columns, step.columns)
                && is_chosen(grid.cell_of_point[p] / n.columns, n.rows, step.rows))
                place_value(layout, p);
    }

    /// Every how many points a value is written; where not all fit, so many fewer that lines
    /// stay visible between them.
    [[nodiscard]] GridCounts thinning(const GridLayout& grid) const {
        const double widest =
            page_.ruler().width(format_lux(range_.maximum), value_size, Weight::normal);
        const auto every = [&](double side, std::size_t count, double tight, double loose) {
            const double pitch = page_.mm_per_metre() * side / static_cast<double>(count);
            return pitch > tight ? 1 : static_cast<std::size_t>(std::ceil(loose / pitch));
        };
        return {every(grid.width, grid.counts.columns, 1.3 * widest, 2.2 * widest),
                every(grid.height, grid.counts.rows, 1.5 * value_size, 3.0 * value_size)};
    }

    [[nodiscard]] Text value_text(std::size_t point, const std::string& mark) const {
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

    /// The value on its point, where it fits.
    void place_value(LabelLayout& layout, std::size_t point) {
        Text t = value_text(point, "");
        const Point2 at = place_of(point);
        const double width = page_.ruler().width(t.text, t.size, t.weight);
        if (!layout.place({at, width + 0.8, value_size, 0.0}, border_))
            return;
        t.at = {at.x, at.y + 0.5 * cap_height * value_size};
        page_.add(std::move(t));
    }

    /// The lowest or highest value, always: beside its point where that is near the border.
    void place_extreme(LabelLayout& layout, std::size_t point, const std::string& mark) {
        Text t = value_text(point, mark);
        const double width = page_.ruler().width(t.text, t.size, t.weight) + 0.8;
        Point2 at = place_of(point);
        const double shift = 0.5 * width;
        bool is_placed = false;
        for (const double aside : {0.0, shift, -shift, 2.0 * shift, -2.0 * shift}) {
            is_placed = layout.place({{at.x + aside, at.y}, width, value_size, 0.0}, border_);
            if (is_placed) {
                at.x += aside;
                break;
            }
        }
        if (!is_placed && !layout.place({at, width, value_size, 0.0}, frame_))
            return;
        t.at = {at.x, at.y + 0.5 * cap_height * value_size};
        page_.add(std::move(t));
    }

    [[nodiscard]] Point2 place_of(std::size_t point) const {
        return page_.to_page(view_.project(result_.surface.receivers[point].point));
    }

    void label_lines(LabelLayout& layout, const std::vector<IsoluxLine>& lines) {
        constexpr double one_label_for = 130.0; // mm of line
        for (const IsoluxLine& isolux : lines)
            for (const Polyline& line : isolux.lines) {
                const auto labels =
                    1 + static_cast<std::size_t>(length_of(line) / one_label_for);
                for (const Polyline& piece : divide(line, labels))
                    label_line(layout, isolux.level, piece);
            }
    }

    void label_line(LabelLayout& layout, double level, const Polyline& line) {
        Text t;
        t.text = format_break(level);
        t.size = contour_size;
        t.anchor = Anchor::middle;
        t.weight = Weight::bold;
        t.colour = ink::black;
        t.halo = scale_.colour_of(level);
        const double width = page_.ruler().width(t.text, t.size, t.weight);
        const auto box = place_on_line(layout, line, width + 0.8, contour_size, border_);
        if (!box)
            return;
        const double down = 0.5 * cap_height * contour_size;
        const double turn = box->turn * std::numbers::pi / 180.0;
        t.turn = box->turn;
        t.at = {box->centre.x + down * std::sin(turn), box->centre.y + down * std::cos(turn)};
        page_.add(std::move(t));
    }

    /// Single points: a coloured dot each, the value above or below it where there is room.
    void paint_points() {
        constexpr double radius = 1.3; // mm
        LabelLayout layout;
        for (std::size_t p = 0; p < result_.points.size(); ++p) {
            const Point2 at = place_of(p);
            Shape dot;
            dot.lines = {circle(at, radius)};
            dot.fill = scale_.colour_of(result_.points[p].total.mean);
            dot.stroke = Stroke{ink::black, 0.2};
            page_.add(std::move(dot));
            (void)layout.place({at, 2.0 * radius, 2.0 * radius, 0.0}, frame_);
        }
        for (std::size_t p = 0; p < result_.points.size(); ++p) {
            const Point2 at = place_of(p);
            Text t = value_text(p, "");
            t.halo = ink::white;
            const double width = page_.ruler().width(t.text, t.size, t.weight);
            for (const double side : {-1.0, 1.0}) {
                const double y = at.y + side * (radius + 0.3 + 0.5 * value_size);
                if (!layout.place({{at.x, y}, width, value_size, 0.0}, frame_))
                    continue;
                t.at = {at.x, y + 0.5 * cap_height * value_size};
                page_.add(std::move(t));
                break;
            }
        }
    }

    const SurfaceResult& result_;
    SurfaceView view_;
    Plan visible_;
    Range range_;
    Scale scale_;
    MapPage page_;
    std::vector<Polyline> frame_{page_.frame()};
    std::vector<Polyline> border_;
};

} // namespace

Drawing draw_map(const SurfaceResult& result, const Plan& plan, const MapNotes& notes) {
    return MapPainter(result, plan, notes).paint();
}

void write_map(const std::filesystem::path& stem,
               const SurfaceResult& result,
               const Plan& plan,
               const MapNotes& notes) {
    write_drawing(stem, draw_map(result, plan, notes));
}

} // namespace isolux
