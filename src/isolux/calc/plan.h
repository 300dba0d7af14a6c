#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/scene/intensity_curve.h"
#include "isolux/scene/luminaire_body.h"
#include "isolux/scene/scene.h"

namespace isolux {

using Polyline = std::vector<Point2>;

/// A thing seen from above, in world x and y.
struct PlanOutline {
    std::string name;
    std::vector<Polyline> lines; ///< what a draughtsman draws
    std::vector<Polyline> faces; ///< closed; painted they cover what the thing covers
    double lower = 0.0;          ///< m, z range
    double upper = 0.0;
};

struct PlanLuminaire {
    std::string name;
    std::size_t type = 0; ///< index into Plan::types
    Point3 position{};    ///< photometric centre
    Polyline body{};      ///< outline to scale, convex; empty for a point
    Point2 c0{};          ///< direction of C0 seen from above, length 0 (upright) to 1
    Point2 nadir{};       ///< direction of gamma 0 seen from above, length 0 (down) to 1
    Frame frame{};        ///< world from luminaire; its origin is `position`
    double scale = 1.0;   ///< dimming times maintenance factor
    std::string group{};  ///< dimming group; may be empty
};

/// One luminaire type: what a schedule and its diagrams say about it.
struct PlanType {
    std::string name;
    double flux = 0.0;    ///< lm, of one luminaire of the type, before dimming and maintenance
    std::string file{};   ///< as the project names it; empty without a file
    std::string format{}; ///< of the file, in words
    std::string manufacturer{};
    std::string product{};
    std::string catalogue_number{};
    std::string lamps{};
    std::string symmetry{};
    double reference_flux = 0.0; ///< lm, what "per kilolumen" refers to
    double watts = 0.0;          ///< 0: the file states none
    std::optional<double> light_output_ratio = std::nullopt;
    double downward_share = 1.0;
    double maximum = 0.0;                          ///< cd
    double maximum_c = 0.0;                        ///< degrees, where it is
    double maximum_gamma = 0.0;                    ///< degrees
    std::optional<double> beam_c0 = std::nullopt;  ///< degrees, full width at half maximum
    std::optional<double> beam_c90 = std::nullopt; ///< in the planes C0-C180 and C90-C270
    LuminousOpening opening{};
    LuminousOpening body{};
    std::optional<LongSide> long_side = std::nullopt;
    bool align_length_axis = false; ///< the project asked for the length along x
    PolarCurves curves{};
};

/// What a piece of a room or an object is made of.
struct PlanFinish {
    std::string owner;          ///< room or object
    std::string part;           ///< "floor", "wall 2", ...; empty for an object of one piece
    std::string material;       ///< its name; may be empty
    double area = 0.0;          ///< m2
    double reflectance = 0.0;   ///< diffuse, of white light
    double mirror = 0.0;        ///< share reflected as by a mirror
    double transmittance = 0.0; ///< of a pane, at normal incidence
    bool is_room = false;
};

/// What floor plans, maps and reports show of a scene besides light. Extracted once, drawn
/// often.
struct Plan {
    std::vector<PlanOutline> rooms;   ///< floors with their holes; z range floor to ceiling
    std::vector<PlanOutline> objects; ///< furniture and imports, not bodies of luminaires
    std::vector<PlanLuminaire> luminaires;
    std::vector<PlanType> types;
    std::vector<SceneOpening> openings{}; ///< doors, windows and holes in walls
    std::vector<PlanFinish> finishes{};
};

[[nodiscard]] Plan make_plan(const Scene& scene);

/// The facts of a luminaire type. Beam angles and shares come from the file's table; a panel
/// without a file is Lambertian.
[[nodiscard]] PlanType make_plan_type(const LuminaireType& type);

/// Records which types the project has laid along x, Project::length_aligned.
void mark_aligned(Plan& plan, std::span<const std::string> types);

/// A luminaire in the plan: body and arrows from type and frame.
[[nodiscard]] PlanLuminaire make_plan_luminaire(std::string name,
                                                std::size_t type,
                                                const LuminousOpening& body,
                                                const Frame& world_from_luminaire);

/// Outline of a body from above. Empty if it has no size.
[[nodiscard]] Polyline body_outline(const LuminousOpening& body,
                                    const Frame& world_from_luminaire);

/// A thing's outline from its triangles.
/// Closed bodies give their silhouette edges and upward faces, upright sheets the lines they
/// stand on. Very detailed meshes are replaced by their convex hull.
[[nodiscard]] PlanOutline make_outline(std::string name,
                                       const std::vector<SceneTriangle>& triangles);

/// Convex hull, counter-clockwise; fewer than three points come back as they are.
[[nodiscard]] Polyline convex_hull(Polyline points);

} // namespace isolux
