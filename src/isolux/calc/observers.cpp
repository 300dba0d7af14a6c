#include "isolux/calc/observers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/base/parallel.h"
#include "isolux/calc/glare_sources.h"

namespace isolux {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Indirect part of each replicate at one point, lx.
std::vector<double> indirect_replicates(const SurfaceResult& s, std::size_t point) {
    std::vector<double> values;
    for (std::size_t r = 0; r < s.replicates.replicates; ++r)
        values.push_back(std::max(0.0, s.replicates.row(r)[point] - s.direct.row(r)[point]));
    return values;
}

Estimate scaled(Estimate e, double factor) {
    return {factor * e.mean, factor * e.standard_error, e.samples};
}

class Rater {
public:
    Rater(const Scene& scene, const Project& project, std::span<const SurfaceResult> surfaces)
        : scene_(scene), project_(project), surfaces_(surfaces) {}

    ObserverGroupResult rate(const ObserverGroup& group,
                             const SurfaceResult& at_the_eyes) const {
        ObserverGroupResult result;
        result.group = group;
        result.ratings.resize(group.sight_lines.size());
        for_each_index(group.sight_lines.size(), 1, [&](std::size_t i) {
            result.ratings[i] = group.scale == GlareScale::unified
                                    ? rate_unified(group, group.sight_lines[i], at_the_eyes, i)
                                    : rate_outdoor(group, group.sight_lines[i]);
        });
        for (std::size_t i = 0; i < result.ratings.size(); ++i)
            if (result.ratings[i].value.samples > 0
                && (!result.worst
                    || result.ratings[i].value.mean > result.ratings[*result.worst].value.mean))
                result.worst = i;
        if (group.scale == GlareScale::unified && result.worst) {
            TableRating by_table =
                rate_by_table(scene_, group.room, group.sight_lines[*result.worst]);
            result.by_table = by_table.value;
            result.table_note = std::move(by_table.note);
        }
        return result;
    }

private:
    GlareRating rate_unified(const ObserverGroup& group,
                             const SightLine& line,
                             const SurfaceResult& at_the_eyes,
                             std::size_t index) const {
        GlareRating rating;
        for (const SeenLuminaire& seen : see_luminaires(scene_, line.eye)) {
            const bool is_ahead = dot(line.direction, seen.towards) > 0.0;
            if (seen.is_point && is_ahead) {
                rating.reason =
                    "a luminaire without a luminous area is in sight (its luminance "
                    "is not known)";
                return rating;
            }
            const double sum = glare_sum(line.direction, seen.parts, group.sources);
            const std::size_t type = scene_.luminaires[seen.luminaire].placement.type.index();
            const double k2 =
                type < project_.glare_factors.size() ? project_.glare_factors[type] : 1.0;
            rating.source_sum += k2 * sum;
            rating.sources += sum > 0.0 ? 1 : 0;
        }
        const std::vector<double> indirect = indirect_replicates(at_the_eyes, index);
        rating.background = scaled(estimate_from_replicates(indirect), 1.0 / std::numbers::pi);
        rating.value = unified_glare_rating(rating.source_sum, indirect);
        if (rating.value.samples == 0)
            rating.reason = rating.source_sum > 0.0
                                ? "no reflected light reaches the eye (the background is black)"
                                : "no luminaire is in sight";
        return rating;
    }

    GlareRating rate_outdoor(const ObserverGroup& group, const SightLine& line) const {
        constexpr double nearest = 1.5; // degrees; the formula ends there
        constexpr double widest = 60.0;
        GlareRating rating;
        for (const SeenLuminaire& seen : see_luminaires(scene_, line.eye)) {
            const double cosine = dot(line.direction, seen.towards);
            const double theta = std::acos(std::clamp(cosine, -1.0, 1.0)) / degree;
            if (theta >= widest)
                continue;
            const double angle = std::max(theta, nearest);
            rating.source_sum += 10.0 * seen.illuminance * cosine / (angle * angle);
            ++rating.sources;
        }
        if (!group.ground || *group.ground >= surfaces_.size()) {
            rating.reason = "no surface of the ground is named (the background is not known)";
            return rating;
        }
        const ReplicateTable& ground = surfaces_[*group.ground].replicates;
        std::vector<double> background;
        for (std::size_t r = 0; r < ground.replicates; ++r) {
            double sum = 0.0;
            for (const double e : ground.row(r))
                sum += e;
            background.push_back(0.035 * group.ground_reflectance / std::numbers::pi * sum
                                 / static_cast<double>(ground.points));
        }
        rating.background = estimate_from_replicates(background);
        rating.value = outdoor_glare_rating(rating.source_sum, background);
        if (rating.value.samples == 0)
            rating.reason = rating.source_sum > 0.0 ? "the ground is dark"
                                                    : "no luminaire is within 60 degrees";
        return rating;
    }

    const Scene& scene_;
    const Project& project_;
    std::span<const SurfaceResult> surfaces_;
};

} // namespace

std::vector<CalculationSurface> observer_surfaces(std::span<const ObserverGroup> groups) {
    std::vector<CalculationSurface> surfaces;
    for (const ObserverGroup& g : groups) {
        CalculationSurface s;
        s.name = g.name;
        if (g.scale == GlareScale::unified)
            for (const SightLine& line : g.sight_lines)
                s.receivers.push_back({line.eye, line.direction});
        surfaces.push_back(std::move(s));
    }
    return surfaces;
}

std::vector<ObserverGroupResult> rate_observers(const Scene& scene,
                                                const Project& project,
                                                std::span<const SurfaceResult> at_the_eyes,
                                                std::span<const SurfaceResult> surfaces) {
    const Rater rater(scene, project, surfaces);
    std::vector<ObserverGroupResult> results;
    for (std::size_t g = 0; g < project.observers.size(); ++g)
        results.push_back(rater.rate(project.observers[g], at_the_eyes[g]));
    return results;
}

} // namespace isolux
