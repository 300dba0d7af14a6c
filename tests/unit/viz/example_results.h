#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "isolux/calc/plan.h"
#include "isolux/calc/results.h"

/// Made-up results and plans that look like real ones, for the tests of the pictures.
namespace isolux::examples {

/// E(x, y) in lx on a grid.
using Field = std::function<double(double u, double v)>;

inline SurfaceResult make_result(std::string name,
                                 const Frame& frame,
                                 double width,
                                 double height,
                                 GridCounts counts,
                                 const Field& field,
                                 std::vector<Point3> outline = {}) {
    SurfaceResult result;
    result.surface = make_grid_surface(std::move(name),
                                       frame,
                                       Metre(width),
                                       Metre(height),
                                       counts,
                                       std::move(outline),
                                       IlluminanceKind::planar,
                                       UnitVector3(Vector3{1, 0, 0}));
    double sum = 0.0;
    double low = HUGE_VAL;
    double high = 0.0;
    for (const Receiver& r : result.surface.receivers) {
        const Vector3 local = frame.point_to_local(r.point);
        const double e = field(local.x, local.y);
        PointResult p;
        p.total = {e, 0.004 * e, 32};
        p.direct = {0.7 * e, 0.0, 32};
        p.indirect = {0.3 * e, 0.004 * e, 32};
        result.points.push_back(p);
        sum += e;
        low = std::min(low, e);
        high = std::max(high, e);
    }
    const double mean = sum / static_cast<double>(result.points.size());
    result.summary.mean = {mean, 0.003 * mean, 32};
    result.summary.minimum = {low, 0.006 * low, 32};
    result.summary.maximum = {high, 0.005 * high, 32};
    result.summary.uniformity = {low / mean, 0.004 * low / mean, 32};
    result.summary.plug_in_minimum = low;
    result.summary.plug_in_maximum = high;
    result.converged = true;
    return result;
}

/// Spots of light below a field of luminaires, plus a floor of reflected light.
inline Field below(std::vector<PlanLuminaire> luminaires, double candela, double rise) {
    return [=, all = std::move(luminaires)](double x, double y) {
        double e = 40.0;
        for (const PlanLuminaire& l : all) {
            const double d2 =
                std::pow(x - l.position.x, 2) + std::pow(y - l.position.y, 2) + rise * rise;
            e += candela * rise * rise / (d2 * d2);
        }
        return e;
    };
}

inline std::vector<PlanLuminaire> make_field_of_luminaires(
    double width, double depth, std::size_t columns, std::size_t rows, Point2 body) {
    std::vector<PlanLuminaire> all;
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i) {
            const double x =
                width * (static_cast<double>(i) + 0.5) / static_cast<double>(columns);
            const double y = depth * (static_cast<double>(j) + 0.5) / static_cast<double>(rows);
            PlanLuminaire l{"L", 0, {x, y, 2.6}, {}, {1, 0}, {0, 0}};
            if (body.x > 0.0)
                l.body = {{x - body.x / 2, y - body.y / 2},
                          {x + body.x / 2, y - body.y / 2},
                          {x + body.x / 2, y + body.y / 2},
                          {x - body.x / 2, y + body.y / 2}};
            all.push_back(std::move(l));
        }
    return all;
}

inline PlanOutline make_block(std::string name, Polyline corners, double lower, double upper) {
    PlanOutline o{std::move(name), {}, {corners}, lower, upper};
    for (std::size_t k = 0; k < corners.size(); ++k)
        o.lines.push_back({corners[k], corners[(k + 1) % corners.size()]});
    return o;
}

inline PlanOutline make_box(std::string name, double x, double y, double w, double d) {
    return make_block(
        std::move(name), {{x, y}, {x + w, y}, {x + w, y + d}, {x, y + d}}, 0, 0.72);
}

inline Frame frame_at(double x, double y, double z) {
    Frame f;
    f.origin = {x, y, z};
    return f;
}

/// An open office, 12 x 9 m: 40 luminaires, desks, a work plane with an edge band of 0.5 m.
inline std::pair<SurfaceResult, Plan> open_office() {
    Plan plan;
    plan.types = {{"Linear direct/indirect 1200", 4200.0}};
    plan.rooms = {make_block("open office", {{0, 0}, {12, 0}, {12, 9}, {0, 9}}, 0, 3)};
    plan.luminaires = make_field_of_luminaires(12, 9, 8, 5, {1.2, 0.2});
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 3; ++j) {
            plan.objects.push_back(make_box("desk", 0.9 + 2.2 * i, 1.0 + 2.7 * j, 1.6, 0.8));
            plan.objects.push_back(make_box("desk", 0.9 + 2.2 * i, 1.85 + 2.7 * j, 1.6, 0.8));
        }
    plan.objects.push_back(make_box("cupboard", 11.5, 2, 0.45, 4));
    const auto light = below(plan.luminaires, 330.0, 2.05);
    auto result = make_result("open office / work plane",
                              frame_at(0.5, 0.5, 0.75),
                              11,
                              8,
                              {18, 13},
                              [=](double u, double v) { return light(u + 0.5, v + 0.5); });
    return {std::move(result), std::move(plan)};
}

/// An L of two corridors 2 m wide; the second leg sees no luminaire.
inline std::pair<SurfaceResult, Plan> l_corridor() {
    const Polyline l{{0, 0}, {10, 0}, {10, 8}, {8, 8}, {8, 2}, {0, 2}};
    Plan plan;
    plan.types = {{"Downlight", 900.0}};
    plan.rooms = {make_block("corridor", l, 0, 2.6)};
    plan.luminaires = make_field_of_luminaires(7, 2, 4, 1, {0.0, 0.0});
    std::vector<Point3> outline;
    for (const Point2& p : l)
        outline.push_back({p.x, p.y, 0.02});
    auto result = make_result(
        "corridor / floor",
        frame_at(0, 0, 0.02),
        10,
        8,
        {40, 32},
        [](double u, double v) {
            const double bend = u > 8.0 && v > 2.0 ? v - 2.0 : 0.0;
            return bend > 0.0 ? 38.0 * std::exp(-0.9 * bend) + 1.4
                              : 40.0
                                    + 90.0 * std::exp(-0.15 * (u - 3.5) * (u - 3.5))
                                          * std::cos(0.7 * (v - 1.0));
        },
        outline);
    return {std::move(result), std::move(plan)};
}

} // namespace isolux::examples
