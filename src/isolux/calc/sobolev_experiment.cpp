#include "isolux/calc/sobolev_experiment.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "isolux/base/check.h"
#include "isolux/base/parallel.h"
#include "isolux/calc/selftest_scenes.h"
#include "isolux/calc/sobolev_walk.h"
#include "isolux/transport/light_path.h"

namespace isolux {

namespace {

constexpr std::size_t replicates = 16;

/// Work at 1: light paths of a replicate without a scene, units of work with one.
constexpr double walked_paths = 1 << 16;
constexpr double counted_paths = 1 << 18;
constexpr double traced_paths = 1 << 16;
constexpr double local_units = 48.0;
constexpr double mis_units = 24.0;
constexpr double tracing_units = 128.0;

double cpu_seconds() noexcept {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

std::size_t at_least_one(double count) noexcept {
    return static_cast<std::size_t>(std::max(1.0, std::round(count)));
}

std::vector<SobolevPlace> make_places(const SobolevTask& task) {
    std::vector<SobolevPlace> places;
    for (const SobolevPlane plane : {SobolevPlane::one, SobolevPlane::two})
        for (const double r : task.radii) {
            const Ring ring = ring_around(r, task.ring_width);
            const Metre inner(ring.inner);
            const Metre outer(ring.outer);
            places.push_back(
                {plane,
                 r,
                 in_lux(sobolev_illuminance(task.problem, plane, Metre(r))),
                 in_lux(sobolev_direct_ring(task.problem, plane, inner, outer)
                        + sobolev_indirect_ring(task.problem, plane, inner, outer))});
        }
    return places;
}

std::vector<Ring> make_rings(const SobolevTask& task) {
    std::vector<Ring> rings;
    for (const double r : task.radii)
        rings.push_back(ring_around(r, task.ring_width));
    return rings;
}

/// Replicate values to estimates.
std::vector<Estimate> to_estimates(const std::vector<std::vector<double>>& rows) {
    std::vector<Estimate> estimates;
    for (std::size_t k = 0; k < rows.front().size(); ++k) {
        std::vector<double> values;
        for (const std::vector<double>& row : rows)
            values.push_back(row[k]);
        estimates.push_back(estimate_from_replicates(values));
    }
    return estimates;
}

SobolevMethod make_method(const char* name, SobolevTarget target, double seconds) {
    SobolevMethod method;
    method.name = name;
    method.target = target;
    method.cpu_seconds = seconds;
    return method;
}

/// Direct simulation without a scene: everything counted, and only what was reflected.
std::vector<SobolevMethod> run_counting(const SobolevTask& task,
                                        const std::vector<SobolevPlace>& places) {
    const std::vector<Ring> rings = make_rings(task);
    const double start = cpu_seconds();
    std::vector<std::vector<double>> total(replicates);
    std::vector<std::vector<double>> reflected(replicates);
    for_each_index(replicates, 1, [&](std::size_t r) {
        PlaneValues v = count_on_rings(task.problem,
                                       rings,
                                       at_least_one(counted_paths * task.work),
                                       task.seed,
                                       static_cast<std::uint32_t>(r));
        total[r] = std::move(v.total);
        reflected[r] = std::move(v.reflected);
    });
    const double seconds = cpu_seconds() - start;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Ring& ring = rings[k % rings.size()];
        const double direct = in_lux(sobolev_direct_ring(
            task.problem, places[k].plane, Metre(ring.inner), Metre(ring.outer)));
        for (std::vector<double>& row : reflected)
            row[k] += direct;
    }
    std::vector<SobolevMethod> methods{
        make_method(sobolev_method::counting, SobolevTarget::ring, seconds),
        make_method(sobolev_method::counting_reflected, SobolevTarget::ring, seconds)};
    methods[0].values = to_estimates(total);
    methods[1].values = to_estimates(reflected);
    return methods;
}

SobolevMethod run_walk(const SobolevTask& task) {
    const double start = cpu_seconds();
    std::vector<std::vector<double>> rows(replicates);
    for_each_index(replicates, 1, [&](std::size_t r) {
        rows[r] = estimate_between_planes(task.problem,
                                          task.radii,
                                          at_least_one(walked_paths * task.work),
                                          task.seed,
                                          static_cast<std::uint32_t>(r))
                      .total;
    });
    SobolevMethod method =
        make_method(sobolev_method::walk, SobolevTarget::point, cpu_seconds() - start);
    method.values = to_estimates(rows);
    return method;
}

/// The flux that one vertex of a traced path brought there, lm.
double arriving_flux(const PathVertex& v, double reflectance) noexcept {
    return std::numbers::pi * luminance_sum(v.radiant) / reflectance;
}

SobolevMethod
run_traced_counting(const SobolevTask& task, const Scene& scene, const Emission& emission) {
    const std::vector<Ring> rings = make_rings(task);
    const std::size_t n = rings.size();
    const std::size_t paths = at_least_one(traced_paths * task.work);
    const Point3 foot = scene.luminaires.front().placement.world_from_luminaire.origin;
    const double start = cpu_seconds();
    std::vector<std::vector<double>> rows(replicates, std::vector<double>(2 * n, 0.0));
    for_each_index(replicates, 1, [&](std::size_t r) {
        const PathRandomness random(task.seed, static_cast<std::uint32_t>(r));
        std::vector<PathVertex> vertices;
        for (std::size_t i = 0; i < paths; ++i) {
            vertices.clear();
            walk_light_path(scene, emission, random, i, vertices);
            for (const PathVertex& v : vertices) {
                const bool is_lower = v.normal.z() > 0.0;
                const double d = std::hypot(v.position.x - foot.x, v.position.y - foot.y);
                const double flux = arriving_flux(
                    v, is_lower ? task.problem.reflectance_1 : task.problem.reflectance_2);
                for (std::size_t k = 0; k < n; ++k)
                    if (d >= rings[k].inner && d < rings[k].outer)
                        rows[r][k + (is_lower ? 0 : n)] += flux;
            }
        }
        for (std::size_t k = 0; k < 2 * n; ++k)
            rows[r][k] /= static_cast<double>(paths) * rings[k % n].area();
    });
    SobolevMethod method = make_method(
        sobolev_method::counting_traced, SobolevTarget::ring, cpu_seconds() - start);
    method.values = to_estimates(rows);
    return method;
}

SobolevMethod run_engine(const SobolevTask& task,
                         const Scene& scene,
                         const std::vector<SobolevPlace>& places,
                         const char* name,
                         Estimator estimator,
                         double units) {
    CalculationSurface surface;
    surface.name = name;
    for (const SobolevPlace& p : places)
        surface.receivers.push_back(
            make_sobolev_receiver(task.problem, p.plane, Metre(p.radius)));
    Settings settings;
    settings.estimator = estimator;
    settings.seed = task.seed;
    settings.fixed_units = at_least_one(units * task.work);
    const Results results = calculate(scene, {&surface, 1}, settings);
    SobolevMethod method = make_method(name, SobolevTarget::point, results.cpu_seconds);
    for (const PointResult& p : results.surfaces.front().points)
        method.values.push_back(p.total);
    return method;
}

void judge(SobolevMethod& method, const std::vector<SobolevPlace>& places) noexcept {
    double errors = 0.0;
    double biases = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const SobolevPlace& p = places[k];
        const Estimate& e = method.values[k];
        const double target = method.target == SobolevTarget::ring ? p.ring_mean : p.exact;
        errors += std::pow(e.standard_error / p.exact, 2);
        biases += std::pow(target / p.exact - 1.0, 2);
        if (e.standard_error > 0.0)
            method.worst_z =
                std::max(method.worst_z, std::abs(e.mean - target) / e.standard_error);
    }
    const double n = static_cast<double>(places.size());
    method.relative_error = std::sqrt(errors / n);
    method.bias = std::sqrt(biases / n);
}

} // namespace

