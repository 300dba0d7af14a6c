#include "isolux/calc/judge.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace isolux {

namespace {

bool has_same_points(const CalculationSurface& a, const CalculationSurface& b) {
    return std::ranges::equal(
        a.receivers, b.receivers, [](const Receiver& x, const Receiver& y) {
            return x.point == y.point;
        });
}

bool is_horizontal(const CalculationSurface& s) {
    constexpr double upright = 1.0 - 1e-9;
    return s.kind == IlluminanceKind::planar
           && std::ranges::all_of(s.receivers,
                                  [](const Receiver& r) { return r.axis.z() >= upright; });
}

/// Two tables side by side: points of `a`, then those of `b`.
ReplicateTable join(const ReplicateTable& a, const ReplicateTable& b) {
    ReplicateTable t{a.replicates, a.points + b.points, {}};
    for (std::size_t r = 0; r < a.replicates; ++r) {
        t.values.insert(t.values.end(), a.row(r).begin(), a.row(r).end());
        t.values.insert(t.values.end(), b.row(r).begin(), b.row(r).end());
    }
    return t;
}

double ratio(double a, double b) noexcept { return b > 0.0 ? a / b : 0.0; }

ModellingResult find_ratio(const Results& results, std::size_t ez, std::size_t eh) {
    const ReplicateTable both =
        join(results.surfaces[ez].replicates, results.surfaces[eh].replicates);
    const std::size_t n = both.points / 2;
    using Means = std::span<const double>;
    ModellingResult m{ez, eh, {}, {}, {}, {}};
    for (std::size_t p = 0; p < n; ++p) {
        ReplicateTable pair{both.replicates, 2, {}};
        for (std::size_t r = 0; r < both.replicates; ++r)
            pair.values.insert(pair.values.end(), {both.row(r)[p], both.row(r)[n + p]});
        m.points.push_back(jackknife(pair, [](Means v) { return ratio(v[0], v[1]); }));
    }
    m.mean = jackknife(both, [n](Means v) {
        double sum = 0.0;
        for (std::size_t p = 0; p < n; ++p)
            sum += ratio(v[p], v[n + p]);
        return sum / static_cast<double>(n);
    });
    const auto by_mean = [](const Estimate& a, const Estimate& b) { return a.mean < b.mean; };
    m.minimum = *std::ranges::min_element(m.points, by_mean);
    m.maximum = *std::ranges::max_element(m.points, by_mean);
    return m;
}

Estimate pick(const SurfaceSummary& s, Statistic statistic) {
    switch (statistic) {
    case Statistic::minimum:
        return s.minimum;
    case Statistic::maximum:
        return s.maximum;
    case Statistic::uniformity:
        return s.uniformity;
    case Statistic::diversity:
    case Statistic::contrast:
        return s.diversity;
    case Statistic::mean:
        break;
    }
    return s.mean;
}

/// Emax/Emin from what is known of Emin/Emax.
void invert(Verdict& v) {
    const double d = v.value.mean;
    if (d <= 0.0 || v.interval.lower <= 0.0) {
        v.reason = "the darkest point may be dark: the ratio has no upper bound";
        constexpr double huge = 1e9;
        v.value = {d > 0.0 ? 1.0 / d : huge, v.value.standard_error, v.value.samples};
        v.interval = {v.interval.upper > 0.0 ? 1.0 / v.interval.upper : huge, huge};
        return;
    }
    v.value = {1.0 / d, v.value.standard_error / (d * d), v.value.samples};
    v.interval = {1.0 / v.interval.upper, 1.0 / v.interval.lower};
}

class Judge {
public:
    Judge(const Project& project, const Results& results, double confidence)
        : project_(project), results_(results), confidence_(confidence) {}

    Verdict operator()(const ProjectRequirement& asked) const {
        Verdict v;
        v.requirement = asked.requirement;
        v.subject = asked.subject;
        v.reason = asked.reason;
        if (!v.reason.empty())
            return v;
        switch (v.requirement.quantity) {
        case RequiredQuantity::illuminance:
        case RequiredQuantity::cylindrical_illuminance:
            judge_surface(v, asked);
            break;
        case RequiredQuantity::modelling:
            judge_modelling(v, asked);
            break;
        case RequiredQuantity::colour_rendering:
            judge_colour(v);
            break;
        case RequiredQuantity::unified_glare_rating:
        case RequiredQuantity::glare_rating:
            judge_glare(v, asked);
            break;
        case RequiredQuantity::power_density:
            judge_power(v);
            break;
        }
        return v;
    }

private:
    void judge_estimate(Verdict& v, const Estimate& e) const {
        v.value = e;
        v.interval = decision_interval(e, confidence_, results_.looks);
        if (v.requirement.statistic == Statistic::contrast)
            invert(v);
        decide(v);
    }

