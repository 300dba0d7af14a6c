#include "isolux/calc/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

namespace isolux {

namespace {

/// A face steeper than this counts as upright.
constexpr double upright_normal_z = 1e-3;

/// Corners closer than this are the same corner, m.
constexpr double same_place = 1e-6;

/// Silhouettes with more edges than this are too fine for paper.
constexpr std::size_t most_edges = 4000;

using Corner = std::array<long long, 3>;

long long snap(double v) { return std::llround(v / same_place); }

Corner snap(const Point3& p) { return {snap(p.x), snap(p.y), snap(p.z)}; }

Point2 plan_point(const Corner& c) {
    return {static_cast<double>(c[0]) * same_place, static_cast<double>(c[1]) * same_place};
}

/// How many faces of each tendency meet at an edge.
struct EdgeFaces {
    int up = 0;
    int down = 0;
    int upright = 0;
};

using EdgeMap = std::map<std::pair<Corner, Corner>, EdgeFaces>;

EdgeMap collect_edges(const std::vector<SceneTriangle>& triangles) {
    EdgeMap edges;
    for (const SceneTriangle& t : triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            Corner a = snap(t.corner[k]);
            Corner b = snap(t.corner[(k + 1) % 3]);
            if (b < a)
                std::swap(a, b);
            EdgeFaces& faces = edges[{a, b}];
            const double nz = t.normal.z();
            ++(nz > upright_normal_z ? faces.up
                                     : (nz < -upright_normal_z ? faces.down : faces.upright));
        }
    return edges;
}

using Segment = std::array<long long, 4>;

/// Edges where the face turns away from the eye above; each line on paper once.
template <class Wanted> std::set<Segment> project(const EdgeMap& edges, Wanted wanted) {
    std::set<Segment> segments;
    for (const auto& [edge, faces] : edges) {
        Segment s{edge.first[0], edge.first[1], edge.second[0], edge.second[1]};
        if (!wanted(faces) || (s[0] == s[2] && s[1] == s[3]))
            continue;
        if (std::tie(s[2], s[3]) < std::tie(s[0], s[1]))
            s = {s[2], s[3], s[0], s[1]};
        segments.insert(s);
    }
    return segments;
}

bool is_silhouette(const EdgeFaces& f) {
    return f.up <= 1 && f.down <= 1 && f.up + f.down >= 1;
}

bool is_foot(const EdgeFaces& f) { return f.up + f.down == 0; }

double cross(const Point2& o, const Point2& a, const Point2& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Name of the thing a surface belongs to: "office" of "office/floor".
std::string owner(const std::string& name) { return name.substr(0, name.rfind('/')); }

struct Extents {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

bool is_round(OpeningShape s) {
    return s == OpeningShape::ellipse || s == OpeningShape::vertical_cylinder
           || s == OpeningShape::ellipsoid;
}

/// "wall 2" of "office/wall 2"; nothing of "desk 1".
std::string part_of(const std::string& name) {
    const std::size_t slash = name.rfind('/');
    return slash == std::string::npos ? std::string{} : name.substr(slash + 1);
}

/// One for each surface. Bodies of luminaires are left out.
std::vector<PlanFinish> find_finishes(const Scene& scene) {
    std::vector<PlanFinish> finishes;
    for (const Surface& s : scene.surfaces) {
        if (s.triangles == 0)
            continue;
        const MaterialId id = scene.triangles[s.first_triangle].material;
        if (id.index() + 1 == scene.materials.size())
            continue;
        const Material& material = scene.material(id);
        PlanFinish f{owner(s.name), part_of(s.name), material.name, s.area};
        f.is_room = s.is_shell;
        if (const auto* opaque = std::get_if<Opaque>(&material.scattering)) {
            f.reflectance = luminance_sum(opaque->diffuse);
            f.mirror = opaque->mirror;
        } else if (const auto* pane = std::get_if<ClearPane>(&material.scattering)) {
            const SlabOptics optics = evaluate_slab(*pane, 1.0);
            f.mirror = optics.reflectance;
            f.transmittance = optics.transmittance;
        }
        finishes.push_back(std::move(f));
    }
    return finishes;
}

} // namespace

Polyline convex_hull(Polyline points) {
    std::sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
        return std::tie(a.x, a.y) < std::tie(b.x, b.y);
    });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3)
        return points;
    // Andrew's monotone chain: lower side left to right, upper side back.
    Polyline hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t base = hull.size();
        for (const Point2& p : points) {
            while (hull.size() >= base + 2
                   && cross(hull[hull.size() - 2], hull.back(), p) <= 0.0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

PlanOutline make_outline(std::string name, const std::vector<SceneTriangle>& triangles) {
    PlanOutline outline;
    outline.name = std::move(name);
    outline.lower = std::numeric_limits<double>::infinity();
    outline.upper = -outline.lower;
    Polyline corners;
    for (const SceneTriangle& t : triangles) {
        for (const Point3& c : t.corner) {
            outline.lower = std::min(outline.lower, c.z);
            outline.upper = std::max(outline.upper, c.z);
            corners.push_back({c.x, c.y});
        }
        if (std::abs(t.normal.z()) > upright_normal_z)
            outline.faces.push_back({{t.corner[0].x, t.corner[0].y},
                                     {t.corner[1].x, t.corner[1].y},
                                     {t.corner[2].x, t.corner[2].y}});
    }
    const EdgeMap edges = collect_edges(triangles);
    std::set<Segment> segments = project(edges, is_silhouette);
    if (segments.empty())
        segments = project(edges, is_foot);
    if (segments.size() > most_edges || outline.faces.size() > most_edges) {
        outline.faces = {convex_hull(std::move(corners))};
        outline.lines = outline.faces;
        outline.lines.front().push_back(outline.lines.front().front());
        return outline;
    }
    for (const Segment& s : segments)
        outline.lines.push_back({plan_point({s[0], s[1], 0}), plan_point({s[2], s[3], 0})});
    return outline;
}

Polyline body_outline(const LuminousOpening& body, const Frame& world_from_luminaire) {
    if (std::max({in_metre(body.extent_x), in_metre(body.extent_y), in_metre(body.extent_z)})
        <= same_place)
        return {};
    const Extents half{0.5 * in_metre(body.extent_x),
                       0.5 * in_metre(body.extent_y),
                       0.5 * in_metre(body.extent_z)};
    constexpr int corners_of_a_circle = 48;
    const int corners = is_round(body.shape) ? corners_of_a_circle : 4;
    const double stretch = is_round(body.shape) ? 1.0 : std::numbers::sqrt2;
    Polyline points;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.5) / corners;
        for (const double side : {-1.0, 1.0}) {
            const Point3 p =
                world_from_luminaire.point_from_local({stretch * half.x * std::cos(angle),
                                                       stretch * half.y * std::sin(angle),
                                                       side * half.z});
            points.push_back({p.x, p.y});
        }
    }
    return convex_hull(std::move(points));
}

PlanLuminaire make_plan_luminaire(std::string name,
                                  std::size_t type,
                                  const LuminousOpening& body,
                                  const Frame& frame) {
    PlanLuminaire l;
    l.name = std::move(name);
    l.type = type;
    l.position = frame.origin;
    l.body = body_outline(body, frame);
    l.c0 = {frame.x.x(), frame.x.y()};
    l.nadir = {-frame.z.x(), -frame.z.y()};
    l.frame = frame;
    return l;
}

Plan make_plan(const Scene& scene) {
    Plan plan;
    std::map<std::string, std::vector<SceneTriangle>> floors;
    std::map<std::string, std::vector<SceneTriangle>> objects;
    std::map<std::string, double> ceiling;
    for (const SceneTriangle& t : scene.triangles) {
        const Surface& surface = scene.surfaces[t.surface.index()];
        const std::string name = owner(surface.name);
        if (!surface.is_shell) {
            // The last material is the black of luminaires' bodies.
            if (t.material.index() + 1 != scene.materials.size())
                objects[name].push_back(t);
            continue;
        }
        if (t.normal.z() > 0.5)
            floors[name].push_back(t);
        double& top = ceiling.try_emplace(name, t.corner[0].z).first->second;
        for (const Point3& c : t.corner)
            top = std::max(top, c.z);
    }
    for (const auto& [name, triangles] : floors) {
        plan.rooms.push_back(make_outline(name, triangles));
        plan.rooms.back().upper = ceiling.at(name);
    }
    for (const auto& [name, triangles] : objects)
        plan.objects.push_back(make_outline(name, triangles));
    plan.openings = scene.openings;
    plan.finishes = find_finishes(scene);
    for (const LuminaireType& type : scene.luminaire_types)
        plan.types.push_back(make_plan_type(type));
    for (const Luminaire& luminaire : scene.luminaires) {
        const LuminairePlacement& p = luminaire.placement;
        plan.luminaires.push_back(make_plan_luminaire(
            p.name, p.type.index(), plan.types[p.type.index()].body, p.world_from_luminaire));
        plan.luminaires.back().scale = p.scale;
        plan.luminaires.back().group = p.group;
    }
    return plan;
}

} // namespace isolux
