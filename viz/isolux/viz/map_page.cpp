#include "isolux/viz/map_page.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace isolux {

namespace {

// The page, mm.
constexpr double margin = 6.0;
constexpr double largest_map_height = 165.0;
constexpr double largest_scale = 100.0; ///< mm per metre, 1:10
constexpr double axis_space = 13.0;     ///< left of the frame
constexpr double below_frame = 10.0;    ///< tick labels and axis name
constexpr double panel_gap = 7.0;
constexpr double smallest_page_width = 176.0;
constexpr double flat_map_height = 88.0; ///< lower maps carry their legend below

constexpr double title_size = 4.6;
constexpr double figures_size = 3.3;
constexpr double small_size = 2.6;
constexpr double line_space = 1.55; ///< in text sizes

constexpr double swatch_width = 7.0;
constexpr double swatch_height = 5.2;
constexpr double widest_row_swatch = 13.0;
constexpr double entry_space = 5.2;
constexpr double symbol_width = 8.0;
constexpr double longest_scale_bar = 32.0;

double text_block_height(const PageText& text) {
    return line_space
           * (title_size + (text.figures.empty() ? 0.0 : figures_size)
              + small_size * static_cast<double>(text.remarks.size()));
}

Shape rectangle(double x, double y, double width, double height) {
    Shape s;
    s.lines = {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}};
    return s;
}

Shape line(const Point2& a, const Point2& b, double width, const Colour& colour = ink::black) {
    Shape s;
    s.lines = {{a, b}};
    s.ends = Ends::open;
    s.stroke = Stroke{colour, width};
    return s;
}

Text label(std::string text, Point2 at, double size, Anchor anchor = Anchor::start) {
    Text t;
    t.text = std::move(text);
    t.at = at;
    t.size = size;
    t.anchor = anchor;
    t.colour = ink::black;
    return t;
}

double height_of_panel(const ColourLegend& colours, const std::vector<LegendEntry>& entries) {
    const double of_colours =
        colours.colours.empty()
            ? 0.0
            : 12.0 + swatch_height * static_cast<double>(colours.colours.size());
    return of_colours + entry_space * static_cast<double>(entries.size()) + 14.0;
}

double text_offset(const LegendEntry& entry) {
    return entry.symbol.empty() ? 0.0 : symbol_width + 2.0;
}

/// A number beside the colour scale; `place` counts bands from the dark end.
struct ScaleNumber {
    double place = 0.0;
    std::string text;
    Colour colour;
};

std::vector<ScaleNumber> numbers_of(const ColourLegend& legend) {
    std::vector<ScaleNumber> numbers;
    for (std::size_t k = 0; k < legend.breaks.size(); ++k)
        numbers.push_back({static_cast<double>(k + 1), legend.breaks[k], ink::black});
    const double bands = static_cast<double>(legend.colours.size());
    // A field of one value has one number, at the middle of its one band.
    numbers.push_back({legend.highest.empty() ? 0.5 * bands : 0.0, legend.lowest, ink::grey});
    if (!legend.highest.empty())
        numbers.push_back({bands, legend.highest, ink::grey});
    return numbers;
}

struct Tick {
    double value = 0.0;
    std::string text; ///< with as many decimals as the step needs
};

std::vector<Tick> ticks(double low, double high, double mm_per_metre) {
    const double length = (high - low) * mm_per_metre;
    const double spacing = std::clamp(length / 3.0, 7.0, 13.0); // mm, at least
    const double step = nice_above(spacing / mm_per_metre);
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    std::vector<Tick> list;
    for (double k = std::ceil(low / step); k * step <= high; k += 1.0)
        list.push_back({k * step, fmt::format("{:.{}f}", k * step + 0.0, decimals)});
    return list;
}

} // namespace

void Extent::include(const Point2& p) noexcept {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
}

Extent Extent::grown(double by, double smallest) const noexcept {
    const double dx = std::max(by, 0.5 * (smallest - width()));
    const double dy = std::max(by, 0.5 * (smallest - height()));
    return {{low.x - dx, low.y - dy}, {high.x + dx, high.y + dy}};
}

double nice_below(double value) noexcept {
    const double decade = std::pow(10.0, std::floor(std::log10(value) + 1e-12));
    const double mantissa = value / decade;
    return decade * (mantissa >= 5.0 ? 5.0 : (mantissa >= 2.0 ? 2.0 : 1.0));
}

double nice_above(double value) noexcept {
    const double below = nice_below(value);
    if (below >= value * (1.0 - 1e-9))
        return below;
    return nice_below(2.6 * below);
}

std::string shorten(
    const std::string& text, double width, double size, Weight weight, const FontRuler& ruler) {
    if (ruler.width(text, size, weight) <= width)
        return text;
    std::string cut = printable(text);
    while (!cut.empty() && ruler.width(cut + "…", size, weight) > width) {
        while (!cut.empty() && (static_cast<unsigned char>(cut.back()) & 0xC0) == 0x80)
            cut.pop_back();
        if (!cut.empty())
            cut.pop_back();
    }
    return cut + "…";
}

