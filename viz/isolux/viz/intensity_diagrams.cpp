#include "isolux/viz/intensity_diagrams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "isolux/viz/colour_scale.h"

namespace isolux {

namespace {

constexpr double text_size = 2.5; // mm
constexpr double radian = std::numbers::pi / 180.0;

/// A half of space is dark if it holds less than this share of the largest intensity.
constexpr double dark = 0.004;

const Stroke grid_line{ink::light_grey, 0.14, 0.0};
const Stroke axis_line{ink::grey, 0.2, 0.0};

struct Reach {
    double largest = 0.0; ///< cd
    bool is_lit_below = false;
    bool is_lit_above = false;
};

Reach reach_of(const PolarCurves& curves) {
    Reach r;
    for (const IntensityCurve& c : curves)
        for (const double value : c.candela)
            r.largest = std::max(r.largest, value);
    for (const IntensityCurve& c : curves)
        for (std::size_t k = 0; k < c.gamma.size(); ++k) {
            if (c.candela[k] <= dark * r.largest)
                continue;
            r.is_lit_below |= c.gamma[k] < 90.0;
            r.is_lit_above |= c.gamma[k] > 90.0;
        }
    if (!r.is_lit_above)
        r.is_lit_below = true;
    return r;
}

/// Equal steps of 1, 2, 2.5 or 5 that cover `largest` in about `count` of them.
double step_for(double largest, double count) {
    const double rough = largest / count;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 2.5, 5.0})
        if (factor * decade >= rough * (1.0 - 1e-9))
            return factor * decade;
    return 10.0 * decade;
}

Text label(std::string text, Point2 at, Anchor anchor = Anchor::middle) {
    Text t = make_text(std::move(text), at, text_size, anchor);
    t.halo = ink::white;
    return t;
}

/// Half-planes in the order they are painted, each with its side (+1 right) and stroke.
struct Branch {
    std::size_t curve;
    double side;
    Stroke stroke;
};

constexpr std::array<Branch, 4> branches{Branch{0, 1.0, c0_stroke},
                                         Branch{2, -1.0, c0_stroke},
                                         Branch{1, 1.0, c90_stroke},
                                         Branch{3, -1.0, c90_stroke}};

/// Geometry of a polar diagram on paper.
struct PolarFrame {
    Point2 centre;
    double radius = 0.0; ///< mm, of the outermost ring
    double first = 0.0;  ///< degrees of gamma that are shown
    double last = 180.0;

    [[nodiscard]] Point2 at(double share, double gamma, double side) const {
        const double r = share * radius;
        return {centre.x + side * r * std::sin(gamma * radian),
                centre.y + r * std::cos(gamma * radian)};
    }
};

PolarFrame fit(const Box& box, const Reach& reach) {
    constexpr double rim = 6.0; // mm for the angles around
    PolarFrame f;
    const bool is_half = reach.is_lit_below != reach.is_lit_above;
    f.first = reach.is_lit_below ? 0.0 : 90.0;
    f.last = reach.is_lit_above ? 180.0 : 90.0;
    const double width = 0.5 * box.width - rim - 2.0;
    const double height = is_half ? box.height - 2.0 * rim : 0.5 * box.height - rim;
    f.radius = std::max(1.0, std::min(width, height));
    f.centre = {box.x + 0.5 * box.width, box.y + 0.5 * box.height};
    if (is_half)
        f.centre.y += reach.is_lit_below ? -0.5 * f.radius : 0.5 * f.radius;
    return f;
}

/// From side to side through nadir, or through the zenith where only the upper half is shown.
Polyline arc(const PolarFrame& f, double share) {
    const double from = f.first == 0.0 ? -f.last : f.first;
    const double to = f.first == 0.0 ? f.last : 360.0 - f.first;
    Polyline line;
    for (double g = from; g <= to + 1e-9; g += 2.0)
        line.push_back(f.at(share, g, 1.0));
    return line;
}

void draw_polar_grid(Drawing& page, const PolarFrame& f, int rings) {
    for (int k = 1; k <= rings; ++k)
        page.items.emplace_back(make_line(arc(f, static_cast<double>(k) / rings),
                                          k == rings ? axis_line : grid_line));
    for (double g = f.first; g <= f.last; g += 15.0) {
        const bool is_main = std::fmod(g, 90.0) == 0.0;
        for (const double side : {1.0, -1.0}) {
            const bool is_axis = g == 0.0 || g == 180.0;
            if (is_axis && side < 0.0)
                continue;
            page.items.emplace_back(
                make_line({f.at(is_main ? 0.0 : 1.0 / rings, g, side), f.at(1.0, g, side)},
                          is_main ? axis_line : grid_line));
            if (std::fmod(g, 30.0) != 0.0)
                continue;
            Point2 at = f.at(1.0 + 3.2 / f.radius, g, side);
            at.y += 0.5 * cap_height * text_size;
            const double lean = std::sin(g * radian);
            at.x += side * 1.2 * lean;
            page.items.emplace_back(label(fmt::format("{:.0f}°", g), at));
        }
    }
}

} // namespace

