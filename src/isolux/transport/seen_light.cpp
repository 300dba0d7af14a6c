#include "isolux/transport/seen_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "isolux/base/polygon.h"

namespace isolux {

namespace {

/// An opening smaller than the distance by this factor counts as a point (METHODS "Point
/// model").
constexpr double point_like_ratio = 40.0;
constexpr double coarse_point_ratio = 2.0; ///< the same in previews

struct Node {
    double x; ///< in (0, 1)
    double weight;
};

// Gauss-Legendre rules on (0, 1).
constexpr std::array<Node, 1> rule_1{{{0.5, 1.0}}};
constexpr std::array<Node, 2> rule_2{{{0.2113248654051871, 0.5}, {0.7886751345948129, 0.5}}};
constexpr std::array<Node, 3> rule_3{{{0.1127016653792583, 0.2777777777777778},
                                      {0.5, 0.4444444444444444},
                                      {0.8872983346207417, 0.2777777777777778}}};
constexpr std::array<Node, 5> rule_5{{{0.0469100770306680, 0.1184634425280945},
                                      {0.2307653449471585, 0.2393143352496832},
                                      {0.5, 0.2844444444444444},
                                      {0.7692346550528415, 0.2393143352496832},
                                      {0.9530899229693320, 0.1184634425280945}}};

/// The rule for an edge of an opening that is `ratio` times as long as it is away.
std::span<const Node> rule_for(double ratio, OpeningDetail detail) noexcept {
    const bool coarse = detail == OpeningDetail::coarse;
    if (ratio < (coarse ? 0.7 : 0.03))
        return rule_1;
    if (ratio < (coarse ? 1.5 : 0.3))
        return rule_2;
    return ratio < 0.9 || coarse ? std::span<const Node>(rule_3)
                                 : std::span<const Node>(rule_5);
}

/// Points of a polygon that is no parallelogram: its fan of triangles, each by its middle or by
/// three points of it that integrate quadratics exactly.
constexpr std::array<std::array<double, 2>, 3> triangle_points{
    {{1.0 / 6.0, 1.0 / 6.0}, {2.0 / 3.0, 1.0 / 6.0}, {1.0 / 6.0, 2.0 / 3.0}}};

} // namespace

SeenLight::SeenLight(const Scene& scene, const Emission& emission)
    : scene_(&scene), emission_(&emission) {}

UnitVector3 SeenLight::normal_of(std::size_t l) const noexcept {
    const Luminaire& luminaire = emission_->luminaire(l);
    if (luminaire.opening.form == OpeningForm::flat)
        return luminaire.opening.facets.front().normal;
    return -luminaire.placement.world_from_luminaire.z;
}

double SeenLight::from_centre(std::size_t l,
                              const Point3& at,
                              const UnitVector3& normal) const noexcept {
    const Luminaire& luminaire = emission_->luminaire(l);
    const Frame& frame = luminaire.placement.world_from_luminaire;
    const Vector3 d = at - frame.origin;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return 0.0;
    const UnitVector3 w(d);
    const double cosine = -dot(normal, w);
    if (cosine <= 0.0)
        return 0.0;
    const double intensity =
        luminaire.placement.scale
        * in_candela(luminous_intensity(scene_->type_of(luminaire),
                                        UnitVector3::from_unit(frame.vector_to_local(w))));
    return intensity * cosine / d2;
}

double SeenLight::from_facet(std::size_t l,
                             std::size_t facet,
                             const Point3& at,
                             const UnitVector3& normal,
                             OpeningDetail detail) const noexcept {
    const Facet& f = emission_->luminaire(l).opening.facets[facet];
    const std::vector<Point3>& v = f.vertices;
    const auto value = [&](const Point3& p) {
        const Vector3 d = at - p;
        const double d2 = length_squared(d);
        if (!(d2 > 1e-12))
            return 0.0;
        const UnitVector3 w(d);
        const double cosine = -dot(normal, w);
        return cosine > 0.0 ? emission_->evaluate({l, facet, p}, w) * cosine / d2 : 0.0;
    };
    double sum = 0.0;
    const bool is_parallelogram =
        v.size() == 4 && length((v[2] - v[1]) - (v[3] - v[0])) < 1e-9 * length(v[2] - v[0]);
    if (is_parallelogram) {
        const Vector3 a = v[1] - v[0];
        const Vector3 b = v[3] - v[0];
        const double away = distance(at, midpoint(v[0], v[2]));
        const auto rule_a = rule_for(length(a) / away, detail);
        const auto rule_b = rule_for(length(b) / away, detail);
        for (const Node& i : rule_a)
            for (const Node& j : rule_b)
                sum += i.weight * j.weight * value(v[0] + i.x * a + j.x * b);
        return f.area * sum;
    }
    const double away = distance(at, v[0]);
    const bool one_point = detail == OpeningDetail::coarse || f.area < 0.01 * away * away;
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
        const Vector3 a = v[i] - v[0];
        const Vector3 b = v[i + 1] - v[0];
        const double area = 0.5 * length(cross(a, b));
        if (one_point) {
            sum += area * value(v[0] + (1.0 / 3.0) * (a + b));
            continue;
        }
        for (const auto& [s, t] : triangle_points)
            sum += area / 3.0 * value(v[0] + s * a + t * b);
    }
    return sum;
}

