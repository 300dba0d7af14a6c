#include "isolux/viz/chart.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "isolux/viz/map_page.h"

namespace isolux {

namespace {

constexpr double page_width = 180.0; // mm
constexpr double frame_left = 22.0;
constexpr double frame_right = 176.0;
constexpr double frame_height = 62.0;
constexpr double between_frames = 22.0;
constexpr double line_height = 4.6;
constexpr double text_size = 2.8;
constexpr double mark = 0.9; // half the size of a mark

struct Axis {
    AxisScale scale = AxisScale::linear;
    double low = 0.0; // of the scaled value
    double high = 1.0;
    double from = 0.0; // mm
    double to = 1.0;

    [[nodiscard]] bool takes(double v) const noexcept {
        return std::isfinite(v) && (scale == AxisScale::linear || v > 0.0);
    }

    [[nodiscard]] double scaled(double v) const noexcept {
        return scale == AxisScale::linear ? v : std::log10(v);
    }

    [[nodiscard]] double at(double v) const noexcept {
        if (!takes(v))
            return v > 0.0 ? to : from;
        return from + (scaled(v) - low) / (high - low) * (to - from);
    }
};

struct Tick {
    double value;
    std::string text;
};

std::string number(double v) { return v == 0.0 ? "0" : fmt::format("{:.4g}", v); }

std::vector<Tick> ticks_of(const Axis& axis) {
    std::vector<Tick> ticks;
    if (axis.scale == AxisScale::logarithmic) {
        const bool is_short = axis.high - axis.low < 2.5;
        for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade)
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double v = digit * std::pow(10.0, decade);
                const double s = std::log10(v);
                if (s < axis.low - 1e-9 || s > axis.high + 1e-9 || (digit > 1.0 && !is_short))
                    continue;
                ticks.push_back({v, number(v)});
            }
        return ticks;
    }
    const double step = nice_above((axis.high - axis.low) / 6.0);
    for (double v = std::ceil(axis.low / step - 1e-9) * step; v <= axis.high + 1e-9 * step;
         v += step)
        ticks.push_back({v, number(std::abs(v) < 1e-9 * step ? 0.0 : v)});
    return ticks;
}

/// Range of the values, grown to whole ticks.
Axis make_axis(AxisScale scale, std::vector<double> values, double from, double to) {
    Axis axis{scale, 0.0, 1.0, from, to};
    std::erase_if(values, [&](double v) { return !axis.takes(v); });
    if (values.empty())
        return axis;
    const auto [low, high] = std::ranges::minmax(values);
    axis.low = axis.scaled(low);
    axis.high = axis.scaled(high);
    const double span = std::max(axis.high - axis.low, 1e-9 + 1e-6 * std::abs(axis.high));
    axis.low -= 0.04 * span;
    axis.high += 0.04 * span;
    return axis;
}

void add_line(Drawing& d, Polyline line, const Stroke& stroke) {
    d.items.emplace_back(Shape{{std::move(line)}, Ends::open, std::nullopt, stroke});
}

void add_text(Drawing& d,
              const std::string& text,
              const Point2& at,
              Anchor anchor,
              double size = text_size,
              Weight weight = Weight::normal,
              double turn = 0.0) {
    d.items.emplace_back(Text{text, at, size, anchor, weight, turn, ink::black, std::nullopt});
}

Polyline box(double left, double top, double right, double bottom) {
    return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

void draw_axes(Drawing& d, const Chart& chart, const Axis& x, const Axis& y) {
    for (const Tick& t : ticks_of(x)) {
        const double at = x.at(t.value);
        add_line(d, {{at, y.from}, {at, y.to}}, {ink::light_grey, 0.1});
        add_text(d, t.text, {at, y.from + 3.8}, Anchor::middle);
    }
    for (const Tick& t : ticks_of(y)) {
        const double at = y.at(t.value);
        add_line(d, {{x.from, at}, {x.to, at}}, {ink::light_grey, 0.1});
        add_text(d, t.text, {x.from - 1.4, at + 0.36 * text_size}, Anchor::end);
    }
    d.items.emplace_back(Shape{{box(x.from, y.to, x.to, y.from)},
                               Ends::closed,
                               std::nullopt,
                               Stroke{ink::black, 0.25}});
    add_text(d, chart.x_name, {0.5 * (x.from + x.to), y.from + 8.4}, Anchor::middle);
    add_text(d,
             chart.y_name,
             {5.0, 0.5 * (y.from + y.to)},
             Anchor::middle,
             text_size,
             Weight::normal,
             90.0);
    add_text(d, chart.title, {x.from, y.to - 1.6}, Anchor::start, 3.0, Weight::bold);
}

void draw_series(Drawing& d, const ChartSeries& s, const Axis& x, const Axis& y) {
    Polyline line;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        const Point2& p = s.points[i];
        if (!x.takes(p.x) || !y.takes(p.y))
            continue;
        const Point2 at{x.at(p.x), y.at(p.y)};
        if (s.look == SeriesLook::line) {
            line.push_back(at);
            continue;
        }
        if (i < s.half_widths.size()) {
            const double top = y.at(p.y + s.half_widths[i]);
            const double bottom = y.at(p.y - s.half_widths[i]);
            const Stroke thin{s.colour, 0.25};
            add_line(d, {{at.x, bottom}, {at.x, top}}, thin);
            add_line(d, {{at.x - mark, bottom}, {at.x + mark, bottom}}, thin);
            add_line(d, {{at.x - mark, top}, {at.x + mark, top}}, thin);
        }
        d.items.emplace_back(Shape{{box(at.x - mark, at.y - mark, at.x + mark, at.y + mark)},
                                   Ends::closed,
                                   s.colour,
                                   std::nullopt});
    }
    if (line.size() > 1)
        add_line(d, std::move(line), {s.colour, 0.35});
}

