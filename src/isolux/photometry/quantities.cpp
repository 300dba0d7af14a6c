#include "isolux/photometry/quantities.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

UnitVector3 towards(double c, double gamma) noexcept {
    const double s = std::sin(gamma);
    return UnitVector3::from_unit({s * std::cos(c), s * std::sin(c), -std::cos(gamma)});
}

/// Nodes from `lower` to `upper`: both ends and what the table has between them.
std::vector<double> nodes_between(std::span<const Angle> table, double lower, double upper) {
    std::vector<double> nodes{lower};
    for (const Angle a : table)
        if (a.in_radians() > lower + 1e-12 && a.in_radians() < upper - 1e-12)
            nodes.push_back(a.in_radians());
    nodes.push_back(upper);
    return nodes;
}

/// Rule T over a sector; the table's own nodes where its poles are those of gamma, a fine grid
/// where they are not.
double trapezoid_flux(const IntensityDistribution& d,
                      const std::vector<double>& planes,
                      const std::vector<double>& gammas) {
    std::vector<double> previous;
    double sum = 0.0;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        std::vector<double> column;
        column.reserve(gammas.size());
        for (const double g : gammas)
            column.push_back(d.pole() == TablePole::nadir
                                 ? d.evaluate(radians(planes[p]), radians(g)).value()
                                 : d.evaluate(towards(planes[p], g)).value());
        for (std::size_t g = 0; p > 0 && g + 1 < gammas.size(); ++g)
            sum += 0.25 * (planes[p] - planes[p - 1])
                   * (std::cos(gammas[g]) - std::cos(gammas[g + 1]))
                   * (previous[g] + previous[g + 1] + column[g] + column[g + 1]);
        previous = std::move(column);
    }
    return sum;
}

std::vector<double> fine_grid(double lower, double upper) {
    constexpr double step = pi / 360.0;
    const int intervals = std::max(1, static_cast<int>(std::ceil((upper - lower) / step)));
    std::vector<double> nodes;
    for (int i = 0; i <= intervals; ++i)
        nodes.push_back(lower + (upper - lower) * i / intervals);
    return nodes;
}

} // namespace

Lumen flux_in_sector(
    const IntensityDistribution& d, Angle lower, Angle upper, Angle middle, Angle half_width) {
    const double from = (middle - half_width).in_radians();
    const double to = (middle + half_width).in_radians();
    if (d.pole() == TablePole::lateral)
        return Lumen(trapezoid_flux(
            d, fine_grid(from, to), fine_grid(lower.in_radians(), upper.in_radians())));
    const double first = std::max(lower, d.gammas().front()).in_radians();
    const double last = std::min(upper, d.gammas().back()).in_radians();
    if (!(first < last))
        return Lumen();
    // the table's planes, as often as the sector needs them
    std::vector<Angle> planes;
    for (int turn = -2; turn <= 2; ++turn)
        for (const Angle p : d.planes()) {
            const Angle turned = p + radians(2.0 * pi * turn);
            if (planes.empty() || (turned - planes.back()).in_radians() > 1e-12)
                planes.push_back(turned);
        }
    return Lumen(trapezoid_flux(
        d, nodes_between(planes, from, to), nodes_between(d.gammas(), first, last)));
}

Lumen flux_between(const IntensityDistribution& d, Angle lower, Angle upper) {
    const double first = d.planes().front().in_radians();
    const double span = d.planes().back().in_radians() - first;
    if (d.pole() == TablePole::nadir) // a table that does not go all round ends where it ends
        return flux_in_sector(
            d, lower, upper, radians(first + 0.5 * span), radians(0.5 * span));
    return flux_in_sector(d, lower, upper, radians(pi), radians(pi));
}

double downward_fraction(const IntensityDistribution& d) {
    const double all = d.flux_trapezoid().value();
    if (!(all > 0.0))
        return 0.0;
    // planes of constant V run from pole to pole; those within 90 degrees of nadir are below
    const Angle limit = degrees(90.001);
    if (d.pole() == TablePole::lateral && d.planes().front() >= Angle() - limit
        && d.planes().back() <= limit)
        return 1.0;
    return std::min(1.0, flux_between(d, Angle(), degrees(90)).value() / all);
}

std::optional<Lumen> rated_lamp_flux(const LuminairePhotometry& l) {
    if (l.is_absolute || l.lamp_set >= l.lamp_sets.size()
        || !(l.lamp_sets[l.lamp_set].flux.value() > 0.0))
        return std::nullopt;
    return l.lamp_sets[l.lamp_set].flux;
}

std::optional<double> light_output_ratio(const LuminairePhotometry& l) {
    const auto lamps = rated_lamp_flux(l);
    return lamps ? std::optional(l.distribution.flux_trapezoid() / *lamps) : std::nullopt;
}

std::optional<double> downward_light_output_ratio(const LuminairePhotometry& l) {
    const auto ratio = light_output_ratio(l);
    return ratio ? std::optional(*ratio * downward_fraction(l.distribution)) : std::nullopt;
}

std::optional<double> luminous_efficacy(const LuminairePhotometry& l) {
    if (!(l.input_watts > 0.0))
        return std::nullopt;
    return l.distribution.flux_trapezoid().value() / l.input_watts;
}

std::array<Lumen, 18> zonal_flux(const IntensityDistribution& d) {
    std::array<Lumen, 18> zones;
    for (std::size_t z = 0; z < zones.size(); ++z)
        zones[z] = flux_between(d,
                                degrees(10.0 * static_cast<double>(z)),
                                degrees(10.0 * static_cast<double>(z + 1)));
    return zones;
}