double SobolevMethod::seconds_to(double share) const noexcept {
    const double ratio = relative_error / share;
    return cpu_seconds * ratio * ratio;
}

SobolevComparison
compare_sobolev(const SobolevTask& task,
                const std::function<void(const std::string&, double)>& progress) {
    ISOLUX_EXPECT(task.problem.reflectance_1 > 0.0 && task.problem.reflectance_2 > 0.0);
    ISOLUX_EXPECT(!task.radii.empty() && task.ring_width > 0.0);
    const auto tell = [&](const char* name, double share) {
        if (progress)
            progress(name, share);
    };
    namespace m = sobolev_method;
    SobolevComparison comparison{task, make_places(task), {}};
    const std::vector<SobolevPlace>& places = comparison.places;
    std::vector<SobolevMethod>& methods = comparison.methods;
    tell(m::counting, 0.0);
    methods = run_counting(task, places);
    tell(m::walk, 0.2);
    methods.push_back(run_walk(task));
    const Scene scene = build_scene(make_sobolev_plates(task.problem));
    const Emission emission(scene);
    tell(m::counting_traced, 0.3);
    methods.push_back(run_traced_counting(task, scene, emission));
    tell(m::local, 0.5);
    methods.push_back(
        run_engine(task, scene, places, m::local, Estimator::local_estimation, local_units));
    tell(m::mis, 0.65);
    methods.push_back(
        run_engine(task, scene, places, m::mis, Estimator::local_estimation_mis, mis_units));
    tell(m::path_tracing, 0.8);
    methods.push_back(run_engine(
        task, scene, places, m::path_tracing, Estimator::path_tracing, tracing_units));
    for (SobolevMethod& method : methods)
        judge(method, places);
    return comparison;
}

} // namespace isolux
