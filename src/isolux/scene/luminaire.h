#pragma once

#include <string>
#include <variant>
#include <vector>

#include "isolux/base/colour.h"
#include "isolux/base/frame.h"
#include "isolux/base/ids.h"
#include "isolux/base/units.h"
#include "isolux/photometry/luminaire_photometry.h"

namespace isolux {

/// A flat, convex piece of a luminous opening. Vertices counter-clockwise seen from the side
/// the normal points to.
struct Facet {
    std::vector<Point3> vertices;
    UnitVector3 normal;
    double area = 0.0; ///< m2
    /// Running sum of the areas of the triangles that fan out from the first vertex, m2, where
    /// there are more than two of them.
    std::vector<double> fan = {};
};

/// How the light leaves the opening (METHODS, "Luminaires").
enum class OpeningForm {
    point, ///< all from one place
    flat,  ///< one facet; every element emits I(w) dA / A to both sides, the table holds the
           ///< cosine
    solid  ///< a closed body; a facet shares I(w) by its projected area
};

struct Opening {
    OpeningForm form = OpeningForm::point;
    std::vector<Facet> facets;      ///< empty for a point
    double largest_dimension = 0.0; ///< m
};

/// A luminance that is the same in every direction on the front of a flat opening; no file
/// needed.
struct LambertianSource {
    Lumen flux;
};

/// The same intensity in every direction from a point; no file needed.
struct IsotropicSource {
    Lumen flux;
};

enum class BodyModel {
    none,     ///< light passes the luminaire
    absorbing ///< the opening is backed by a black panel or filled by a black body
};

struct LuminaireType {
    std::string name;
    std::string file; ///< as the project names it; empty without a file
    std::variant<LambertianSource, IsotropicSource, LuminairePhotometry> source;
    LuminousOpening opening; ///< as in the file, or overridden
    BodyModel body = BodyModel::none;
    double flux_scale = 1.0;   ///< flux override / flux of the interpolant, or 1
    Rgb colour{1.0, 1.0, 1.0}; ///< luminance_sum(colour) == 1
};

/// Where one luminaire hangs. Light of the type times `scale` leaves it.
struct LuminairePlacement {
    std::string name;
    LuminaireTypeId type;
    Frame world_from_luminaire; ///< origin = photometric centre; local -z is gamma 0, +x is C0
    double scale = 1.0;         ///< dimming x maintenance factor
    std::string group;          ///< dimming group; may be empty
};

/// A luminaire as the scene holds it.
struct Luminaire {
    LuminairePlacement placement;
    Opening opening; ///< in world coordinates
    Lumen flux;      ///< all factors applied (interpolant's flux for a table)
};

/// Whether all its light comes from one place, which no ray meets by chance.
[[nodiscard]] inline bool shines_as_point(const Luminaire& l) noexcept {
    return l.opening.form == OpeningForm::point && in_lumen(l.flux) > 0.0;
}

/// Flux of the type itself: the interpolant's (rule L) times `flux_scale`, or the source's own.
[[nodiscard]] Lumen luminous_flux(const LuminaireType& type) noexcept;

/// Intensity of the type towards a direction in its own frame, `flux_scale` applied. For a
/// Lambertian source: Phi / pi cos(angle to the front), which is down, or +x for an upright
/// opening.
[[nodiscard]] Candela luminous_intensity(const LuminaireType& type,
                                         const UnitVector3& local) noexcept;

/// The facets of an opening, in the luminaire's frame. Round outlines become polygons of equal
/// area (METHODS, "Openings").
[[nodiscard]] Opening make_opening(const LuminousOpening& opening);

[[nodiscard]] Opening to_world(const Opening& local, const Frame& world_from_luminaire);

/// Aims a luminaire: nadir towards `aim`, C0 as near as possible to where it was before aiming,
/// then turned by `spin` about its own vertical axis in the sense of `rotation` below.
/// @pre position != aim
[[nodiscard]] Frame make_aimed_frame(const Point3& position, const Point3& aim, Angle spin);

/// Hangs a luminaire by three turns, applied in this order: `rotation` about its own vertical
/// axis, `tilt` about +y so that the nadir tips towards +x, `azimuth` about the world's
/// vertical.
[[nodiscard]] Frame
make_tilted_frame(const Point3& position, Angle rotation, Angle tilt, Angle azimuth);

} // namespace isolux