void draw_polar(Drawing& page,
                const Box& box,
                const PolarCurves& curves,
                const IntensityScale& scale) {
    const Reach reach = reach_of(curves);
    const PolarFrame f = fit(box, reach);
    if (!(reach.largest > 0.0)) {
        draw_polar_grid(page, f, 4);
        page.items.emplace_back(label("no light in these planes", f.centre));
        return;
    }
    const double step = step_for(reach.largest * scale.per_candela, 4.5);
    const int rings = std::max(
        1, static_cast<int>(std::ceil(reach.largest * scale.per_candela / step - 1e-9)));
    const double rim = rings * step / scale.per_candela; // cd
    draw_polar_grid(page, f, rings);
    for (const Branch& b : branches) {
        const IntensityCurve& curve = curves[b.curve];
        Polyline line;
        for (std::size_t k = 0; k < curve.gamma.size(); ++k)
            if (curve.gamma[k] >= f.first - 1e-9 && curve.gamma[k] <= f.last + 1e-9)
                line.push_back(f.at(curve.candela[k] / rim, curve.gamma[k], b.side));
        page.items.emplace_back(make_line(std::move(line), b.stroke));
    }
    const double axis = reach.is_lit_below ? 0.0 : 180.0;
    for (int k = 1; k <= rings; ++k) {
        Point2 at = f.at(static_cast<double>(k) / rings, axis, 1.0);
        at.x += 0.8;
        at.y += reach.is_lit_below ? -0.7 : 0.7 + cap_height * text_size;
        page.items.emplace_back(label(format_break(k * step), at, Anchor::start));
    }
}

namespace {

/// Axes of the Cartesian diagram.
struct CartesianFrame {
    Box plot;
    double first = -90.0; ///< degrees at the left
    double last = 90.0;
    double top = 1.0; ///< in the scale's unit

    [[nodiscard]] Point2 at(double angle, double value) const {
        return {plot.x + plot.width * (angle - first) / (last - first),
                plot.bottom() - plot.height * value / top};
    }
};

void draw_cartesian_grid(Drawing& page,
                         const CartesianFrame& f,
                         double step,
                         const std::string& unit) {
    const double each = f.last - f.first > 200.0 ? 30.0 : 15.0;
    for (double a = f.first; a <= f.last + 1e-9; a += each) {
        page.items.emplace_back(
            make_line({f.at(a, 0.0), f.at(a, f.top)}, a == 0.0 ? axis_line : grid_line));
        if (std::fmod(std::abs(a), 2.0 * each) != 0.0)
            continue;
        Point2 at = f.at(a, 0.0);
        at.y += 3.6;
        page.items.emplace_back(label(fmt::format("{:.0f}°", std::abs(a)), at));
    }
    for (double v = 0.0; v <= f.top * (1.0 + 1e-9); v += step) {
        page.items.emplace_back(
            make_line({f.at(f.first, v), f.at(f.last, v)}, v == 0.0 ? axis_line : grid_line));
        Point2 at = f.at(f.first, v);
        at.x -= 1.2;
        at.y += 0.5 * cap_height * text_size;
        page.items.emplace_back(label(v == 0.0 ? "0" : format_break(v), at, Anchor::end));
    }
    page.items.emplace_back(label(unit, {f.plot.x - 1.2, f.plot.y - 3.0}, Anchor::end));
    const double words = f.plot.bottom() + 7.4;
    page.items.emplace_back(label("C180, C270", {f.plot.x, words}, Anchor::start));
    page.items.emplace_back(label("gamma", {f.at(0.0, 0.0).x, words}));
    page.items.emplace_back(label("C0, C90", {f.plot.right(), words}, Anchor::end));
}

} // namespace

void draw_cartesian(Drawing& page,
                    const Box& box,
                    const PolarCurves& curves,
                    const IntensityScale& scale) {
    const Reach reach = reach_of(curves);
    CartesianFrame f;
    f.plot = {box.x + 13.0, box.y + 5.0, box.width - 16.0, box.height - 14.0};
    const double span = reach.is_lit_above ? 180.0 : 90.0;
    f.first = -span;
    f.last = span;
    const double largest = reach.largest * scale.per_candela;
    const double step = largest > 0.0 ? step_for(largest, 4.5) : 1.0;
    f.top = largest > 0.0 ? step * std::ceil(largest / step - 1e-9) : 4.0;
    draw_cartesian_grid(page, f, step, scale.unit);
    for (const Branch& b : branches) {
        const IntensityCurve& curve = curves[b.curve];
        Polyline line;
        for (std::size_t k = 0; k < curve.gamma.size() && curve.gamma[k] <= span + 1e-9; ++k)
            line.push_back(f.at(b.side * curve.gamma[k], curve.candela[k] * scale.per_candela));
        page.items.emplace_back(make_line(std::move(line), b.stroke));
    }
}

Drawing make_polar_picture(const PolarCurves& curves, const std::string& title, double size) {
    Drawing picture{size, size, title, {}};
    draw_polar(picture, {0.0, 0.0, size, size}, curves, {});
    return picture;
}

} // namespace isolux
