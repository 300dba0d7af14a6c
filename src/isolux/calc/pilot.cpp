#include "isolux/calc/pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "isolux/base/parallel.h"
#include "isolux/calc/find_importance.h"
#include "isolux/transport/local_estimator.h"
#include "isolux/transport/walk_front.h"

namespace isolux {

namespace {

// What the pilot draws at every point in every replicate: everything twice, so that the
// variance inside a replicate is seen apart from that of the light paths.
constexpr std::size_t paths = pilot_paths;
constexpr std::size_t draws = 8;      ///< twice
constexpr std::size_t directions = 1; ///< twice
constexpr std::size_t traced_samples = 2;

/// Paths are shared as if a point sent so many gather rays beside the pilot's paths, as runs do
/// where it matters: what light paths bring near surfaces varies the less the more there are.
constexpr double usual_rays = 4.0;
constexpr std::size_t tile = 16;

using Pair = std::array<double, 2>;

/// What one point saw in one replicate, lx.
struct Look {
    Pair local{};
    Pair gathered{};
    double traced = 0.0;
    double direct = 0.0;
    double look_samples = 0.0; ///< that it took

    [[nodiscard]] double indirect() const noexcept {
        return 0.5 * (local[0] + local[1] + gathered[0] + gathered[1]);
    }
};

/// Rounds of walking and looking, where paths need guidance: each sees farther into the dark.
constexpr int most_rounds = 3;

/// A class is looked at so often, however rare it is.
constexpr std::size_t fewest_of_a_class = 16;

/// Which points are looked at: evenly spread over each class, in the task's order.
std::vector<std::size_t> choose_points(std::span<const PointClass> classes) {
    ByClass<std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < classes.size(); ++i)
        members[static_cast<std::size_t>(classes[i])].push_back(i);
    std::vector<std::size_t> points;
    for (const std::vector<std::size_t>& m : members) {
        const std::size_t share = (m.size() * pilot_points + classes.size() - 1)
                                  / std::max<std::size_t>(1, classes.size());
        const std::size_t chosen = std::min(m.size(), std::max(share, fewest_of_a_class));
        for (std::size_t i = 0; i < chosen; ++i)
            points.push_back(m[(2 * i + 1) * m.size() / (2 * chosen)]);
    }
    std::sort(points.begin(), points.end());
    return points;
}

class Looker {
public:
    Looker(const PilotScene& task, std::span<const std::size_t> points)
        : task_(task), points_(points) {}

