#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "isolux/calc/results.h"

#include "support/normal_draws.h"

namespace isolux::test {

/// Made-up results with everything in them: a grid with an outline, single points, odd names,
/// flags, a deterministic surface.
inline SurfaceResult make_surface_result(CalculationSurface surface, std::uint64_t seed) {
    constexpr std::size_t replicates = 16;
    const std::size_t points = surface.receivers.size();
    NormalDraws normal(seed);
    SurfaceResult s{std::move(surface), {}, {replicates, points, {}}, {}, true};
    for (std::size_t i = 0; i < replicates * points; ++i)
        s.replicates.values.push_back(300.0 + 100.0 / 3.0 * static_cast<double>(i % points)
                                      + normal());
    for (std::size_t p = 0; p < points; ++p) {
        std::vector<double> values;
        for (std::size_t r = 0; r < replicates; ++r)
            values.push_back(s.replicates.row(r)[p]);
        PointResult point;
        point.total = estimate_from_replicates(values);
        point.direct = {0.7 * point.total.mean, 0.01 / 3.0, replicates};
        point.indirect = {0.3 * point.total.mean, 0.02 / 3.0, replicates};
        s.points.push_back(point);
    }
    s.summary = summarise(s.replicates);
    return s;
}

/// A verdict, a rating and a room's power of every form there is.
inline void add_decisions(Results& r) {
    Verdict pass;
    pass.requirement = {"EN 1:2021",
                        "34.2",
                        "5; 7",
                        "writing",
                        "Em",
                        "mean",
                        {},
                        {},
                        {},
                        {},
                        {},
                        500.0,
                        "lx",
                        false,
                        "seen",
                        false};
    pass.subject = "office/work \"plane\", 1";
    pass.value = {510.0, 2.0, 16};
    pass.interval = {504.0, 516.0};
    decide(pass);
    Verdict none = pass;
    none.requirement.symbol = "Ra";
    none.requirement.quantity = RequiredQuantity::colour_rendering;
    none.requirement.area = RequiredArea::luminaires;
    none.requirement.is_recalled = true;
    none.requirement.is_recommendation = true;
    none.decision = Decision::not_judged;
    none.reason = "not stated";
    none.value = {};
    none.interval = {};
    none.margin = none.least_margin = 0.0;
    r.verdicts = {pass, none};
    const Estimate half{0.5, 0.01, 16};
    r.modelling = {{1, 0, {half, half}, half, {0.4, 0.01, 16}, {0.6, 0.02, 16}}};
    ObserverGroupResult o;
    o.group.name = "desk";
    o.group.room = "office";
    const UnitVector3 east = UnitVector3::from_unit({1, 0, 0});
    o.group.sight_lines = {{{1, 2, 1.2}, east}, {{1, 2, 1.2}, -east}};
    o.ratings = {{{18.25, 0.05, 16}, {30.0, 0.1, 16}, 12345.5, 9, ""},
                 {{}, {}, 0.0, 0, "no luminaire is in sight"}};
    o.worst = 0;
    o.by_table = 18.5;
    o.table_note = "table method: room 4H x 8H";
    r.observers = {o};
    r.energy = {{"office", 24.0, 216.0, "", 9.0, "work plane", {1.8, 0.01, 16}, 12.5},
                {"store", 4.0, std::nullopt, "not stated", 0.0, "", {}, std::nullopt}};
}

inline Results make_results() {
    const UnitVector3 west = UnitVector3::from_unit({-1, 0, 0});
    const std::vector<Point3> outline{
        {0, 0, 0.75}, {3, 0, 0.75}, {3, 1, 0.75}, {1, 1, 0.75}, {1, 2, 0.75}, {0, 2, 0.75}};
    Results r;
    r.surfaces.push_back(make_surface_result(make_grid_surface("office/work \"plane\", 1",
                                                               Frame{{0, 0, 0.75}},
                                                               Metre(3),
                                                               Metre(2),
                                                               {3, 2},
                                                               outline,
                                                               IlluminanceKind::planar,
                                                               {}),
                                             1));
    CalculationSurface faces{"faces 机房", IlluminanceKind::semi_cylindrical, {}, {}, {}};
    faces.receivers.push_back({{1.0 / 3.0, 2, 1.2}, {}, faces.kind, west});
    faces.receivers.push_back({{1e6, -0.1, 1.2}, {}, faces.kind, west});
    r.surfaces.push_back(make_surface_result(std::move(faces), 2));
    r.surfaces[0].points[1].heavy_tail = true;
    r.surfaces[0].points[1].near_surface = true;
    r.surfaces[1].points[0].suspicious_replicate = true;
    r.surfaces[1].points[1].direct = {123.0, 0.0, 1};
    r.surfaces[1].converged = false;
    r.flux_balance = {{10000.0, 0.0, 1}, {9990.0, 7.0, 16}, {8.5, 0.7, 16}};
    r.rays = {1000, 20000, 300000000000};
    r.wall_seconds = 1.25;
    r.cpu_seconds = 9.5;
    r.interrupted = true;
    r.replicates = 16;
    r.units = 4;
    r.paths = 65536;
    r.estimator = "local estimation";
    r.confidence = 0.97;
    r.looks = 2;
    add_decisions(r);
    r.notices = {{"p.json#/luminaires/2", "outside every room", "Move it in?"},
                 {"", "slow", ""}};
    return r;
}

} // namespace isolux::test