void draw_chart(Drawing& d, const Chart& chart, double top) {
    std::vector<double> xs;
    std::vector<double> ys;
    for (const ChartSeries& s : chart.series)
        for (std::size_t i = 0; i < s.points.size(); ++i) {
            xs.push_back(s.points[i].x);
            ys.push_back(s.points[i].y);
            if (i < s.half_widths.size()) {
                ys.push_back(s.points[i].y + s.half_widths[i]);
                ys.push_back(s.points[i].y - s.half_widths[i]);
            }
        }
    const Axis x = make_axis(chart.x_scale, std::move(xs), frame_left, frame_right);
    const Axis y = make_axis(chart.y_scale, std::move(ys), top + frame_height, top);
    draw_axes(d, chart, x, y);
    d.items.emplace_back(Clip{{box(x.from, y.to, x.to, y.from)}});
    for (const ChartSeries& s : chart.series)
        draw_series(d, s, x, y);
    d.items.emplace_back(EndClip{});
}

/// Names of all charts, each once, in columns. @return mm used
double draw_legend(Drawing& d, std::span<const Chart> charts, double top) {
    std::vector<const ChartSeries*> entries;
    for (const Chart& chart : charts)
        for (const ChartSeries& s : chart.series)
            if (std::ranges::none_of(entries, [&](const auto* e) { return e->name == s.name; }))
                entries.push_back(&s);
    const FontRuler ruler;
    double widest = 0.0;
    for (const ChartSeries* s : entries)
        widest = std::max(widest, ruler.width(s->name, text_size, Weight::normal));
    const double column = widest + 12.0;
    const auto columns = static_cast<std::size_t>(
        std::max(1.0, std::floor((frame_right - frame_left) / column)));
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double x = frame_left + column * static_cast<double>(i % columns);
        const double y = top + line_height * static_cast<double>(i / columns);
        ChartSeries sample = *entries[i];
        if (sample.look == SeriesLook::line)
            add_line(d, {{x, y}, {x + 6.0, y}}, {sample.colour, 0.35});
        else
            d.items.emplace_back(Shape{{box(x + 3 - mark, y - mark, x + 3 + mark, y + mark)},
                                       Ends::closed,
                                       sample.colour,
                                       std::nullopt});
        add_text(d, sample.name, {x + 7.5, y + 0.36 * text_size}, Anchor::start);
    }
    return line_height * static_cast<double>((entries.size() + columns - 1) / columns);
}

} // namespace

Colour series_colour(std::size_t i) noexcept {
    constexpr std::array<Colour, 8> colours{{{0, 114, 178},
                                             {230, 159, 0},
                                             {0, 158, 115},
                                             {204, 121, 167},
                                             {213, 94, 0},
                                             {86, 180, 233},
                                             {120, 94, 60},
                                             {90, 90, 90}}};
    return colours[i % colours.size()];
}

Drawing draw_charts(const std::string& title,
                    const std::vector<std::string>& remarks,
                    std::span<const Chart> charts) {
    Drawing d;
    d.width = page_width;
    d.title = title;
    double y = 9.0;
    d.items.emplace_back(); // the paper, once its height is known
    add_text(d, title, {frame_left, y}, Anchor::start, 4.2, Weight::bold);
    y += 5.6;
    for (const std::string& remark : remarks) {
        add_text(d, remark, {frame_left, y}, Anchor::start);
        y += line_height;
    }
    y += 2.0;
    y += draw_legend(d, charts, y) + 6.0;
    for (const Chart& chart : charts) {
        draw_chart(d, chart, y);
        y += frame_height + between_frames;
    }
    d.height = y - between_frames + 13.0;
    d.items.front() =
        Shape{{box(0, 0, d.width, d.height)}, Ends::closed, ink::white, std::nullopt};
    return d;
}

} // namespace isolux
