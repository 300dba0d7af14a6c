#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "isolux/sampling/warp.h"
#include "isolux/scene/scene.h"
#include "isolux/transport/light_grid.h"
#include "isolux/transport/table_sampler.h"

namespace isolux {

/// A place on a luminaire from which light may leave.
struct EmissionPoint {
    std::size_t luminaire = 0;
    std::size_t facet = 0; ///< of the opening; not used for a point source
    Point3 position;
};

/// The start of a light path. Its flux is the flux of all luminaires together, whatever was
/// drawn, because every draw is exact.
struct EmissionSample {
    EmissionPoint from;
    UnitVector3 direction;
    double strength = 0.0; ///< Emission::evaluate of the two
};

/// An emission point drawn to light a given place, and the density it was drawn with: per m2 of
/// opening, the choice of the luminaire included; for a point source that choice alone.
struct TowardsSample {
    EmissionPoint from;
    double density = 0.0;
};

/// How points of a flat rectangle are drawn for a place near it.
enum class OpeningDraw : std::uint8_t {
    solid_angle, ///< half of them evenly in solid angle
    area         ///< all of them evenly on the area
};

/// One luminaire's opening as a place sees it: what it takes to draw points of it, worked out
/// once.
class OpeningView {
public:
    /// @param luminaire  number of `of` in its scene
    /// @param by         near flat rectangles may be left to their area, which is quicker
    OpeningView(const Luminaire& of,
                std::size_t luminaire,
                const Point3& place,
                OpeningDraw by = OpeningDraw::solid_angle) noexcept;

    /// A point of the opening for the light that falls on the place: uniform on the area; near
    /// flat rectangles half of the points evenly in solid angle; on a solid opening only the
    /// facets that face the place.
    [[nodiscard]] EmissionPoint sample(double u, double v) const noexcept;

    /// Density of sample(), per m2 (1 for a point source); 0 if no light can come.
    [[nodiscard]] double pdf(const EmissionPoint& from) const noexcept;

private:
    const Luminaire* of_;
    std::size_t luminaire_;
    Point3 place_;
    std::optional<SphericalRectangle> rectangle_; ///< where it is worth it
    double weights_ = 0.0;                        ///< solid openings: sum over the facets
};

/// All luminaires of a scene as sources of light: METHODS "Luminaires", "The Markov chain" 1-3.
/// Refers to the scene, which must outlive it.
class Emission {
public:
    explicit Emission(const Scene& scene);

    /// lm, all factors applied; 0 when nothing shines
    [[nodiscard]] double total_flux() const noexcept { return total_flux_; }

    [[nodiscard]] std::size_t luminaires() const noexcept { return scene_->luminaires.size(); }

    [[nodiscard]] const Luminaire& luminaire(std::size_t l) const noexcept {
        return scene_->luminaires[l];
    }

    /// Luminaire by flux, direction by intensity, place uniform on the opening (on a solid
    /// opening: by the area it shows in that direction). @pre total_flux() > 0, numbers in [0,
    /// 1)
    [[nodiscard]] EmissionSample sample_emission(double u_luminaire,
                                                 double u_place,
                                                 double v_place,
                                                 double u_direction,
                                                 double v_direction) const noexcept;

    [[nodiscard]] OpeningView view(std::size_t luminaire,
                                   const Point3& place,
                                   OpeningDraw by = OpeningDraw::solid_angle) const noexcept {
        return {scene_->luminaires[luminaire], luminaire, place, by};
    }

    /// The luminaires' light tree, where they are many; else null.
    [[nodiscard]] const LightTree* tree() const noexcept {
        return luminaires() > LuminairePick::most ? &lights_.tree() : nullptr;
    }

    /// A point on some luminaire for the light that falls on `place`. Luminaires, and where
    /// they are many also groups of them, are picked by their intensity towards it over squared
    /// distance.
    [[nodiscard]] TowardsSample
    sample_towards(const Point3& place, double u_luminaire, double u, double v) const noexcept;

    /// Density of sample_towards for a given emission point.
    [[nodiscard]] double pdf_towards(const Point3& place,
                                     const EmissionPoint& from) const noexcept;

    /// Intensity towards `w` per area of opening, cd/m2 (for a point source: cd). Without a
    /// cosine: the table holds it.
    [[nodiscard]] double evaluate(const EmissionPoint& from,
                                  const UnitVector3& w) const noexcept;

    /// Where a ray that leaves `from` along `w` starts, clear of the opening's own body and of
    /// anything the opening lies on. Shadow rays end there too.
    [[nodiscard]] Point3 departure(const EmissionPoint& from,
                                   const UnitVector3& w) const noexcept;

    [[nodiscard]] Rgb colour(std::size_t luminaire) const noexcept;

    /// Whether the line through `origin` along `w` can meet the luminaire's opening: whether it
    /// comes as near to its photometric centre as the opening's farthest corner.
    [[nodiscard]] bool is_near_line(std::size_t luminaire,
                                    const Point3& origin,
                                    const UnitVector3& w) const noexcept {
        const Source& s = sources_[luminaire];
        const Vector3 d = s.centre - origin;
        const double along = dot(d, w);
        return length_squared(d) - along * along <= s.reach_squared;
    }

private:
    /// Of the luminaire's type, cd.
    [[nodiscard]] double intensity(std::size_t luminaire, const UnitVector3& w) const noexcept;

    /// What `evaluate` makes of it.
    [[nodiscard]] double
    per_area(const EmissionPoint& from, const UnitVector3& w, double candela) const noexcept;
    [[nodiscard]] EmissionPoint place_on_solid(std::size_t luminaire,
                                               const UnitVector3& w,
                                               double u,
                                               double v) const noexcept;

    struct Source {
        const LuminaireType* type = nullptr;
        const TableSampler* table = nullptr; ///< absent for sources without a file
        double flux = 0.0;                   ///< lm
        double area = 0.0;                   ///< m2 of all facets
        Point3 centre;
        double reach_squared =
            0.0; ///< m2, from the centre to the farthest corner; 0: no opening
    };

    const Scene* scene_;
    std::vector<TableSampler> tables_; ///< one for each luminaire type with a table
    std::vector<Source> sources_;
    CumulativeTable by_flux_;
    double total_flux_ = 0.0;
    LightGrid lights_;
};

} // namespace isolux
