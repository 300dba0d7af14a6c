#include "isolux/transport/follow.h"

#include <cmath>

namespace isolux {

namespace {

/// An opening's black body lies before it by less than this, m; the opening shines all the
/// same.
constexpr double grazing_slack = 4e-5;

} // namespace

Rgb seen_openings(const Emission& emission, const Branch& ray, double reach) noexcept {
    Rgb sum;
    for (std::size_t l = 0; l < emission.luminaires(); ++l) {
        const Opening& opening = emission.luminaire(l).opening;
        for (std::size_t f = 0; f < opening.facets.size(); ++f) {
            const Facet& facet = opening.facets[f];
            const double slope = dot(facet.normal, ray.w);
            if (slope == 0.0)
                continue;
            const double t = dot(facet.normal, facet.vertices[0] - ray.origin) / slope;
            if (t <= 0.0 || t > reach + grazing_slack / std::abs(slope))
                continue;
            const Point3 p = ray.origin + t * Vector3(ray.w);
            bool inside = true;
            for (std::size_t i = 0; inside && i < facet.vertices.size(); ++i) {
                const Point3& a = facet.vertices[i];
                const Point3& b = facet.vertices[(i + 1) % facet.vertices.size()];
                inside = dot(cross(b - a, p - a), facet.normal) >= 0.0;
            }
            if (!inside)
                continue;
            const double density = emission.evaluate({l, f, p}, -ray.w);
            sum += (density / std::abs(slope)) * emission.colour(l);
        }
    }
    return sum;
}

} // namespace isolux
