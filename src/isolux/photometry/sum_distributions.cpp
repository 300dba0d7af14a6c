#include "isolux/photometry/sum_distributions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "isolux/base/check.h"
#include "isolux/photometry/plane_symmetry.h"
#include "isolux/photometry/stored_table.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
/// Nodes no reader would tell apart are one, rad: what is summed can be written and read again.
constexpr double same_node = same_file_angle * pi / 180.0;
/// How far beyond its last gamma a table that stops there is known to be dark, rad.
constexpr double just_beyond = 2.0 * same_node;

void keep_distinct(std::vector<double>& nodes) {
    std::ranges::sort(nodes);
    std::vector<double> distinct;
    for (const double n : nodes)
        if (distinct.empty() || n - distinct.back() > same_node)
            distinct.push_back(n);
    nodes = std::move(distinct);
}

std::vector<Angle> to_angles(const std::vector<double>& in_radians) {
    std::vector<Angle> angles;
    for (const double a : in_radians)
        angles.push_back(radians(a));
    return angles;
}

/// Azimuths in [0, 2 pi], closed.
std::vector<double> common_planes(std::span<const IntensityDistribution> all) {
    std::vector<double> planes{0.0};
    for (const IntensityDistribution& d : all)
        for (const Angle p : d.planes()) {
            const double turned =
                p.in_radians() - 2.0 * pi * std::floor(p.in_radians() / (2.0 * pi));
            if (turned < 2.0 * pi - same_node)
                planes.push_back(turned);
        }
    keep_distinct(planes);
    planes.push_back(2.0 * pi);
    return planes;
}

std::vector<double> common_gammas(std::span<const IntensityDistribution> all) {
    double first = pi;
    double last = 0.0;
    for (const IntensityDistribution& d : all) {
        first = std::min(first, d.gammas().front().in_radians());
        last = std::max(last, d.gammas().back().in_radians());
    }
    std::vector<double> gammas;
    for (const IntensityDistribution& d : all) {
        for (const Angle g : d.gammas())
            gammas.push_back(g.in_radians());
        if (d.gammas().front().in_radians() > first + same_node)
            gammas.push_back(d.gammas().front().in_radians() - just_beyond);
        if (d.gammas().back().in_radians() < last - same_node)
            gammas.push_back(d.gammas().back().in_radians() + just_beyond);
    }
    keep_distinct(gammas);
    return gammas;
}

} // namespace

IntensityDistribution sum_distributions(std::span<const IntensityDistribution> distributions) {
    ISOLUX_EXPECT(!distributions.empty());
    if (distributions.size() == 1)
        return distributions.front();
    std::vector<IntensityDistribution> all;
    for (const IntensityDistribution& d : distributions)
        all.push_back(
            d.pole() == TablePole::nadir && is_full_circle(d) ? d : resample(d, 2.5, 1.0));
    const std::vector<Angle> planes = to_angles(common_planes(all));
    const std::vector<Angle> gammas = to_angles(common_gammas(all));
    std::vector<double> candela;
    candela.reserve(planes.size() * gammas.size());
    for (const Angle p : planes)
        for (const Angle g : gammas) {
            double sum = 0.0;
            for (const IntensityDistribution& d : all)
                sum += d.evaluate(p, g).value();
            candela.push_back(sum);
        }
    return {planes, gammas, std::move(candela)};
}

} // namespace isolux
