#include "isolux/transport/opening_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "isolux/base/polygon.h"
#include "isolux/transport/response.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Nearer than this to the plane of an opening, or to a point source, m, a receiver takes the
/// place where its rays start.
constexpr double least_clearance = 1e-3;

} // namespace

Point3
evaluation_point(const Luminaire& luminaire, const Receiver& receiver, const Point3& clear) {
    const Point3& centre = luminaire.placement.world_from_luminaire.origin;
    if (distance(receiver.point, centre) < least_clearance)
        return clear;
    for (const Facet& facet : luminaire.opening.facets) {
        const double above = dot(facet.normal, receiver.point - facet.vertices.front());
        if (std::abs(above) < least_clearance)
            return clear;
    }
    return receiver.point;
}

OpeningLight::OpeningLight(const Scene& scene,
                           const Emission& emission,
                           const Receiver& receiver,
                           const Point3& clear,
                           std::size_t luminaire)
    : scene_(&scene), emission_(&emission), receiver_(&receiver), luminaire_(luminaire),
      at_(evaluation_point(emission.luminaire(luminaire), receiver, clear)),
      view_(emission.view(luminaire, at_)) {}

Look OpeningLight::look(double u, double v) const noexcept {
    Look k{view_.sample(u, v), {}, 0.0, {}};
    const Vector3 d = at_ - k.from.position;
    const double d2 = length_squared(d);
    if (!(d2 > 0.0))
        return k;
    k.w = UnitVector3(d);
    k.response = evaluate_response(*receiver_, -k.w) / d2;
    k.departure = emission_->departure(k.from, k.w);
    return k;
}

double OpeningLight::value(const Look& look) const noexcept {
    if (look.response <= 0.0)
        return 0.0;
    const double density = view_.pdf(look.from);
    return density > 0.0 ? emission_->evaluate(look.from, look.w) * look.response / density
                         : 0.0;
}

std::optional<RuleValue> OpeningLight::unshadowed(double negligible) const {
    const Luminaire& l = emission_->luminaire(luminaire_);
    const Opening& opening = l.opening;
    if (opening.form == OpeningForm::point)
        return RuleValue{value(look(0.5, 0.5))};
    const bool is_flat = opening.form == OpeningForm::flat;
    if (is_flat && is_planar(*receiver_)
        && std::holds_alternative<LambertianSource>(scene_->type_of(l).source)) {
        const Facet& facet = opening.facets.front();
        if (dot(facet.normal, at_ - facet.vertices.front()) <= 0.0)
            return RuleValue{};
        const double luminance = in_lumen(l.flux) / (pi * facet.area);
        return RuleValue{luminance
                         * projected_solid_angle(facet.vertices, at_, receiver_->axis)};
    }
    RuleValue sum;
    for (std::size_t f = 0; f < opening.facets.size(); ++f) {
        const Facet& facet = opening.facets[f];
        if (!is_flat && dot(facet.normal, at_ - facet.vertices.front()) <= 0.0)
            continue;
        const std::optional<RuleValue> part =
            integrate(f, negligible / static_cast<double>(opening.facets.size()));
        if (!part)
            return std::nullopt;
        sum += *part;
    }
    return sum;
}

std::optional<RuleValue> OpeningLight::integrate(std::size_t facet, double negligible) const {
    const std::vector<Point3>& vertices =
        emission_->luminaire(luminaire_).opening.facets[facet].vertices;
    const auto from_place = [&](const Point3& place) {
        const Vector3 d = at_ - place;
        const double d2 = length_squared(d);
        if (!(d2 > 0.0))
            return 0.0;
        const UnitVector3 w(d);
        return emission_->evaluate({luminaire_, facet, place}, w)
               * evaluate_response(*receiver_, -w) / d2;
    };
    const auto is_behind = [&](const Point3& p) { return dot(receiver_->axis, p - at_) < 0.0; };
    if (is_planar(*receiver_) && std::ranges::any_of(vertices, is_behind))
        return integrate_polygon(
            clip_to_half_space(vertices, at_, receiver_->axis), at_, negligible, from_place);
    return integrate_polygon(vertices, at_, negligible, from_place);
}

} // namespace isolux
