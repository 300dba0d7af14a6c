#include "isolux/calc/efficiency.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "isolux/base/check.h"
#include "isolux/scene/bare_tracer.h"

namespace isolux {

namespace {

/// A point darker than this share of the mean counts with that share.
constexpr double darkest_share = 0.02;

/// Seeds of long runs lie far from those that are measured.
constexpr std::uint64_t reference_seed_step = 0x100000000ULL;

constexpr std::size_t most_units = 1U << 16U;
constexpr std::size_t most_rays = 1U << 15U;
constexpr int turns = 40;

std::vector<Estimate> values_of(const Results& results) {
    std::vector<Estimate> values;
    for (const SurfaceResult& s : results.surfaces)
        for (const PointResult& p : s.points)
            values.push_back(p.total);
    return values;
}

double floor_of(std::span<const Estimate> values) {
    double sum = 0.0;
    for (const Estimate& e : values)
        sum += e.mean;
    return darkest_share * sum / static_cast<double>(std::max<std::size_t>(1, values.size()));
}

double stated_error(std::span<const Estimate> values) {
    const double floor = floor_of(values);
    double sum = 0.0;
    for (const Estimate& e : values)
        sum += std::pow(e.standard_error / std::max(e.mean, floor), 2);
    return std::sqrt(sum / static_cast<double>(values.size()));
}

double rays_of(const Results& r) {
    return static_cast<double>(r.rays.path + r.rays.shadow + r.rays.gather);
}

Results run(const Scene& scene,
            std::span<const CalculationSurface> surfaces,
            Estimator estimator,
            std::size_t units,
            std::uint64_t seed) {
    Settings settings;
    settings.estimator = estimator;
    settings.fixed_units = units;
    settings.seed = seed;
    return calculate(scene, surfaces, settings);
}

/// Doubles the work until the next doubling would exceed `seconds`.
template <class Keep> std::size_t double_until(double seconds, Keep&& keep) {
    for (std::size_t units = 1;; units *= 2)
        if (2.0 * keep(units) > seconds || units >= most_units)
            return units;
}

TimeToError time_to(const std::vector<BenchRun>& runs, double target) {
    if (runs.front().rms_error <= target)
        return {runs.front().cpu_seconds, TimeSource::at_most};
    for (std::size_t i = 1; i < runs.size(); ++i) {
        const BenchRun& a = runs[i - 1];
        const BenchRun& b = runs[i];
        if (b.rms_error > target)
            continue;
        // straight line of logarithms
        const double share =
            std::log(a.rms_error / target) / std::log(a.rms_error / b.rms_error);
        return {a.cpu_seconds * std::pow(b.cpu_seconds / a.cpu_seconds, share),
                TimeSource::interpolated};
    }
    const BenchRun& last = runs.back();
    return {last.cpu_seconds * std::pow(last.rms_error / target, 2), TimeSource::extrapolated};
}

EstimatorBench measure_estimator(const Scene& scene,
                                 std::span<const CalculationSurface> surfaces,
                                 Estimator estimator,
                                 const BenchSettings& settings,
                                 const std::vector<Estimate>& reference) {
    EstimatorBench bench;
    bench.estimator = estimator;
    const std::size_t units = double_until(settings.seconds, [&](std::size_t n) {
        const Results r = run(scene, surfaces, estimator, n, settings.seed);
        bench.runs.push_back(
            {n, r.cpu_seconds, rms_error_against(reference, values_of(r)), rays_of(r)});
        bench.description = r.estimator;
        return r.cpu_seconds;
    });
    for (std::size_t t = 0; t < target_errors.size(); ++t)
        bench.times[t] = time_to(bench.runs, target_errors[t]);

    // The longest run again with other seeds: means for the efficiency, extremes for its
    // spread.
    double squares = 0.0;
    double seconds = 0.0;
    double rays = 0.0;
    for (std::size_t s = 0; s < settings.seeds; ++s) {
        BenchRun again = bench.runs.back();
        if (s > 0) {
            const Results r = run(scene, surfaces, estimator, units, settings.seed + s);
            again = {
                units, r.cpu_seconds, rms_error_against(reference, values_of(r)), rays_of(r)};
        }
        const double square = again.rms_error * again.rms_error;
        const double efficiency = 1.0 / (square * again.cpu_seconds);
        bench.lowest_efficiency =
            s == 0 ? efficiency : std::min(bench.lowest_efficiency, efficiency);
        bench.highest_efficiency = std::max(bench.highest_efficiency, efficiency);
        squares += square;
        seconds += again.cpu_seconds;
        rays += again.rays;
    }
    const double n = static_cast<double>(settings.seeds);
    bench.efficiency = 1.0 / (squares / n * seconds / n);
    bench.rays_per_second = rays / seconds;
    return bench;
}

/// Packets of 16 shadow rays, each from one point to places about a luminaire.
std::vector<SightSegment> shadow_rays(const Scene& scene,
                                      std::span<const CalculationSurface> surfaces) {
    std::vector<SightSegment> rays;
    while (rays.size() < most_rays)
        for (const CalculationSurface& s : surfaces)
            for (const Receiver& r : s.receivers) {
                const Luminaire& l =
                    scene.luminaires[(rays.size() / packet_size) % scene.luminaires.size()];
                const Point3 c = l.placement.world_from_luminaire.origin;
                for (std::size_t i = 0; i < packet_size && rays.size() < most_rays; ++i) {
                    const double shift = 0.02 * (static_cast<double>(i) - 7.5);
                    rays.push_back({scene.caster.offset_point(r.point, r.axis),
                                    {c.x + shift, c.y - 0.5 * shift, c.z - 1e-3}});
                }
            }
    return rays;
}

double time_own_packets(const Scene& scene, std::span<const SightSegment> rays) {
    double best = 1e30;
    std::array<float, packet_size> visible{};
    for (int turn = 0; turn < turns; ++turn) {
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t i = 0; i + packet_size <= rays.size(); i += packet_size)
            scene.caster.transmittance16(rays.subspan(i, packet_size), 0xFFFF, visible);
        best = std::min(
            best,
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

} // namespace

double rms_error_against(std::span<const Estimate> reference,
                         std::span<const Estimate> values) {
    ISOLUX_EXPECT(values.size() == reference.size() && !values.empty());
    const double floor = floor_of(reference);
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += std::pow(
            (values[i].mean - reference[i].mean) / std::max(reference[i].mean, floor), 2);
    const double measured = sum / static_cast<double>(values.size());
    return std::sqrt(
        std::max(measured - std::pow(stated_error(reference), 2), 0.25 * measured));
}

RoomBench measure_room(const std::string& name,
                       const Scene& scene,
                       std::span<const CalculationSurface> surfaces,
                       const BenchSettings& settings,
                       const BenchProgress& progress) {
    ISOLUX_EXPECT(settings.seeds > 0 && !scene.luminaires.empty());
    const auto tell = [&](const std::string& what) {
        if (progress)
            progress(name + ": " + what);
    };
    RoomBench room;
    room.name = name;
    room.luminaires = scene.luminaires.size();
    room.triangles = scene.triangles.size();
    tell("long run to compare with");
    std::vector<Estimate> reference;
    double_until(settings.reference_seconds, [&](std::size_t units) {
        const Results r = run(
            scene, surfaces, Estimator::automatic, units, settings.seed + reference_seed_step);
        reference = values_of(r);
        room.reference_seconds = r.cpu_seconds;
        return r.cpu_seconds;
    });
    room.points = reference.size();
    room.reference_error = stated_error(reference);
    for (const Estimator estimator : settings.estimators) {
        for (const EstimatorName& e : estimator_names)
            if (e.estimator == estimator)
                tell(std::string(e.in_project));
        room.estimators.push_back(
            measure_estimator(scene, surfaces, estimator, settings, reference));
    }
    tell("rays");
    const std::vector<SightSegment> rays = shadow_rays(scene, surfaces);
    const double count = static_cast<double>(rays.size() / packet_size * packet_size);
    const BareTracer bare(scene);
    room.shadow_rays_per_second = count / time_own_packets(scene, rays);
    room.bare_rays_per_second = count / bare.time_packets(rays, turns);
    return room;
}

ScalingRow measure_scaling(const Scene& scene,
                           std::span<const CalculationSurface> surfaces,
                           std::uint64_t seed) {
    Settings settings;
    settings.seed = seed;
    settings.tolerance = 0.02;
    const Results results = calculate(scene, surfaces, settings);
    const std::vector<Estimate> values = values_of(results);
    ScalingRow row;
    row.points = values.size();
    row.luminaires = scene.luminaires.size();
    row.cpu_seconds = results.cpu_seconds;
    row.stated_error = stated_error(values);
    row.seconds_to_1_percent = row.cpu_seconds * std::pow(row.stated_error / 0.01, 2);
    return row;
}

} // namespace isolux
