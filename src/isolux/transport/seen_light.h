#pragma once

#include <cstddef>
#include <cstdint>

#include "isolux/transport/emission.h"

/// Direct light on surfaces that a picture shows, luminaire by luminaire: how much it would be
/// with nothing in the way, and what stands in the way.
namespace isolux {

/// How finely an opening's unshadowed light is summed.
enum class OpeningDetail : std::uint8_t {
    fine,  ///< METHODS eq. (89)
    coarse ///< previews: one point an opening farther away than twice its size
};

/// A point of a luminaire to be looked at from a surface.
struct LightAim {
    SightSegment sight;
    EmissionPoint from;
    UnitVector3 w;      ///< from the luminaire to the surface
    double share = 0.0; ///< cosine / (d2 density); 0: no light comes from there, seen or not
};

/// The luminaires of a scene, seen from surfaces. Refers to its arguments.
class SeenLight {
public:
    SeenLight(const Scene& scene, const Emission& emission);

    [[nodiscard]] std::size_t luminaires() const noexcept { return emission_->luminaires(); }

    /// Illuminance of luminaire `l` on a surface if nothing stands between, lx: exact for point
    /// sources and Lambertian flat openings, a product rule over the opening else. METHODS eq.
    /// (89)
    [[nodiscard]] double unshadowed(std::size_t l,
                                    const Point3& at,
                                    const UnitVector3& normal,
                                    OpeningDetail detail) const noexcept;

    /// A point of the luminaire, chosen by u and v.
    [[nodiscard]] LightAim aim(std::size_t l,
                               const Point3& at,
                               const UnitVector3& normal,
                               double u,
                               double v,
                               OpeningDraw by = OpeningDraw::solid_angle) const noexcept;

    /// Illuminance of the point over its density, lx, if nothing stands between.
    [[nodiscard]] double weight(const LightAim& aim) const noexcept {
        return aim.share > 0.0 ? emission_->evaluate(aim.from, aim.w) * aim.share : 0.0;
    }

    /// Slope d1/d2 - 1 of the opaque surface next to `at` on a line of sight that is known to
    /// be blocked: the smallest there, distances along the luminaire's normal, METHODS eq.
    /// (93).
    [[nodiscard]] double
    occluder_slope(const LightAim& aim, const Point3& at, std::uint64_t& rays) const noexcept;

    /// Towards the side a flat opening shines to; of a solid one, the luminaire's nadir.
    [[nodiscard]] UnitVector3 normal_of(std::size_t l) const noexcept;

private:
    [[nodiscard]] double
    from_centre(std::size_t l, const Point3& at, const UnitVector3& normal) const noexcept;
    [[nodiscard]] double from_facet(std::size_t l,
                                    std::size_t facet,
                                    const Point3& at,
                                    const UnitVector3& normal,
                                    OpeningDetail detail) const noexcept;

    const Scene* scene_;
    const Emission* emission_;
};

} // namespace isolux