    void judge_surface(Verdict& v, const ProjectRequirement& asked) const {
        if (!asked.surface || *asked.surface >= results_.surfaces.size()
            || results_.replicates == 0) {
            v.reason = "the calculation ended before there was a value";
            return;
        }
        const SurfaceResult& s = results_.surfaces[*asked.surface];
        const bool is_direct = v.requirement.light == LightShare::direct;
        judge_estimate(
            v, pick(is_direct ? summarise(s.direct) : s.summary, v.requirement.statistic));
    }

    void judge_modelling(Verdict& v, const ProjectRequirement& asked) const {
        for (const ModellingResult& m : results_.modelling)
            if (asked.surface && m.cylindrical == *asked.surface) {
                judge_estimate(v,
                               v.requirement.statistic == Statistic::minimum   ? m.minimum
                               : v.requirement.statistic == Statistic::maximum ? m.maximum
                                                                               : m.mean);
                return;
            }
        v.reason = "no horizontal surface shares the points of the cylindrical illuminance";
    }

    /// The worst observer speaks for the group; the interval reaches up to the highest bound of
    /// them all.
    void judge_glare(Verdict& v, const ProjectRequirement& asked) const {
        if (!asked.observers || *asked.observers >= results_.observers.size()) {
            v.reason = "the calculation ended before there was a value";
            return;
        }
        const ObserverGroupResult& group = results_.observers[*asked.observers];
        for (const GlareRating& r : group.ratings)
            if (r.value.samples == 0 && r.sources > 0) {
                v.reason = r.reason;
                return;
            }
        if (!group.worst) {
            v.reason = group.ratings.empty() ? "no observer" : group.ratings.front().reason;
            return;
        }
        v.value = group.ratings[*group.worst].value;
        v.interval = decision_interval(v.value, confidence_, results_.looks);
        for (const GlareRating& r : group.ratings)
            if (r.value.samples > 0)
                v.interval.upper =
                    std::max(v.interval.upper,
                             decision_interval(r.value, confidence_, results_.looks).upper);
        decide(v);
    }

    void judge_power(Verdict& v) const {
        for (const EnergyResult& e : results_.energy)
            if (e.room == v.subject || results_.energy.size() == 1) {
                v.reason = e.reason;
                if (!e.watts)
                    return;
                v.value = {e.density, 0.0, 1};
                v.interval = {e.density, e.density};
                decide(v);
                return;
            }
        v.reason = "no room of that name";
    }

    void judge_colour(Verdict& v) const {
        std::optional<double> least;
        for (const ScheduleEntry& e : project_.schedule) {
            if (e.count == 0)
                continue;
            if (!e.colour_rendering) {
                v.reason = "colour rendering of luminaire type " + e.type + " is not stated";
                return;
            }
            least = std::min(least.value_or(*e.colour_rendering), *e.colour_rendering);
        }
        v.value = {least.value_or(0.0), 0.0, 1};
        v.interval = {v.value.mean, v.value.mean};
        v.reason = "as stated, not calculated";
        decide(v);
    }

    const Project& project_;
    const Results& results_;
    double confidence_;
};

} // namespace

std::vector<ModellingResult> find_modelling(const Results& results) {
    std::vector<ModellingResult> found;
    if (results.replicates == 0)
        return found;
    for (std::size_t z = 0; z < results.surfaces.size(); ++z) {
        const CalculationSurface& ez = results.surfaces[z].surface;
        if (ez.kind != IlluminanceKind::cylindrical || ez.receivers.empty())
            continue;
        for (std::size_t h = 0; h < results.surfaces.size(); ++h)
            if (is_horizontal(results.surfaces[h].surface)
                && has_same_points(ez, results.surfaces[h].surface)) {
                found.push_back(find_ratio(results, z, h));
                break;
            }
    }
    return found;
}

std::vector<Verdict> judge(const Project& project, const Results& results, double confidence) {
    const Judge one(project, results, confidence);
    std::vector<Verdict> verdicts;
    for (const ProjectRequirement& r : project.requirements)
        verdicts.push_back(one(r));
    return verdicts;
}

Decision overall(const std::vector<Verdict>& verdicts) noexcept {
    const auto has = [&](Decision d) {
        return std::ranges::any_of(verdicts, [d](const Verdict& v) {
            return v.decision == d && !v.requirement.is_recommendation;
        });
    };
    for (const Decision d : {Decision::fail, Decision::undecided, Decision::pass})
        if (has(d))
            return d;
    return Decision::not_judged;
}

} // namespace isolux
