#include "isolux/viz/tone_mapping.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/viz/colour_scale.h"

namespace isolux {

namespace {

constexpr double key = 0.18;

/// Of the surfaces' luminances; the few brightest pixels may burn out.
constexpr double share_below_white = 0.995;

/// Compresses one luminance to 0..1.
double compress(double luminance, const Exposure& e) noexcept {
    const double l = key * luminance / e.middle;
    const double w = key * e.white / e.middle;
    return l * (1.0 + l / (w * w)) / (1.0 + l);
}

/// IEC 61966-2-1.
std::uint8_t to_srgb(double linear) noexcept {
    const double v = std::clamp(linear, 0.0, 1.0);
    const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * s));
}

} // namespace

Exposure choose_exposure(const ViewPicture& picture) {
    // Luminaires seen say nothing about how bright a room should look.
    std::vector<double> luminances;
    for (std::size_t i = 0; i < picture.size.pixels(); ++i) {
        const double y = picture.luminance(i);
        const double lamp = luminance_sum(picture.emission.colour(i));
        if (y > 0.0 && lamp < 0.05 * y)
            luminances.push_back(y);
    }
    if (luminances.empty())
        for (std::size_t i = 0; i < picture.size.pixels(); ++i)
            if (const double y = picture.luminance(i); y > 0.0)
                luminances.push_back(y);
    if (luminances.empty())
        return {};
    const auto at = luminances.begin()
                    + static_cast<std::ptrdiff_t>(share_below_white
                                                  * static_cast<double>(luminances.size() - 1));
    std::nth_element(luminances.begin(), at, luminances.end());
    const double bright = *at;
    double logs = 0.0;
    for (const double y : luminances)
        logs += std::log(std::max(y, 1e-4 * bright));
    Exposure e;
    e.middle = std::exp(logs / static_cast<double>(luminances.size()));
    // Not nearer to the middle than a bright wall is to it, lest every picture looks burnt.
    e.white = std::max(2.0 * bright, e.middle / key);
    return e;
}

std::string describe(const Exposure& exposure) {
    constexpr double iso = 100.0;
    constexpr double calibration = 12.5;
    return fmt::format("EV {:.1f} (middle grey {} cd/m2, white from {} cd/m2)",
                       std::log2(exposure.middle * iso / calibration),
                       format_lux(exposure.middle),
                       format_lux(exposure.white));
}

std::vector<std::uint8_t> tone_map(const Planes3& colours, const Exposure& exposure) {
    std::vector<std::uint8_t> bytes(3 * colours.x.size());
    for (std::size_t i = 0; i < colours.x.size(); ++i) {
        const Rgb c = colours.colour(i);
        const double y = luminance_sum(c);
        // The colour keeps its ratios; what is too bright for its channel fades to white.
        const double scale = y > 0.0 ? compress(y, exposure) / y : 0.0;
        Rgb shown = scale * c;
        if (const double most = max_channel(shown); most > 1.0) {
            const double grey = std::min(1.0, scale * y);
            const double t = most > grey ? (1.0 - grey) / (most - grey) : 0.0;
            shown = Rgb::grey(grey) + t * (shown - Rgb::grey(grey));
        }
        bytes[3 * i] = to_srgb(shown.r);
        bytes[3 * i + 1] = to_srgb(shown.g);
        bytes[3 * i + 2] = to_srgb(shown.b);
    }
    return bytes;
}

} // namespace isolux