    /// All looks at points [first, last) in one replicate.
    void look(const VertexCache& cache,
              const EffectiveCounts& counts,
              std::uint32_t replicate,
              std::size_t first,
              std::size_t last,
              std::span<Look> looks) const {
        const RandomStream subset(task_.seed, StreamPurpose::pilot, replicate);
        std::vector<LocalPoint> locals;
        std::vector<RayPoint> senders;
        for (std::size_t p = first; p < last; ++p) {
            const std::size_t i = points_[p];
            const bool leaves = task_.leaves_corners[i] != 0;
            const bool mirrored = task_.caustic > 0.0 && task_.gathers[i] != 0;
            locals.push_back({&task_.receivers[i],
                              task_.clear[i],
                              0.0,
                              draws,
                              directions,
                              leaves,
                              mirrored});
            senders.push_back({&task_.receivers[i],
                               task_.clear[i],
                               {task_.seed, StreamPurpose::pilot, replicate, i},
                               directions,
                               0,
                               leaves,
                               true,
                               mirrored});
        }
        LocalScratch scratch;
        WalkFront front;
        std::vector<Rgb> sums(last - first);
        for (std::uint32_t half = 0; half < 2; ++half) {
            for (std::size_t k = 0; k < locals.size(); ++k)
                locals[k].offset = subset.uniform(points_[first + k], (1U << 20U) + half);
            std::fill(sums.begin(), sums.end(), Rgb{});
            gather_local_estimates(
                *task_.scene, cache, locals, Weighting::balanced, scratch, sums);
            for (std::size_t k = 0; k < sums.size(); ++k)
                looks[first + k].local[half] = luminance_sum(sums[k]);
            std::fill(sums.begin(), sums.end(), Rgb{});
            for (RayPoint& s : senders)
                s.first = half;
            front.start(*task_.scene, *task_.emission, *task_.images, senders);
            front.share_with(cache, counts);
            front.add_gathering();
            front.run({sums, nullptr, {}, {}});
            for (std::size_t k = 0; k < sums.size(); ++k)
                looks[first + k].gathered[half] = luminance_sum(sums[k]);
        }
        std::fill(sums.begin(), sums.end(), Rgb{});
        for (RayPoint& s : senders)
            s.samples = traced_samples, s.first = 2;
        front.start(*task_.scene, *task_.emission, *task_.images, senders);
        front.add_tracing();
        front.run({sums, nullptr, {}, {}});
        for (std::size_t k = 0; k < sums.size(); ++k)
            looks[first + k].traced = luminance_sum(sums[k]);
    }

private:
    const PilotScene& task_;
    std::span<const std::size_t> points_;
};

/// Half the mean squared difference of a pair: the variance of one of them.
double half_square(const Pair& p) noexcept { return 0.5 * (p[0] - p[1]) * (p[0] - p[1]); }

double variance_of(std::span<const double> values) noexcept {
    double mean = 0.0;
    for (const double v : values)
        mean += v / static_cast<double>(values.size());
    double sum = 0.0;
    for (const double v : values)
        sum += (v - mean) * (v - mean);
    return sum / static_cast<double>(values.size() - 1);
}

/// Variance of traced values that may have missed light. What they lack beside another estimate
/// comes by rare paths: it counts as if one more value had brought it.
double
believed_variance(std::span<const double> traced, double other, double missing) noexcept {
    const auto n = static_cast<double>(traced.size());
    const double variance = variance_of(traced);
    const bool is_missing = missing > 3.0 * std::sqrt((variance + other) / n);
    return is_missing || variance == 0.0 ? std::max(variance, n * missing * missing) : variance;
}

/// The five coefficients of one point, lx2.
struct PointVariance {
    VarianceModel model;
    double reflected = 0.0; ///< lx
};

PointVariance judge(std::span<const Look> looks) {
    const std::size_t count = looks.size();
    std::vector<double> indirect(count), traced(count), direct(count);
    double inside_local = 0.0, inside_gathered = 0.0, missing = 0.0;
    double cached = 0.0, reflected = 0.0;
    const auto n = static_cast<double>(count);
    for (std::size_t r = 0; r < count; ++r) {
        const Look& l = looks[r];
        indirect[r] = l.indirect();
        traced[r] = l.traced;
        missing += indirect[r] - traced[r];
        direct[r] = l.direct;
        inside_local += half_square(l.local) / n;
        inside_gathered += half_square(l.gathered) / n;
        reflected += indirect[r] / n;
        cached += 0.5 * (l.local[0] + l.local[1]) / n;
    }
    PointVariance v;
    v.model.light = cached * cached;
    v.reflected = reflected;
    v.model.draws = static_cast<double>(draws) * inside_local;
    v.model.directions = static_cast<double>(directions) * inside_gathered;
    const double rest = variance_of(indirect) - 0.5 * inside_local - 0.5 * inside_gathered;
    v.model.paths = static_cast<double>(paths) * rest; // may be negative; the mean is not
    v.model.samples = static_cast<double>(traced_samples)
                      * believed_variance(traced, variance_of(indirect), missing / n);
    v.model.direct = variance_of(direct);
    v.model.look_samples = looks.front().look_samples;
    return v;
}

void add(VarianceModel& sum, const VarianceModel& m, double factor) noexcept {
    sum.paths += factor * m.paths;
    sum.draws += factor * m.draws;
    sum.directions += factor * m.directions;
    sum.samples += factor * m.samples;
    sum.direct += factor * m.direct;
    sum.light += factor * m.light;
}

/// Illuminance of the points looked at, lx. @param looks  [replicate][point]
std::vector<double> values_of(std::span<const Look> looks, std::size_t points) {
    const auto replicates = static_cast<double>(looks.size() / points);
    std::vector<double> values(points, 0.0);
    for (std::size_t k = 0; k < looks.size(); ++k)
        values[k % points] += looks[k].direct + looks[k].indirect();
    for (double& v : values)
        v /= replicates;
    return values;
}

/// So many points of a surface tell its mean.
constexpr std::size_t enough_for_a_mean = 4;

/// What the points looked at are held to, lx: their own values, but no less than the darkest
/// share of the mean of those on their surface, or, where these are too few, of the mean of
/// all. @param values  lx, of the points
std::vector<double> held_to(std::span<const std::size_t> points,
                            std::span<const double> values,
                            const PilotTarget& target) {
    const double mean_of_all = std::accumulate(values.begin(), values.end(), 0.0)
                               / static_cast<double>(std::max<std::size_t>(1, values.size()));
    std::vector<double> held(values.begin(), values.end());
    const auto surface_of = [&](std::size_t k) {
        return std::upper_bound(target.ends.begin(), target.ends.end(), points[k])
               - target.ends.begin();
    };
    for (std::size_t first = 0, last = 0; first < held.size(); first = last) {
        double sum = 0.0;
        for (; last < held.size() && surface_of(last) == surface_of(first); ++last)
            sum += values[last];
        const std::size_t count = last - first;
        const double mean =
            count < enough_for_a_mean ? mean_of_all : sum / static_cast<double>(count);
        const double least =
            std::max(target.darkest_share * mean, target.absolute_tolerance / target.tolerance);
        for (std::size_t k = first; k < last; ++k)
            held[k] = std::max(held[k], least);
    }
    return held;
}

/// In shares of the variance the tolerance allows, then mean over the points of a class; what
/// gather rays bring, over those that gather, if any do.
Pilot summarise(std::span<const PointVariance> points,
                std::span<const double> held,
                std::span<const PointClass> classes,
                std::span<const std::uint8_t> gathers,
                const ByClass<std::size_t>& all_points,
                const PilotTarget& target) {
    Pilot pilot;
    pilot.reflected.fill(std::numeric_limits<double>::max());
    ByClass<double> gatherers{};
    for (std::size_t i = 0; i < points.size(); ++i) {
        ++pilot.points[static_cast<std::size_t>(classes[i])];
        gatherers[static_cast<std::size_t>(classes[i])] += gathers[i];
    }
    double count = 0.0;
    for (const std::size_t n : all_points)
        count += static_cast<double>(n);
    // so many points of the task stand behind one that was looked at
    const auto weight = [&](std::size_t i) {
        const auto c = static_cast<std::size_t>(classes[i]);
        return static_cast<double>(all_points[c])
               / (static_cast<double>(pilot.points[c]) * count);
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto c = static_cast<std::size_t>(classes[i]);
        pilot.of_class[c].look_samples +=
            points[i].model.look_samples / static_cast<double>(pilot.points[c]);
        pilot.reflected[c] = std::min(pilot.reflected[c], points[i].reflected);
        const double half = target.tolerance * held[i];
        const double allowed = target.replicates * std::pow(half / target.factor, 2);
        if (!(allowed > 0.0))
            continue;
        VarianceModel own = points[i].model;
        if (gatherers[c] > 0.0)
            own.directions *= gathers[i] * static_cast<double>(pilot.points[c]) / gatherers[c];
        add(pilot.of_class[c], own, 1.0 / (allowed * static_cast<double>(pilot.points[c])));
        add(pilot.all, points[i].model, weight(i) / allowed);
    }
    for (VarianceModel& m : pilot.of_class)
        m.paths = std::max(m.paths, 0.0);
    pilot.all.paths = std::max(pilot.all.paths, 0.0);
    return pilot;
}

/// Walks the light paths of all replicates and looks at the points.
/// @param pilot  its means over the paths are overwritten  @param looks  [replicate][point],
/// overwritten but for the direct light
std::vector<VertexCache> walk_and_look(const PilotScene& task,
                                       std::span<const std::size_t> points,
                                       const PathImportance& importance,
                                       Pilot& pilot,
                                       std::span<Look> looks) {
    const std::size_t replicates = looks.size() / points.size();
    const auto build = [&](std::uint32_t r, const EffectiveCounts& counts) {
        return build_vertex_cache(*task.scene,
                                  *task.emission,
                                  PathRandomness(task.seed, first_pilot_replicate + r),
                                  0,
                                  paths,
                                  counts,
                                  importance);
    };
    // The counts of METHODS eq. (11) need the mean length of a chain: first replicate.
    const VertexCache first = build(most_pilot_replicates, EffectiveCounts{});
    constexpr double m = paths;
    pilot.vertices_per_path = std::max(0.01, static_cast<double>(first.size()) / m);
    pilot.chain_length = first.picks.empty() ? pilot.vertices_per_path
                                             : static_cast<double>(first.picks.size()) / m;
    const EffectiveCounts counts{m,
                                 m * pilot.chain_length,
                                 usual_rays,
                                 usual_rays,
                                 task.corner,
                                 task.scene->total_area,
                                 task.caustic,
                                 task.images};
    std::vector<VertexCache> caches(replicates);
    for_each_index(replicates, 1, [&](std::size_t r) {
        caches[r] = build(static_cast<std::uint32_t>(r), counts);
    });
    const Looker looker(task, points);
    const std::size_t tiles = (points.size() + tile - 1) / tile;
    for_each_index(tiles * replicates, 1, [&](std::size_t k) {
        const std::size_t r = k / tiles;
        const std::size_t begin = k % tiles * tile;
        looker.look(caches[r],
                    counts,
                    first_pilot_replicate + static_cast<std::uint32_t>(r),
                    begin,
                    std::min(points.size(), begin + tile),
                    looks.subspan(r * points.size(), points.size()));
    });
    return caches;
}

} // namespace

