#include "isolux/calc/glare_sources.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isolux {

namespace {

/// An opening seen under more than this (size over distance) is divided.
constexpr double largest_part = 1.0 / 3.0;
constexpr std::size_t most_divisions = 32;

/// Shadow rays a side of a part; 4 x 4 tell how much of it is hidden to a sixteenth.
constexpr std::size_t looks_a_side = 4;

/// A quadrilateral piece of a facet; a corner counts twice in a triangle.
struct Patch {
    std::array<Point3, 4> corner;

    [[nodiscard]] Point3 at(double u, double v) const {
        const Point3 a = corner[0] + u * (corner[1] - corner[0]);
        const Point3 b = corner[3] + u * (corner[2] - corner[3]);
        return a + v * (b - a);
    }

    [[nodiscard]] Patch part(std::size_t i, std::size_t j, std::size_t n) const {
        const double d = 1.0 / static_cast<double>(n);
        const double u = static_cast<double>(i) * d;
        const double v = static_cast<double>(j) * d;
        return {{at(u, v), at(u + d, v), at(u + d, v + d), at(u, v + d)}};
    }

    [[nodiscard]] double area() const {
        return 0.5 * length(cross(corner[2] - corner[0], corner[3] - corner[1]));
    }

    [[nodiscard]] double size() const {
        double longest = 0.0;
        for (std::size_t i = 0; i < 4; ++i)
            longest = std::max(longest, distance(corner[i], corner[(i + 1) % 4]));
        return longest;
    }
};

/// A rectangle is one patch, any other polygon a fan of them.
std::vector<Patch> patches_of(const Facet& facet) {
    const std::vector<Point3>& v = facet.vertices;
    if (v.size() == 4)
        return {{{v[0], v[1], v[2], v[3]}}};
    std::vector<Patch> fan;
    for (std::size_t i = 1; i + 1 < v.size(); i += 2) {
        const std::size_t last = std::min(i + 2, v.size() - 1);
        fan.push_back({{v[0], v[i], v[i + 1], v[last]}});
    }
    return fan;
}

class Eye {
public:
    Eye(const Scene& scene, const Point3& eye) : scene_(scene), eye_(eye) {}

    SeenLuminaire see(std::size_t index) const {
        const Luminaire& l = scene_.luminaires[index];
        SeenLuminaire seen;
        seen.luminaire = index;
        const Point3& centre = l.placement.world_from_luminaire.origin;
        seen.towards = UnitVector3(centre - eye_);
        if (l.placement.scale <= 0.0 || distance(centre, eye_) <= 0.0)
            return seen;
        if (l.opening.form == OpeningForm::point) {
            see_point(l, seen);
            return seen;
        }
        for (const Facet& facet : l.opening.facets) {
            const bool is_front = dot(facet.normal, eye_ - facet.vertices.front()) > 0.0;
            if (is_front || l.opening.form == OpeningForm::flat)
                for (const Patch& patch : patches_of(facet))
                    divide(l, facet, patch, seen);
        }
        return seen;
    }

private:
    /// cd, of the whole luminaire towards the eye from one of its points.
    [[nodiscard]] double intensity(const Luminaire& l, const UnitVector3& to_eye) const {
        const UnitVector3 local =
            UnitVector3(l.placement.world_from_luminaire.vector_to_local(to_eye));
        return l.placement.scale * in_candela(luminous_intensity(scene_.type_of(l), local));
    }

    void see_point(const Luminaire& l, SeenLuminaire& seen) const {
        const Point3& at = l.placement.world_from_luminaire.origin;
        const double d = distance(at, eye_);
        const double visible = scene_.caster.transmittance(eye_, at);
        const double i = intensity(l, -seen.towards);
        seen.is_point = i * visible > 0.0;
        seen.illuminance = i * visible / (d * d);
    }

    void divide(const Luminaire& l,
                const Facet& facet,
                const Patch& patch,
                SeenLuminaire& seen) const {
        const double d = distance(patch.at(0.5, 0.5), eye_);
        const double wanted = std::ceil(patch.size() / (largest_part * std::max(d, 1e-6)));
        const auto parts = static_cast<std::size_t>(
            std::clamp(wanted, 1.0, static_cast<double>(most_divisions)));
        for (std::size_t i = 0; i < parts; ++i)
            for (std::size_t j = 0; j < parts; ++j)
                see_part(l, facet, patch.part(i, j, parts), seen);
    }

    void see_part(const Luminaire& l,
                  const Facet& facet,
                  const Patch& part,
                  SeenLuminaire& seen) const {
        const Point3 centre = part.at(0.5, 0.5);
        const double d = distance(centre, eye_);
        const UnitVector3 towards(centre - eye_);
        const double cosine = std::abs(dot(facet.normal, towards));
        const double shown = shown_area(l, -towards);
        const double area = part.area();
        if (cosine * area <= 0.0 || shown <= 0.0 || d <= 0.0)
            return;
        const double luminance = intensity(l, -towards) / shown; // METHODS eq. (110)
        double share = 0.0;                                      // of light
        double square = 0.0;                                     // of luminance squared
        constexpr double looks = looks_a_side * looks_a_side;
        for (std::size_t i = 0; i < looks_a_side; ++i)
            for (std::size_t j = 0; j < looks_a_side; ++j) {
                const auto at = [](std::size_t k) {
                    return (static_cast<double>(k) + 0.5) / looks_a_side;
                };
                const double t = visible(part.at(at(i), at(j)), -towards);
                share += t / looks;
                square += t * t / looks;
            }
        const double solid_angle = cosine * area / (d * d);
        if (luminance * share <= 0.0)
            return;
        seen.illuminance +=
            luminance * share * solid_angle * std::max(0.0, dot(towards, seen.towards));
        // Luminance and solid angle whose L2 w is that of what is seen.
        const double mean = square / share;
        seen.parts.push_back({luminance * mean, solid_angle * share / mean, towards});
    }

    /// m2 of the luminaire's opening at right angles to a direction; L = I / this.
    static double shown_area(const Luminaire& l, const UnitVector3& to_eye) {
        double sum = 0.0;
        for (const Facet& f : l.opening.facets) {
            const double cosine = dot(f.normal, to_eye);
            sum += f.area
                   * (l.opening.form == OpeningForm::flat ? std::abs(cosine)
                                                          : std::max(0.0, cosine));
        }
        return sum;
    }

    [[nodiscard]] double visible(const Point3& p, const UnitVector3& to_eye) const {
        return scene_.caster.transmittance(eye_, scene_.caster.offset_point(p, to_eye));
    }

    const Scene& scene_;
    const Point3& eye_;
};

} // namespace

std::vector<SeenLuminaire> see_luminaires(const Scene& scene, const Point3& eye) {
    const Eye at(scene, eye);
    std::vector<SeenLuminaire> all;
    for (std::size_t i = 0; i < scene.luminaires.size(); ++i) {
        SeenLuminaire seen = at.see(i);
        if (!seen.parts.empty() || seen.is_point)
            all.push_back(std::move(seen));
    }
    return all;
}

} // namespace isolux