MapPage::MapPage(const PageText& text,
                 const Extent& extent,
                 std::array<std::string, 2> axis_names,
                 const ColourLegend& colours,
                 const std::vector<LegendEntry>& entries)
    : extent_(extent), axis_names_(std::move(axis_names)) {
    scale_ = std::min({text.largest_width / extent.width(),
                       largest_map_height / extent.height(),
                       largest_scale});
    corner_ = {margin + axis_space, margin + text_block_height(text) + 3.0};
    const Point2 end = to_page({extent.high.x, extent.low.y});
    const double panel_height = height_of_panel(colours, entries);
    const bool is_flat = end.y - corner_.y < std::min(flat_map_height, panel_height);
    const double panel_width = is_flat ? 0.0 : panel_gap + width_of_panel(entries);
    drawing_.width = std::ceil(
        std::max({smallest_page_width, width_of(text), end.x + panel_width + margin}));
    drawing_.title = text.title;

    write_texts(text);
    write_axes();
    if (is_flat) {
        const Point2 colours_at{corner_.x, end.y + below_frame + 2.0};
        const double colours_end = write_colours_row(colours, colours_at);
        const double bar_end = write_scale_bar({corner_.x, colours_end + 6.0});
        const double bottom = write_entries(entries, {bar_end + 12.0, colours_end + 2.0}, true);
        drawing_.height = std::ceil(bottom + margin);
    } else {
        const double x = end.x + panel_gap;
        const double colours_end = write_colours_column(colours, {x, corner_.y});
        write_entries(entries, {x, colours_end + 2.0}, false);
        const double bottom = std::max(end.y, corner_.y + panel_height);
        write_scale_bar({x, bottom - 3.0});
        drawing_.height = std::ceil(std::max(end.y + below_frame, bottom) + margin);
    }
}

double MapPage::width_of(const PageText& text) const {
    double width = ruler_.width(text.figures, figures_size, Weight::normal);
    for (const std::string& remark : text.remarks)
        width = std::max(width, ruler_.width(remark, small_size, Weight::normal));
    return width + 2.0 * margin;
}

double MapPage::width_of_panel(const std::vector<LegendEntry>& entries) const {
    double width = longest_scale_bar + 6.0;
    for (const LegendEntry& e : entries)
        width = std::max(width, width_of(e));
    return width;
}

double MapPage::width_of(const LegendEntry& entry) const {
    return text_offset(entry) + ruler_.width(entry.text, small_size, Weight::normal);
}

Point2 MapPage::to_page(const Point2& p) const noexcept {
    return {corner_.x + scale_ * (p.x - extent_.low.x),
            corner_.y + scale_ * (extent_.high.y - p.y)};
}

std::vector<Polyline> MapPage::to_page(const std::vector<Polyline>& lines) const {
    std::vector<Polyline> result;
    for (const Polyline& line : lines) {
        result.emplace_back();
        for (const Point2& p : line)
            result.back().push_back(to_page(p));
    }
    return result;
}

Polyline MapPage::frame() const {
    return {to_page(extent_.low),
            to_page({extent_.high.x, extent_.low.y}),
            to_page(extent_.high),
            to_page({extent_.low.x, extent_.high.y})};
}

Drawing MapPage::finish() && {
    Shape border;
    border.lines = {frame()};
    border.stroke = Stroke{ink::grey, 0.15};
    add(std::move(border));
    return std::move(drawing_);
}

void MapPage::write_texts(const PageText& text) {
    const double room = drawing_.width - 2.0 * margin;
    double y = margin + title_size * cap_height;
    Text title = label(
        shorten(text.title, room, title_size, Weight::bold, ruler_), {margin, y}, title_size);
    title.weight = Weight::bold;
    const double used = ruler_.width(title.text, title_size, Weight::bold) + 4.0;
    add(std::move(title));
    if (!text.project.empty() && used + 20.0 < room) {
        Text project =
            label(shorten(text.project, room - used, figures_size, Weight::normal, ruler_),
                  {drawing_.width - margin, y},
                  figures_size,
                  Anchor::end);
        project.colour = ink::grey;
        add(std::move(project));
    }
    if (!text.figures.empty()) {
        y += line_space * 0.5 * (title_size + figures_size);
        add(label(text.figures, {margin, y}, figures_size));
    }
    for (const std::string& remark : text.remarks) {
        y += line_space * 0.5
             * (small_size + (&remark == text.remarks.data() ? figures_size : small_size));
        Text t = label(remark, {margin, y}, small_size);
        t.colour = ink::grey;
        add(std::move(t));
    }
}

