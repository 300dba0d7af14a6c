#pragma once

#include <string>
#include <vector>

#include "isolux/scene/scene.h"
#include "isolux/viz/drawing.h"

namespace isolux {

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
    Point3 position;      ///< photometric centre
    Polyline body;        ///< outline to scale, convex; empty for a point
    Point2 c0;            ///< direction of C0 seen from above, length 0 (upright) to 1
    Point2 nadir;         ///< direction of gamma 0 seen from above, length 0 (down) to 1
};

struct PlanType {
    std::string name;
    double flux = 0.0; ///< lm, of one luminaire of the type, before dimming and maintenance
};

/// What floor plans and maps show of a scene besides light. Extracted once, drawn often.
struct Plan {
    std::vector<PlanOutline> rooms;   ///< floors with their holes; z range floor to ceiling
    std::vector<PlanOutline> objects; ///< furniture and imports, not bodies of luminaires
    std::vector<PlanLuminaire> luminaires;
    std::vector<PlanType> types;
};

[[nodiscard]] Plan make_plan(const Scene& scene);

/// Outline of a luminaire's body (or opening, where the file tells no body) from above.
/// Empty if it has no size.
[[nodiscard]] Polyline body_outline(const LuminaireType& type,
                                    const Frame& world_from_luminaire);

/// A thing's outline from its triangles.
/// Closed bodies give their silhouette edges and upward faces, upright sheets the lines they
/// stand on. Very detailed meshes are replaced by their convex hull.
[[nodiscard]] PlanOutline make_outline(std::string name,
                                       const std::vector<SceneTriangle>& triangles);

/// Convex hull, counter-clockwise; fewer than three points come back as they are.
[[nodiscard]] Polyline convex_hull(Polyline points);

} // namespace isolux
