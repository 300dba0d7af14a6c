#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/arc_tangent.h"
#include "isolux/transport/light_tree.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double band_width = pi / static_cast<double>(LightBounds::bands);

/// Nearer than this a luminaire is taken to be that near, m (METHODS eq. (14), d_min).
constexpr double least_distance = 1e-3;

/// Angles and intensities are widened by this much, so that rounding breaks no bound.
constexpr double slack = 1e-7;

double angle_between(const Vector3& unit_a, const Vector3& unit_b) noexcept {
    return arc_tangent(length(cross(unit_a, unit_b)), dot(unit_a, unit_b));
}

/// To 7e-5 rad (Abramowitz and Stegun 1964, 4.4.45).
float arc_cosine(float c) noexcept {
    const float x = std::min(1.0F, std::abs(c));
    const float angle = std::sqrt(1.0F - x)
                        * (1.5707288F + x * (-0.2121144F + x * (0.0742610F - 0.0187293F * x)));
    return c < 0.0F ? static_cast<float>(pi) - angle : angle;
}

/// Largest intensity of the interpolant in a band of polar angles: it is linear between nodes,
/// so nodes inside and the ends of the band tell.
double largest_in_band(const IntensityDistribution& table, double from, double to) noexcept {
    double most = 0.0;
    const auto gammas = table.gammas();
    for (std::size_t g = 0; g + 1 < gammas.size(); ++g) {
        const double lower = gammas[g].in_radians();
        const double upper = gammas[g + 1].in_radians();
        if (lower > to + slack || upper < from - slack)
            continue;
        const double first = std::clamp((from - slack - lower) / (upper - lower), 0.0, 1.0);
        const double last = std::clamp((to + slack - lower) / (upper - lower), 0.0, 1.0);
        for (std::size_t p = 0; p < table.planes().size(); ++p) {
            const double at_lower = in_candela(table.at(p, g));
            const double rise = in_candela(table.at(p, g + 1)) - at_lower;
            most = std::max({most, at_lower + first * rise, at_lower + last * rise});
        }
    }
    return most;
}

/// What the position and size of the members leave open.
struct Sight {
    Vector3 towards; ///< from the middle of the box to the place, m
    double distance = 0.0;
    double radius = 0.0;
    double subtended = pi; ///< half angle of the ball around the box, rad
};

Sight look(const LightBounds& b, const Point3& place) noexcept {
    Sight s;
    s.towards = place - midpoint(b.lower, b.upper);
    s.distance = length(s.towards);
    s.radius = 0.5 * distance(b.lower, b.upper);
    if (s.radius < s.distance)
        s.subtended =
            arc_tangent(s.radius, std::sqrt((s.distance - s.radius) * (s.distance + s.radius)));
    return s;
}

/// Largest intensity of a member towards the place, cd.
double largest_intensity(const LightBounds& b, const Sight& s) noexcept {
    double from = 0.0;
    double to = pi;
    if (s.subtended < pi) {
        const double angle = angle_between(b.axis, (1.0 / s.distance) * s.towards);
        const double doubt = b.spread + s.subtended + slack;
        from = std::max(0.0, angle - doubt);
        to = std::min(pi, angle + doubt);
    }
    if (from > b.reach)
        return 0.0;
    const auto band = [](double angle) {
        return std::min(LightBounds::bands - 1, static_cast<std::size_t>(angle / band_width));
    };
    double most = 0.0;
    for (std::size_t i = band(from); i <= band(to); ++i)
        most = std::max(most, b.largest[i]);
    return most;
}

double over_distance_squared(const Sight& s) noexcept {
    const double nearest = std::max(std::max(s.distance, s.radius) - s.radius, least_distance);
    return 1.0 / (nearest * nearest);
}

/// Largest response of the receiver to light from inside the ball.
double largest_response(const Receiver& receiver, const Sight& s) noexcept {
    const auto cosine = [&] {
        if (s.subtended >= pi)
            return 1.0;
        const double angle = angle_between(receiver.axis, (-1.0 / s.distance) * s.towards);
        return std::cos(std::max(0.0, angle - s.subtended - slack));
    };
    switch (receiver.kind) {
    case IlluminanceKind::planar:
        return std::max(0.0, cosine());
    case IlluminanceKind::cylindrical:
        return 1.0 / pi;
    case IlluminanceKind::semi_cylindrical:
        return 2.0 / pi;
    case IlluminanceKind::hemispherical:
        return 0.25 * (1.0 + cosine());
    case IlluminanceKind::mean_spherical:
        return 0.25;
    }
    return 1.0;
}

} // namespace

