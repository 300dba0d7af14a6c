#include "isolux/transport/emission.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "isolux/sampling/warp.h"

namespace isolux {

namespace {

constexpr double pi = std::numbers::pi;

/// Solid angle above which a flat rectangle is also sampled in solid angle (METHODS, "Openings
/// with a photometric table"), sr.
constexpr double large_solid_angle = 0.05;

/// What rounding may do to the distance of a line from an opening's centre.
constexpr double slack = 1.0 + 1e-6;

/// Uniform over the area.
Point3 sample_facet(const Facet& f, double u, double v) noexcept {
    return f.fan.empty() ? sample_polygon(f.vertices, u, v)
                         : sample_fan(f.vertices, f.fan, u, v);
}

bool is_rectangular(const Facet& f) noexcept {
    if (f.vertices.size() != 4)
        return false;
    const Vector3 a = f.vertices[1] - f.vertices[0];
    const Vector3 b = f.vertices[3] - f.vertices[0];
    const Vector3 closing = (f.vertices[2] - f.vertices[0]) - (a + b);
    const double scale = length_squared(a) + length_squared(b);
    return std::abs(dot(a, b)) < 1e-9 * scale && length_squared(closing) < 1e-18 * scale;
}

/// Area that all facets together show towards w.
double projected_area(const Opening& opening, const Vector3& w) noexcept {
    double sum = 0.0;
    for (const Facet& f : opening.facets)
        sum += f.area * std::max(0.0, dot(f.normal, w));
    return sum;
}

/// Weight of a facet of a solid opening for light towards `place`: its area by the cosine at
/// its first corner, not less than a little, and nothing behind it.
double facet_weight(const Facet& f, const Point3& place) noexcept {
    const Vector3 d = place - f.vertices[0];
    const double height = dot(f.normal, d);
    if (height <= 0.0)
        return 0.0;
    return f.area * (0.1 + height / length(d));
}

} // namespace

Emission::Emission(const Scene& scene) : scene_(&scene), lights_(scene) {
    std::vector<std::optional<std::size_t>> table_of_type(scene.luminaire_types.size());
    tables_.reserve(scene.luminaire_types.size());
    for (std::size_t t = 0; t < scene.luminaire_types.size(); ++t) {
        const auto* file = std::get_if<LuminairePhotometry>(&scene.luminaire_types[t].source);
        if (file == nullptr || in_lumen(file->distribution.flux()) <= 0.0)
            continue;
        table_of_type[t] = tables_.size();
        tables_.emplace_back(file->distribution);
    }
    std::vector<double> cumulative_flux;
    for (const Luminaire& l : scene.luminaires) {
        Source s;
        s.type = &scene.type_of(l);
        if (const auto table = table_of_type[l.placement.type.index()])
            s.table = &tables_[*table];
        s.flux = in_lumen(l.flux);
        s.centre = l.placement.world_from_luminaire.origin;
        for (const Facet& f : l.opening.facets) {
            s.area += f.area;
            for (const Point3& p : f.vertices)
                s.reach_squared = std::max(s.reach_squared,
                                           slack * length_squared(p - s.centre) + slack - 1.0);
        }
        total_flux_ += s.flux;
        cumulative_flux.push_back(total_flux_);
        sources_.push_back(s);
    }
    if (total_flux_ > 0.0)
        by_flux_ = CumulativeTable(std::move(cumulative_flux));
}

EmissionPoint Emission::place_on_solid(std::size_t luminaire,
                                       const UnitVector3& w,
                                       double u,
                                       double v) const noexcept {
    const Opening& opening = scene_->luminaires[luminaire].opening;
    double rest = u * projected_area(opening, w);
    std::size_t chosen = 0;
    double stretched = 0.0;
    for (std::size_t f = 0; f < opening.facets.size(); ++f) {
        const Facet& facet = opening.facets[f];
        const double share = facet.area * std::max(0.0, dot(facet.normal, w));
        if (share <= 0.0)
            continue;
        chosen = f;
        stretched = std::min(rest / share, 1.0 - 1e-12);
        if (rest < share)
            break;
        rest -= share;
    }
    return {luminaire, chosen, sample_facet(opening.facets[chosen], stretched, v)};
}

EmissionSample Emission::sample_emission(double u_luminaire,
                                         double u_place,
                                         double v_place,
                                         double u_direction,
                                         double v_direction) const noexcept {
    const std::size_t l = by_flux_.sample(u_luminaire).index;
    const Source& source = sources_[l];
    const Luminaire& luminaire = scene_->luminaires[l];
    const Frame& frame = luminaire.placement.world_from_luminaire;

    EmissionSample sample{{l, 0, frame.origin}, {}};
    UnitVector3& w = sample.direction;
    double candela = 0.0;
    if (source.table != nullptr) {
        const TableDraw draw = source.table->draw(u_direction, v_direction);
        w = UnitVector3(frame.vector_from_local(draw.direction));
        candela = source.type->flux_scale * draw.candela;
    } else {
        if (std::holds_alternative<LambertianSource>(source.type->source)) {
            const bool has_front = luminaire.opening.form == OpeningForm::flat;
            const UnitVector3 front =
                has_front ? luminaire.opening.facets.front().normal : -frame.z;
            w = UnitVector3(
                make_basis(front).to_world(sample_cosine_hemisphere(u_direction, v_direction)));
        } else {
            w = sample_sphere(u_direction, v_direction);
        }
        candela = intensity(l, w);
    }
    if (luminaire.opening.form == OpeningForm::flat)
        sample.from.position = sample_facet(luminaire.opening.facets[0], u_place, v_place);
    else if (luminaire.opening.form == OpeningForm::solid)
        sample.from = place_on_solid(l, w, u_place, v_place);
    sample.strength = per_area(sample.from, w, candela);
    return sample;
}

OpeningView::OpeningView(const Luminaire& of,
                         std::size_t luminaire,
                         const Point3& place,
                         OpeningDraw by) noexcept
    : of_(&of), luminaire_(luminaire), place_(place) {
    const Opening& opening = of.opening;
    if (opening.form == OpeningForm::solid)
        for (const Facet& f : opening.facets)
            weights_ += facet_weight(f, place);
    if (opening.form != OpeningForm::flat || by == OpeningDraw::area)
        return;
    // The solid angle is below area / (distance to the nearest point)^2: far away no need to
    // ask.
    const Facet& facet = opening.facets.front();
    const double away = distance(place, of.placement.world_from_luminaire.origin)
                        - 0.5 * opening.largest_dimension;
    if (away > 0.0 && facet.area <= large_solid_angle * away * away)
        return;
    if (!is_rectangular(facet))
        return;
    rectangle_.emplace(facet.vertices[0],
                       facet.vertices[1] - facet.vertices[0],
                       facet.vertices[3] - facet.vertices[0],
                       place);
    if (rectangle_->solid_angle() <= large_solid_angle)
        rectangle_.reset();
}

EmissionPoint OpeningView::sample(double u, double v) const noexcept {
    const Opening& opening = of_->opening;
    EmissionPoint from{luminaire_, 0, of_->placement.world_from_luminaire.origin};
    if (opening.form == OpeningForm::flat) {
        const Facet& facet = opening.facets.front();
        if (rectangle_ && u >= 0.5)
            from.position = rectangle_->sample(2.0 * u - 1.0, v);
        else
            from.position = sample_facet(facet, rectangle_ ? 2.0 * u : u, v);
    } else if (opening.form == OpeningForm::solid && weights_ > 0.0) {
        double rest = u * weights_;
        double stretched = 0.0;
        for (std::size_t f = 0; f < opening.facets.size(); ++f) {
            const double weight = facet_weight(opening.facets[f], place_);
            if (weight <= 0.0)
                continue;
            from.facet = f;
            stretched = std::min(rest / weight, 1.0 - 1e-12);
            if (rest < weight)
                break;
            rest -= weight;
        }
        from.position = sample_facet(opening.facets[from.facet], stretched, v);
    }
    return from;
}

double OpeningView::pdf(const EmissionPoint& from) const noexcept {
    const Opening& opening = of_->opening;
    if (opening.form == OpeningForm::point)
        return 1.0;
    const Facet& facet = opening.facets[from.facet];
    if (opening.form == OpeningForm::solid)
        return weights_ > 0.0 ? facet_weight(facet, place_) / (weights_ * facet.area) : 0.0;
    if (!rectangle_)
        return 1.0 / facet.area;
    const Vector3 d = from.position - place_;
    const double d2 = length_squared(d);
    const double cosine = std::abs(dot(facet.normal, d)) / std::sqrt(d2);
    return 0.5 * (1.0 / facet.area + cosine / (rectangle_->solid_angle() * d2));
}

TowardsSample Emission::sample_towards(const Point3& place,
                                       double u_luminaire,
                                       double u,
                                       double v) const noexcept {
    const LightTree::Pick pick = lights_.pick(place, u_luminaire);
    if (!(pick.probability > 0.0))
        return {};
    const OpeningView opening = view(pick.luminaire, place);
    const EmissionPoint from = opening.sample(u, v);
    return {from, pick.probability * opening.pdf(from)};
}

double Emission::pdf_towards(const Point3& place, const EmissionPoint& from) const noexcept {
    return lights_.probability(place, from.luminaire) * view(from.luminaire, place).pdf(from);
}

double Emission::evaluate(const EmissionPoint& from, const UnitVector3& w) const noexcept {
    return per_area(from, w, intensity(from.luminaire, w));
}

double Emission::intensity(std::size_t luminaire, const UnitVector3& w) const noexcept {
    const Frame& frame = scene_->luminaires[luminaire].placement.world_from_luminaire;
    const UnitVector3 local = UnitVector3::from_unit(frame.vector_to_local(w));
    return in_candela(luminous_intensity(*sources_[luminaire].type, local));
}

double Emission::per_area(const EmissionPoint& from,
                          const UnitVector3& w,
                          double candela) const noexcept {
    const Luminaire& l = scene_->luminaires[from.luminaire];
    const double intensity = l.placement.scale * candela;
    switch (l.opening.form) {
    case OpeningForm::point:
        return intensity;
    case OpeningForm::flat:
        return intensity / sources_[from.luminaire].area;
    case OpeningForm::solid: {
        const double shown = std::max(0.0, dot(l.opening.facets[from.facet].normal, w));
        return shown > 0.0 ? intensity * shown / projected_area(l.opening, w) : 0.0;
    }
    }
    return 0.0;
}

Point3 Emission::departure(const EmissionPoint& from, const UnitVector3& w) const noexcept {
    const Luminaire& l = scene_->luminaires[from.luminaire];
    const RayCaster& caster = scene_->caster;
    if (l.opening.form == OpeningForm::point)
        return caster.offset_point(from.position, w);
    const UnitVector3& normal = l.opening.facets[from.facet].normal;
    return caster.offset_point(from.position, dot(normal, w) >= 0.0 ? normal : -normal);
}

Rgb Emission::colour(std::size_t luminaire) const noexcept {
    return sources_[luminaire].type->colour;
}

} // namespace isolux