std::array<double, 5> cie_flux_code(const LuminairePhotometry& l) {
    const IntensityDistribution& d = l.distribution;
    const double down = flux_between(d, Angle(), degrees(90)).value();
    std::array<double, 5> code{};
    constexpr std::array cosines{0.75, 0.5, 0.25}; // cones of pi/2, pi and 3 pi/2 steradian
    for (std::size_t i = 0; i < cosines.size() && down > 0.0; ++i)
        code[i] =
            100.0 * flux_between(d, Angle(), radians(std::acos(cosines[i]))).value() / down;
    code[3] = 100.0 * downward_fraction(d);
    code[4] = 100.0 * light_output_ratio(l).value_or(1.0);
    return code;
}

Candela intensity_towards(const LuminairePhotometry& l, Angle plane, Angle gamma) {
    const IntensityDistribution& d = l.distribution;
    return d.pole() == TablePole::nadir // the table's own angles: exact at its nodes
               ? d.evaluate(plane, gamma)
               : d.evaluate(towards(plane.in_radians(), gamma.in_radians()));
}

MaximumIntensity find_maximum(const IntensityDistribution& d) {
    for (std::size_t p = 0; p < d.planes().size(); ++p)
        for (std::size_t g = 0; g < d.gammas().size(); ++g) {
            if (d.at(p, g) < d.max_intensity())
                continue;
            const UnitVector3 w = d.direction(d.planes()[p], d.gammas()[g]);
            const double radius = std::hypot(w.x(), w.y());
            const bool is_axial = radius < 1e-12;
            double c = is_axial ? 0.0 : std::atan2(w.y(), w.x());
            if (c < -1e-12)
                c += 2.0 * pi;
            return {d.max_intensity(),
                    radians(std::max(c, 0.0)),
                    radians(std::atan2(radius, -w.z()))};
        }
    return {};
}

// ---- beams -------------------------------------------------------------------------------

namespace {

/// The polar curve in C and its opposite within one half-space: angle from the axis, candela.
struct CurvePoint {
    double angle;
    double candela;
};

std::vector<CurvePoint> polar_curve(const IntensityDistribution& d, double c, bool is_up) {
    std::vector<double> angles; // from the axis, 0..pi/2
    if (d.pole() == TablePole::lateral) {
        angles = fine_grid(0.0, 0.5 * pi);
    } else {
        angles = {0.0, 0.5 * pi};
        for (const Angle g : d.gammas())
            angles.push_back(is_up ? pi - g.in_radians() : g.in_radians());
        // what the table does not cover is dark right beside its last node
        for (const Angle end : {d.gammas().front(), d.gammas().back()})
            for (const double beside : {-1e-6, 1e-6})
                angles.push_back((is_up ? pi - end.in_radians() : end.in_radians()) + beside);
        std::erase_if(angles, [](double a) { return a < 0.0 || a > 0.5 * pi + 1e-9; });
        std::ranges::sort(angles);
    }
    std::vector<CurvePoint> curve;
    const auto add = [&](double angle) {
        const double gamma = is_up ? pi - std::abs(angle) : std::abs(angle);
        curve.push_back({angle, d.evaluate(towards(angle < 0 ? c + pi : c, gamma)).value()});
    };
    for (auto a = angles.rbegin(); a != angles.rend(); ++a)
        add(-*a);
    for (const double a : angles)
        add(a);
    return curve;
}

double largest(const std::vector<CurvePoint>& curve) {
    return std::ranges::max_element(curve, {}, &CurvePoint::candela)->candela;
}

/// Where the curve, followed from its first point, first reaches `level`.
template <class Iterator> double first_crossing(Iterator begin, Iterator end, double level) {
    for (auto at = begin; at != end; ++at) {
        if (at->candela < level)
            continue;
        if (at == begin)
            return at->angle;
        const auto& before = *(at - 1);
        const double share = (level - before.candela) / (at->candela - before.candela);
        return before.angle + share * (at->angle - before.angle);
    }
    return 0.0;
}

/// How far beyond the horizon the curve stays at `level`, followed from its first point to the
/// axis at most. 0 if it is below at once.
template <class Iterator> double reach_beyond(Iterator begin, Iterator end, double level) {
    const double horizon = std::abs(begin->angle);
    if (begin->candela < level)
        return 0.0;
    for (auto at = begin + 1; at != end && at->angle * begin->angle >= 0.0; ++at)
        if (at->candela < level) {
            const auto& before = *(at - 1);
            const double share = (before.candela - level) / (before.candela - at->candela);
            return horizon - std::abs(before.angle + share * (at->angle - before.angle));
        }
    return horizon;
}

} // namespace

std::optional<BeamExtent> find_beam(const IntensityDistribution& d, Angle plane, double share) {
    auto curve = polar_curve(d, plane.in_radians(), false);
    auto beyond = polar_curve(d, plane.in_radians(), true);
    if (largest(beyond) > largest(curve))
        std::swap(curve, beyond);
    const double peak = largest(curve);
    if (!(peak > 0.0))
        return std::nullopt;
    const double level = share * peak;
    double towards = first_crossing(curve.rbegin(), curve.rend(), level);
    double opposite = -first_crossing(curve.begin(), curve.end(), level);
    if (curve.back().candela >= level)
        towards += reach_beyond(beyond.rbegin(), beyond.rend(), level);
    if (curve.front().candela >= level)
        opposite += reach_beyond(beyond.begin(), beyond.end(), level);
    return BeamExtent{radians(towards), radians(opposite)};
}

} // namespace isolux