TypeLight describe_type(const LuminaireType& type) {
    TypeLight light;
    if (const auto* file = std::get_if<LuminairePhotometry>(&type.source)) {
        const IntensityDistribution& table = file->distribution;
        light.axis = table.direction(table.planes().front(), radians(0.0));
        for (std::size_t i = 0; i < LightBounds::bands; ++i) {
            const double from = band_width * static_cast<double>(i);
            light.largest[i] =
                type.flux_scale * largest_in_band(table, from, from + band_width);
        }
        return light;
    }
    light.axis = UnitVector3::from_unit({0, 0, -1});
    if (!std::holds_alternative<LambertianSource>(type.source)) {
        light.largest.fill(in_candela(luminous_intensity(type, light.axis)));
        return light;
    }
    // The front of a Lambertian source is where its intensity is largest.
    const UnitVector3 x = UnitVector3::from_unit({1, 0, 0});
    if (luminous_intensity(type, x) > luminous_intensity(type, light.axis))
        light.axis = x;
    const double most = in_candela(luminous_intensity(type, light.axis));
    for (std::size_t i = 0; 2 * i < LightBounds::bands; ++i)
        light.largest[i] = most * std::cos(band_width * static_cast<double>(i));
    return light;
}

LightBounds bound_luminaire(const Luminaire& l, const TypeLight& type) {
    const Frame& frame = l.placement.world_from_luminaire;
    LightBounds b;
    b.lower = b.upper =
        l.opening.facets.empty() ? frame.origin : l.opening.facets[0].vertices[0];
    for (const Facet& facet : l.opening.facets)
        for (const Point3& p : facet.vertices) {
            b.lower = {
                std::min(b.lower.x, p.x), std::min(b.lower.y, p.y), std::min(b.lower.z, p.z)};
            b.upper = {
                std::max(b.upper.x, p.x), std::max(b.upper.y, p.y), std::max(b.upper.z, p.z)};
        }
    b.axis = UnitVector3(frame.vector_from_local(type.axis));
    b.count = 1.0;
    b.flux = in_lumen(l.flux);
    if (l.opening.form == OpeningForm::solid)
        b.facets = static_cast<double>(l.opening.facets.size());
    for (std::size_t i = 0; i < LightBounds::bands; ++i) {
        b.largest[i] = (1.0 + slack) * l.placement.scale * type.largest[i];
        if (b.largest[i] > 0.0)
            b.reach = band_width * static_cast<double>(i + 1);
    }
    return b;
}

double upper_bound(const LightBounds& b, const Receiver& receiver) noexcept {
    const Sight s = look(b, receiver.point);
    const double most = largest_intensity(b, s);
    if (most <= 0.0)
        return 0.0;
    return most * b.count * b.facets * largest_response(receiver, s) * over_distance_squared(s);
}

LightGlow glow_of(const LightBounds& b) noexcept {
    // A cosine in single precision and arc_cosine leave an angle to 7e-4 rad, worst near 0.
    constexpr double doubt = 1e-3;
    LightGlow g;
    g.middle = midpoint(b.lower, b.upper);
    g.radius = static_cast<float>(0.5 * distance(b.lower, b.upper));
    g.spread = static_cast<float>(b.spread + doubt);
    g.reach = static_cast<float>(b.reach + doubt);
    g.count = static_cast<float>(b.count);
    g.axis = {static_cast<float>(b.axis.x()),
              static_cast<float>(b.axis.y()),
              static_cast<float>(b.axis.z())};
    for (std::size_t i = 0; i < LightBounds::bands; ++i) {
        g.largest[i] = static_cast<float>(b.largest[i]);
        g.most = std::max(g.most, g.largest[i]);
    }
    return g;
}

float importance(const LightGlow& g, const Point3& place) noexcept {
    constexpr auto half_turn = static_cast<float>(pi);
    constexpr auto bands_per_radian = static_cast<float>(1.0 / band_width);
    const auto x = static_cast<float>(place.x - g.middle.x);
    const auto y = static_cast<float>(place.y - g.middle.y);
    const auto z = static_cast<float>(place.z - g.middle.z);
    const float distance = std::sqrt(x * x + y * y + z * z);
    const float away =
        std::max(std::max(distance, g.radius), static_cast<float>(least_distance));
    float most = g.most;
    if (distance > g.radius) {
        const float along = (g.axis[0] * x + g.axis[1] * y + g.axis[2] * z) / distance;
        const float angle = arc_cosine(along);
        const float doubt = g.spread + 0.5F * half_turn - arc_cosine(g.radius / distance);
        if (angle - doubt > g.reach)
            return 0.0F;
        const auto band = [](float a) {
            return static_cast<std::size_t>(std::clamp(a, 0.0F, 0.999F * half_turn)
                                            * bands_per_radian);
        };
        const std::size_t last = band(angle + doubt);
        most = 0.0F;
        for (std::size_t i = band(angle - doubt); i <= last; ++i)
            most = std::max(most, g.largest[i]);
    }
    return most * g.count / (away * away);
}

} // namespace isolux
