#include "isolux/photometry/intensity_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "isolux/base/arc_tangent.h"
#include "isolux/base/check.h"
#include "isolux/photometry/gamma_piece.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double two_pi = 2.0 * pi;
/// Angles closer than this are the same: far above rounding, far below any table's step.
constexpr double same_angle = 1e-9;

[[maybe_unused]] bool ascend(std::span<const Angle> nodes) {
    return std::ranges::adjacent_find(nodes, [](Angle a, Angle b) { return !(a < b); })
           == nodes.end();
}

} // namespace

IntensityDistribution::IntensityDistribution(std::vector<Angle> planes,
                                             std::vector<Angle> gammas,
                                             std::vector<double> candela,
                                             TablePole pole)
    : planes_(std::move(planes)), gammas_(std::move(gammas)), candela_(std::move(candela)),
      pole_(pole), plane_axis_(make_axis(planes_)), gamma_axis_(make_axis(gammas_)) {
    ISOLUX_EXPECT(planes_.size() >= 2 && gammas_.size() >= 2);
    ISOLUX_EXPECT(candela_.size() == planes_.size() * gammas_.size());
    ISOLUX_EXPECT(ascend(planes_) && ascend(gammas_));
    ISOLUX_EXPECT(plane_axis_.span <= two_pi + same_angle);
    ISOLUX_EXPECT(gammas_.front().in_radians() >= 0.0
                  && gammas_.back().in_radians() <= pi + same_angle);
    ISOLUX_EXPECT(std::ranges::all_of(candela_, [](double i) { return i >= 0.0; }));
    max_ = Candela(*std::ranges::max_element(candela_));
    is_full_circle_ = plane_axis_.span >= two_pi - same_angle;
    const auto first_plane = std::span(candela_).first(gammas_.size());
    is_rotational_ = is_full_circle_;
    for (std::size_t p = 1; p < planes_.size() && is_rotational_; ++p)
        is_rotational_ = std::ranges::equal(
            first_plane, std::span(candela_).subspan(p * gammas_.size(), gammas_.size()));
}

IntensityDistribution::Axis
IntensityDistribution::make_axis(std::span<const Angle> nodes) noexcept {
    Axis axis{nodes.front().in_radians(), (nodes.back() - nodes.front()).in_radians(), 0.0};
    const double intervals = static_cast<double>(nodes.size() - 1);
    const double step = axis.span / intervals;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double expected = axis.first + static_cast<double>(i) * step;
        if (std::abs(nodes[i].in_radians() - expected) > same_angle * step)
            return axis;
    }
    axis.intervals_per_rad = intervals / axis.span;
    return axis;
}

IntensityDistribution::Place IntensityDistribution::find_place(const Axis& axis,
                                                               std::span<const Angle> nodes,
                                                               double from_first) noexcept {
    const std::size_t last = nodes.size() - 2;
    if (axis.intervals_per_rad > 0.0) {
        const double position = from_first * axis.intervals_per_rad;
        const std::size_t i = std::min(static_cast<std::size_t>(position), last);
        return {i, std::min(position - static_cast<double>(i), 1.0)};
    }
    const double angle = axis.first + from_first;
    const auto inner = nodes.subspan(1, nodes.size() - 2);
    const auto above =
        std::upper_bound(inner.begin(), inner.end(), angle, [](double a, Angle b) {
            return a < b.in_radians();
        });
    const auto i = static_cast<std::size_t>(above - inner.begin());
    const double lower = nodes[i].in_radians();
    const double upper = nodes[i + 1].in_radians();
    return {i, std::clamp((angle - lower) / (upper - lower), 0.0, 1.0)};
}