double SeenLight::unshadowed(std::size_t l,
                             const Point3& at,
                             const UnitVector3& normal,
                             OpeningDetail detail) const noexcept {
    const Luminaire& luminaire = emission_->luminaire(l);
    const Opening& opening = luminaire.opening;
    const double ratio =
        detail == OpeningDetail::coarse ? coarse_point_ratio : point_like_ratio;
    const double reach = ratio * opening.largest_dimension;
    if (opening.form == OpeningForm::point
        || length_squared(at - luminaire.placement.world_from_luminaire.origin) > reach * reach)
        return from_centre(l, at, normal);
    if (opening.form == OpeningForm::flat
        && std::holds_alternative<LambertianSource>(scene_->type_of(luminaire).source)) {
        const Facet& facet = opening.facets.front();
        if (dot(facet.normal, at - facet.vertices.front()) <= 0.0)
            return 0.0;
        const double luminance = in_lumen(luminaire.flux) / (std::numbers::pi * facet.area);
        return luminance * projected_solid_angle(facet.vertices, at, normal);
    }
    double sum = 0.0;
    for (std::size_t f = 0; f < opening.facets.size(); ++f) {
        const Facet& facet = opening.facets[f];
        if (opening.form == OpeningForm::solid
            && dot(facet.normal, at - facet.vertices.front()) <= 0.0)
            continue;
        sum += from_facet(l, f, at, normal, detail);
    }
    return sum;
}

LightAim SeenLight::aim(std::size_t l,
                        const Point3& at,
                        const UnitVector3& normal,
                        double u,
                        double v,
                        OpeningDraw by) const noexcept {
    const OpeningView view = emission_->view(l, at, by);
    LightAim aim;
    aim.from = view.sample(u, v);
    const Vector3 d = at - aim.from.position;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return aim;
    aim.w = UnitVector3(d);
    const double cosine = -dot(normal, aim.w);
    const double density = view.pdf(aim.from);
    if (cosine <= 0.0 || !(density > 0.0))
        return aim;
    aim.share = cosine / (d2 * density);
    aim.sight = {at, emission_->departure(aim.from, aim.w)};
    return aim;
}

double SeenLight::occluder_slope(const LightAim& aim,
                                 const Point3& at,
                                 std::uint64_t& rays) const noexcept {
    const UnitVector3 axis = normal_of(aim.from.luminaire);
    // The first opaque surface on the way; panes are looked through.
    const auto find = [&] {
        Point3 origin = at;
        double far = distance(at, aim.sight.b);
        for (int i = 0; i < 8; ++i) {
            const auto hit = scene_->caster.find_first_hit(origin, -aim.w, far);
            ++rays;
            if (!hit)
                break;
            const Material& m = scene_->material(scene_->triangle(hit->triangle).material);
            if (std::holds_alternative<Opaque>(m.scattering))
                return hit->position;
            far -= hit->distance;
            origin = scene_->caster.offset_point(hit->position, -aim.w);
        }
        return at; // lost to rounding: an occluder at the surface gives no width
    };
    const double d1 = std::abs(dot(axis, at - aim.from.position));
    const double d2 = std::abs(dot(axis, find() - aim.from.position));
    return std::max(0.0, d1 / std::max(d2, 1e-4) - 1.0);
}

} // namespace isolux