void MapPage::write_axes() {
    constexpr double tick = 1.2;
    const Point2 low = to_page(extent_.low);
    const Point2 high = to_page(extent_.high);
    for (const auto& [value, text] : ticks(extent_.low.x, extent_.high.x, scale_)) {
        const double x = to_page({value, 0.0}).x;
        add(line({x, low.y}, {x, low.y + tick}, 0.15, ink::grey));
        add(label(text, {x, low.y + 4.2}, small_size, Anchor::middle));
    }
    for (const auto& [value, text] : ticks(extent_.low.y, extent_.high.y, scale_)) {
        const double y = to_page({0.0, value}).y;
        add(line({low.x - tick, y}, {low.x, y}, 0.15, ink::grey));
        add(label(text,
                  {low.x - tick - 0.8, y + 0.5 * cap_height * small_size},
                  small_size,
                  Anchor::end));
    }
    add(label(axis_names_[0] + " / m",
              {0.5 * (low.x + high.x), low.y + 8.0},
              small_size,
              Anchor::middle));
    Text vertical = label(axis_names_[1] + " / m",
                          {margin + 2.2, 0.5 * (low.y + high.y)},
                          small_size,
                          Anchor::middle);
    vertical.turn = 90.0;
    add(std::move(vertical));
}

double MapPage::write_colours_row(const ColourLegend& colours, Point2 at) {
    const std::size_t n = colours.colours.size();
    if (n == 0)
        return at.y;
    Text unit = label(colours.unit, {at.x - 2.0, at.y + 3.2}, small_size, Anchor::end);
    unit.weight = Weight::bold;
    add(std::move(unit));
    const double room = drawing_.width - margin - 4.0 - at.x;
    const double width = std::min(widest_row_swatch, room / static_cast<double>(n));
    const auto x = [&](double k) { return at.x + width * k; };
    for (std::size_t k = 0; k < n; ++k)
        write_swatch(x(static_cast<double>(k)), at.y, width, 4.5, colours.colours[k]);
    for (const ScaleNumber& number : numbers_of(colours)) {
        Text t = label(number.text, {x(number.place), at.y + 8.0}, small_size, Anchor::middle);
        t.colour = number.colour;
        add(std::move(t));
    }
    return at.y + 9.5;
}

double MapPage::write_colours_column(const ColourLegend& colours, Point2 at) {
    const std::size_t n = colours.colours.size();
    if (n == 0)
        return at.y;
    Text unit = label(colours.unit, {at.x, at.y + cap_height * small_size}, small_size);
    unit.weight = Weight::bold;
    add(std::move(unit));
    const double bottom = at.y + 6.0 + swatch_height * static_cast<double>(n);
    const auto y = [&](double k) { return bottom - swatch_height * k; };
    for (std::size_t k = 0; k < n; ++k)
        write_swatch(at.x,
                     y(static_cast<double>(k + 1)),
                     swatch_width,
                     swatch_height,
                     colours.colours[k]);
    for (const ScaleNumber& number : numbers_of(colours)) {
        const double middle = y(number.place) + 0.5 * cap_height * small_size;
        Text t = label(number.text, {at.x + swatch_width + 1.8, middle}, small_size);
        t.colour = number.colour;
        add(std::move(t));
    }
    return bottom + 4.0;
}

void MapPage::write_swatch(
    double x, double y, double width, double height, const Colour& colour) {
    Shape s = rectangle(x, y, width, height);
    s.fill = colour;
    s.stroke = Stroke{ink::black, 0.1};
    add(std::move(s));
}

double MapPage::write_entries(const std::vector<LegendEntry>& entries, Point2 at, bool is_row) {
    const double left = at.x;
    for (const LegendEntry& entry : entries) {
        if (is_row && at.x > left && at.x + width_of(entry) > drawing_.width - margin)
            at = {left, at.y + entry_space};
        const double middle = at.y + 0.5 * entry_space;
        for (Shape s : entry.symbol) {
            for (Polyline& l : s.lines)
                for (Point2& p : l)
                    p = {at.x + p.x, middle + p.y};
            add(std::move(s));
        }
        add(label(entry.text,
                  {at.x + text_offset(entry), middle + 0.5 * cap_height * small_size},
                  small_size));
        if (is_row)
            at.x += width_of(entry) + 6.0;
        else
            at.y += entry_space;
    }
    return is_row ? at.y + entry_space : at.y;
}

double MapPage::write_scale_bar(Point2 at) {
    const double metres = nice_below(longest_scale_bar / scale_);
    const double length = metres * scale_;
    for (int half = 0; half < 2; ++half) {
        Shape s = rectangle(at.x + 0.5 * half * length, at.y - 1.2, 0.5 * length, 1.2);
        s.fill = half == 0 ? ink::black : ink::white;
        s.stroke = Stroke{ink::black, 0.15};
        add(std::move(s));
    }
    add(label("0", {at.x, at.y - 2.2}, small_size, Anchor::middle));
    add(label(fmt::format("{:g} m", metres),
              {at.x + length, at.y - 2.2},
              small_size,
              Anchor::middle));
    return at.x + length;
}

} // namespace isolux
