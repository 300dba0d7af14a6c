#include "isolux/photometry/stored_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

namespace isolux {

namespace {

/// Values this close, relative to the largest one, are one value: rounding of interpolation.
constexpr double same_value = 1e-12;

struct Circle {
    std::vector<double> planes; ///< [0, 360), ascending, 0 and the quarter planes included
    std::vector<std::vector<double>> candela;
};

/// Every plane the table has, and the four that symmetries refer to.
Circle make_circle(const IntensityDistribution& d) {
    std::vector<double> degrees_all;
    for (const Angle p : d.planes())
        degrees_all.push_back(rounded_degrees(p));
    for (const double quarter : {0.0, 90.0, 180.0, 270.0})
        degrees_all.push_back(quarter);
    const auto all = expand_planes(degrees_all, PlaneSymmetry::none);
    Circle circle;
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        const auto& p = all[i];
        std::vector<double> plane;
        for (std::size_t g = 0; g < d.gammas().size(); ++g)
            plane.push_back(p.stored < d.planes().size()
                                ? d.at(p.stored, g).value()
                                : d.evaluate(degrees(p.degrees), d.gammas()[g]).value());
        circle.planes.push_back(p.degrees);
        circle.candela.push_back(std::move(plane));
    }
    return circle;
}

std::size_t find_plane(const Circle& circle, double c) {
    const double reduced = c - 360.0 * std::floor(c / 360.0);
    for (std::size_t i = 0; i < circle.planes.size(); ++i)
        if (is_same_angle(circle.planes[i], reduced)
            || is_same_angle(circle.planes[i] + 360.0, reduced))
            return i;
    return circle.planes.size();
}

bool is_mirrored(const Circle& circle, double twice_the_axis, double largest) {
    for (std::size_t i = 0; i < circle.planes.size(); ++i) {
        const std::size_t image = find_plane(circle, twice_the_axis - circle.planes[i]);
        if (image == circle.planes.size())
            return false;
        if (!std::ranges::equal(
                circle.candela[i], circle.candela[image], [largest](double a, double b) {
                    return std::abs(a - b) <= same_value * largest;
                }))
            return false;
    }
    return true;
}

bool is_rotational(const Circle& circle, double largest) {
    return std::ranges::all_of(circle.candela, [&](const std::vector<double>& plane) {
        return std::ranges::equal(plane, circle.candela.front(), [largest](double a, double b) {
            return std::abs(a - b) <= same_value * largest;
        });
    });
}

PlaneSymmetry find_symmetry(const Circle& circle, double largest) {
    if (is_rotational(circle, largest))
        return PlaneSymmetry::rotational;
    const bool about_0_180 = is_mirrored(circle, 360.0, largest);
    const bool about_90_270 = is_mirrored(circle, 180.0, largest);
    if (about_0_180 && about_90_270)
        return PlaneSymmetry::quadrant;
    if (about_0_180)
        return PlaneSymmetry::bilateral_0_180;
    return about_90_270 ? PlaneSymmetry::bilateral_90_270 : PlaneSymmetry::none;
}

bool is_stored(double c, PlaneSymmetry symmetry) {
    switch (symmetry) {
    case PlaneSymmetry::rotational:
        return c == 0.0;
    case PlaneSymmetry::quadrant:
        return c <= 90.0;
    case PlaneSymmetry::bilateral_0_180:
        return c <= 180.0;
    case PlaneSymmetry::bilateral_90_270:
        return c >= 90.0 && c <= 270.0;
    case PlaneSymmetry::none:
        break;
    }
    return true;
}

/// Quarter planes that were only added to look for symmetries, and are not needed.
void drop_unneeded(Circle& circle, const IntensityDistribution& d, PlaneSymmetry symmetry) {
    const auto is_needed = [&](double c) {
        if (c == 0.0)
            return true;
        if (std::ranges::any_of(d.planes(), [c](Angle p) {
                const double own = rounded_degrees(p);
                return is_same_angle(own - 360.0 * std::floor(own / 360.0), c);
            }))
            return symmetry != PlaneSymmetry::rotational;
        // about 90-270, 180 is the mirror image of 0
        return symmetry == PlaneSymmetry::quadrant
               || symmetry == PlaneSymmetry::bilateral_90_270
               || (symmetry == PlaneSymmetry::bilateral_0_180 && c == 180.0);
    };
    for (std::size_t i = circle.planes.size(); i-- > 0;)
        if (!is_needed(circle.planes[i])) {
            circle.planes.erase(circle.planes.begin() + static_cast<std::ptrdiff_t>(i));
            circle.candela.erase(circle.candela.begin() + static_cast<std::ptrdiff_t>(i));
        }
}

} // namespace

double rounded_degrees(Angle angle) noexcept {
    return std::round(angle.in_degrees() * 1e6) / 1e6;
}

bool is_full_circle(const IntensityDistribution& d) noexcept {
    return is_same_angle((d.planes().back() - d.planes().front()).in_degrees(), 360.0);
}

StoredTable make_stored_table(const IntensityDistribution& d) {
    Circle circle = make_circle(d);
    StoredTable table;
    table.symmetry = find_symmetry(circle, d.max_intensity().value());
    drop_unneeded(circle, d, table.symmetry);
    table.circle = circle.planes;
    for (const Angle g : d.gammas())
        table.gammas.push_back(rounded_degrees(g));
    for (std::size_t i = 0; i < circle.planes.size(); ++i) {
        if (!is_stored(circle.planes[i], table.symmetry))
            continue;
        table.planes.push_back(circle.planes[i]);
        table.candela.insert(
            table.candela.end(), circle.candela[i].begin(), circle.candela[i].end());
    }
    return table;
}

IntensityDistribution
resample(const IntensityDistribution& d, double plane_step, double gamma_step) {
    std::vector<Angle> planes;
    std::vector<Angle> gammas;
    for (int i = 0; i * plane_step <= 360.0; ++i)
        planes.push_back(degrees(i * plane_step));
    for (int i = 0; i * gamma_step <= 180.0; ++i)
        gammas.push_back(degrees(i * gamma_step));
    std::vector<double> candela;
    for (const Angle p : planes)
        for (const Angle g : gammas) {
            const double s = std::sin(g.in_radians());
            candela.push_back(d.evaluate(UnitVector3({s * std::cos(p.in_radians()),
                                                      s * std::sin(p.in_radians()),
                                                      -std::cos(g.in_radians())}))
                                  .value());
        }
    std::copy_n(candela.begin(),
                gammas.size(),
                candela.end() - static_cast<std::ptrdiff_t>(gammas.size()));
    return {std::move(planes), std::move(gammas), std::move(candela)};
}

int decimals_for(double largest, int significant) noexcept {
    if (!(largest > 0.0))
        return 0;
    const int digits_before = static_cast<int>(std::floor(std::log10(largest))) + 1;
    return std::clamp(significant - digits_before, 0, 12);
}

std::string to_fixed(double value, int decimals) {
    std::array<char, 400> buffer{};
    const auto result = std::to_chars(buffer.data(),
                                      buffer.data() + buffer.size(),
                                      value,
                                      std::chars_format::fixed,
                                      decimals);
    std::string text(buffer.data(), result.ptr);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.')
            text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string one_line(std::string_view text) {
    std::string line(text);
    for (char& c : line)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            c = ' ';
    return line;
}

} // namespace isolux
