#include "isolux/viz/colour_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace isolux {

namespace {

constexpr std::size_t fewest_breaks = 6;
constexpr std::size_t most_breaks = 12;

/// Nothing darker than this is worth a line, lx (starlight is 0.001 lx).
constexpr double darkest_break = 0.001;

std::vector<double>
series_between(std::span<const double> mantissas, double minimum, double maximum) {
    std::vector<double> breaks;
    const double first = std::max(minimum, darkest_break);
    const int low = static_cast<int>(std::floor(std::log10(first)));
    const int high = static_cast<int>(std::floor(std::log10(maximum)));
    for (int decade = low; decade <= high; ++decade)
        for (const double m : mantissas) {
            // Division keeps 0.1 the double that "0.1" reads as.
            const double b =
                decade < 0 ? m / std::pow(10.0, -decade) : m * std::pow(10.0, decade);
            if (b > minimum && b < maximum && b >= darkest_break)
                breaks.push_back(b);
        }
    return breaks;
}

std::vector<double> multiples_between(double step, double minimum, double maximum) {
    std::vector<double> breaks;
    for (double k = std::floor(minimum / step) + 1.0; k * step < maximum; k += 1.0)
        if (k * step > minimum)
            breaks.push_back(k * step);
    return breaks;
}

double smallest_gap(const std::vector<double>& breaks) {
    double gap = HUGE_VAL;
    for (std::size_t i = 1; i < breaks.size(); ++i)
        gap = std::min(gap, breaks[i] - breaks[i - 1]);
    return gap;
}

/// The largest step of 1, 2, 2.5, 5 x 10^k that gives `fewest_breaks`, but not below
/// `smallest_step`.
std::vector<double> equal_steps(double minimum, double maximum, double smallest_step) {
    constexpr std::array<double, 4> mantissas{5.0, 2.5, 2.0, 1.0};
    const double range = maximum - minimum;
    std::vector<double> breaks;
    const int top = static_cast<int>(std::ceil(std::log10(range)));
    for (int decade = top; decade > top - 4; --decade)
        for (const double m : mantissas) {
            const double step = m * std::pow(10.0, decade);
            if (step < smallest_step)
                return breaks;
            breaks = multiples_between(step, minimum, maximum);
            if (breaks.size() >= fewest_breaks)
                return breaks;
        }
    return breaks;
}

double linear_channel(std::uint8_t value) noexcept {
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double relative_luminance(const Colour& c) noexcept {
    return 0.2126 * linear_channel(c.r) + 0.7152 * linear_channel(c.g)
           + 0.0722 * linear_channel(c.b);
}

std::uint8_t mix(double a, double b, double t) {
    return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
}

} // namespace

std::vector<double> choose_breaks(double minimum, double maximum, double smallest_step) {
    constexpr std::array<double, 6> photometric{1.0, 1.5, 2.0, 3.0, 5.0, 7.5};
    constexpr std::array<double, 3> coarse{1.0, 2.0, 5.0};
    constexpr std::array<double, 1> decades{1.0};
    // Equal to rounding: a field without a slope has no lines.
    constexpr double flat = 1e-6;
    if (!(maximum > darkest_break) || !(maximum - minimum > flat * maximum))
        return {};
    for (const std::span<const double> series :
         {std::span<const double>(photometric), std::span<const double>(coarse)}) {
        std::vector<double> breaks = series_between(series, minimum, maximum);
        if (breaks.size() < fewest_breaks)
            break;
        if (breaks.size() <= most_breaks && smallest_gap(breaks) >= smallest_step)
            return breaks;
    }
    std::vector<double> breaks = series_between(decades, minimum, maximum);
    if (breaks.size() >= 4) // four decades and more: equal steps would hide the dark half
        return breaks;
    return equal_steps(minimum, maximum, smallest_step);
}

std::vector<Colour> band_colours(std::size_t bands) {
    // Ten equidistant samples of viridis.
    constexpr std::array<Colour, 10> viridis{Colour{68, 1, 84},
                                             {72, 40, 120},
                                             {62, 73, 137},
                                             {49, 104, 142},
                                             {38, 130, 142},
                                             {31, 158, 137},
                                             {53, 183, 121},
                                             {110, 206, 88},
                                             {181, 222, 43},
                                             {253, 231, 37}};
    constexpr double widest_step = 1.0 / 6.0;
    constexpr double lightening_of_darkest = 0.52;
    constexpr double lightening_of_lightest = 0.15;
    std::vector<Colour> colours;
    for (std::size_t i = 0; i < bands; ++i) {
        // Few bands lie close together on the scale: a small difference looks small.
        const double step =
            std::min(1.0 / std::max(static_cast<double>(bands) - 1.0, 1.0), widest_step);
        const double t =
            0.5 + step * (static_cast<double>(i) - 0.5 * (static_cast<double>(bands) - 1.0));
        const double place = t * static_cast<double>(viridis.size() - 1);
        const std::size_t k =
            std::min(static_cast<std::size_t>(std::max(place, 0.0)), viridis.size() - 2);
        const double f = place - static_cast<double>(k);
        const Colour& a = viridis[k];
        const Colour& b = viridis[k + 1];
        const Colour c{mix(a.r, b.r, f), mix(a.g, b.g, f), mix(a.b, b.b, f)};
        const double lightening =
            lightening_of_darkest + t * (lightening_of_lightest - lightening_of_darkest);
        colours.push_back({mix(c.r, 255.0, lightening),
                           mix(c.g, 255.0, lightening),
                           mix(c.b, 255.0, lightening)});
    }
    return colours;
}

double contrast_ratio(const Colour& a, const Colour& b) noexcept {
    const double la = relative_luminance(a);
    const double lb = relative_luminance(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

std::string format_lux(double value) {
    const double size = std::abs(value);
    if (size >= 9999.5)
        return fmt::format("{:.0f}", std::round(value / 100.0) * 100.0);
    const int decimals = size >= 99.95 ? 0 : (size >= 9.995 ? 1 : 2);
    return fmt::format("{:.{}f}", value, decimals);
}

std::string format_break(double value) { return fmt::format("{:.6g}", value); }

} // namespace isolux