Pilot run_pilot(const PilotScene& task, const PilotTarget& target) {
    const std::vector<std::size_t> points = choose_points(task.classes);
    const std::size_t replicates = std::clamp(fewest_pilot_replicates * pilot_points
                                                  / std::max<std::size_t>(1, points.size()),
                                              fewest_pilot_replicates,
                                              most_pilot_replicates);
    std::vector<Look> looks(points.size() * replicates); // [replicate][point]
    Pilot means;
    for_each_index(points.size(), 4, [&](std::size_t p) {
        std::vector<double> values(replicates);
        const double samples_taken = task.direct(points[p], first_pilot_replicate, values);
        for (std::size_t r = 0; r < replicates; ++r) {
            Look& look = looks[r * points.size() + p];
            look.direct = values[r];
            look.look_samples = samples_taken;
        }
    });
    PathImportance importance;
    if (task.reflected && task.emission->total_flux() > 0.0)
        for (int round = 0; round < most_rounds; ++round) {
            const std::vector<VertexCache> caches =
                walk_and_look(task, points, importance, means, looks);
            if (round + 1 == most_rounds)
                break;
            const std::vector<double> held =
                held_to(points, values_of(looks, points.size()), target);
            std::vector<ImportancePoint> seen;
            for (std::size_t p = 0; p < points.size(); ++p)
                if (held[p] > 0.0)
                    seen.push_back(
                        {&task.receivers[points[p]], task.clear[points[p]], held[p]});
            importance = find_importance(*task.scene, caches, seen);
            if (importance.is_even())
                break;
        }
    std::vector<PointVariance> variances;
    std::vector<PointClass> classes;
    std::vector<std::uint8_t> gathers;
    std::vector<Look> own(replicates);
    for (std::size_t p = 0; p < points.size(); ++p) {
        for (std::size_t r = 0; r < replicates; ++r)
            own[r] = looks[r * points.size() + p];
        variances.push_back(judge(own));
        classes.push_back(task.classes[points[p]]);
        gathers.push_back(importance.is_even() ? task.gathers[points[p]] : 1);
    }
    ByClass<std::size_t> all_points{};
    for (const PointClass c : task.classes)
        ++all_points[static_cast<std::size_t>(c)];
    Pilot pilot = summarise(variances,
                            held_to(points, values_of(looks, points.size()), target),
                            classes,
                            gathers,
                            all_points,
                            target);
    pilot.vertices_per_path = means.vertices_per_path;
    pilot.chain_length = means.chain_length;
    pilot.importance = std::move(importance);
    return pilot;
}

} // namespace isolux