double IntensityDistribution::interpolate(double azimuth, double polar) const noexcept {
    double along_gamma = polar - gamma_axis_.first;
    if (along_gamma < -same_angle || along_gamma > gamma_axis_.span + same_angle)
        return 0.0;
    along_gamma = std::clamp(along_gamma, 0.0, gamma_axis_.span);
    const Place g = find_place(gamma_axis_, gammas_, along_gamma);
    const auto at_gamma = [&](std::size_t plane) {
        const double* const row = candela_.data() + plane * gammas_.size() + g.interval;
        return row[0] + g.fraction * (row[1] - row[0]);
    };
    if (is_rotational_)
        return at_gamma(0);

    double along_planes = azimuth - plane_axis_.first;
    along_planes -= two_pi * std::floor(along_planes * (1.0 / two_pi));
    if (along_planes > plane_axis_.span) {
        if (is_full_circle_ || along_planes <= plane_axis_.span + same_angle)
            along_planes = plane_axis_.span;
        else if (along_planes >= two_pi - same_angle)
            along_planes = 0.0;
        else
            return 0.0;
    }
    const Place p = find_place(plane_axis_, planes_, along_planes);
    const double here = at_gamma(p.interval);
    return here + p.fraction * (at_gamma(p.interval + 1) - here);
}

Candela IntensityDistribution::evaluate(const UnitVector3& d) const noexcept {
    // The polar angle by its tangent: acos would lose half the digits near the pole.
    if (pole_ == TablePole::nadir) {
        const double polar = arc_tangent(std::sqrt(d.x() * d.x() + d.y() * d.y()), -d.z());
        const double azimuth = is_rotational_ ? 0.0 : arc_tangent(d.y(), d.x());
        return Candela(interpolate(azimuth, polar));
    }
    const double polar = arc_tangent(std::sqrt(d.x() * d.x() + d.z() * d.z()), d.y());
    return Candela(interpolate(arc_tangent(d.x(), -d.z()), polar));
}

Candela IntensityDistribution::evaluate(Angle plane, Angle gamma) const noexcept {
    return Candela(interpolate(plane.in_radians(), gamma.in_radians()));
}

Lumen IntensityDistribution::flux() const noexcept {
    double total = 0.0;
    for (std::size_t g = 0; g + 1 < gammas_.size(); ++g) {
        const GammaPiece piece =
            gamma_piece(sine_cosine(gammas_[g]), (gammas_[g + 1] - gammas_[g]).in_radians());
        double ring = 0.0;
        for (std::size_t p = 0; p + 1 < planes_.size(); ++p) {
            const double width = (planes_[p + 1] - planes_[p]).in_radians();
            const double lower = at(p, g).value() + at(p + 1, g).value();
            const double upper = at(p, g + 1).value() + at(p + 1, g + 1).value();
            ring += 0.5 * width * (lower * piece.s0 + upper * piece.s1);
        }
        total += ring;
    }
    return Lumen(total);
}

Lumen IntensityDistribution::flux_trapezoid() const noexcept {
    double total = 0.0;
    for (std::size_t g = 0; g + 1 < gammas_.size(); ++g) {
        const double zone =
            std::cos(gammas_[g].in_radians()) - std::cos(gammas_[g + 1].in_radians());
        for (std::size_t p = 0; p + 1 < planes_.size(); ++p) {
            const double width = (planes_[p + 1] - planes_[p]).in_radians();
            total += 0.25 * width * zone
                     * (at(p, g).value() + at(p + 1, g).value() + at(p, g + 1).value()
                        + at(p + 1, g + 1).value());
        }
    }
    return Lumen(total);
}

UnitVector3 IntensityDistribution::direction(Angle plane, Angle gamma) const noexcept {
    return direction(sine_cosine(plane), sine_cosine(gamma));
}

UnitVector3 IntensityDistribution::direction(const SineCosine& plane,
                                             const SineCosine& gamma) const noexcept {
    const double along = gamma.sine * plane.cosine;
    const double across = gamma.sine * plane.sine;
    return pole_ == TablePole::nadir ? UnitVector3::from_unit({along, across, -gamma.cosine})
                                     : UnitVector3::from_unit({across, gamma.cosine, -along});
}

} // namespace isolux
