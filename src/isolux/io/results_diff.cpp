#include "isolux/io/results_diff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

namespace isolux {

namespace {

/// Two estimates of one thing.
struct Pair {
    std::string where;
    std::string what;
    std::string unit;
    Estimate before;
    Estimate after;
};

const SurfaceResult* find_surface(const Results& r, const std::string& name) {
    for (const SurfaceResult& s : r.surfaces)
        if (s.surface.name == name)
            return &s;
    return nullptr;
}

const ObserverGroupResult* find_observers(const Results& r, const std::string& name) {
    for (const ObserverGroupResult& o : r.observers)
        if (o.group.name == name)
            return &o;
    return nullptr;
}

bool has_moved(const Pair& p, double factor) {
    const double difference = std::abs(p.after.mean - p.before.mean);
    const double error = std::hypot(p.before.standard_error, p.after.standard_error);
    const double rounding = 1e-9 * std::max(std::abs(p.before.mean), std::abs(p.after.mean));
    return difference > std::max(factor * error, rounding);
}

class Comparison {
public:
    Comparison(const ResultsDocument& before, const ResultsDocument& after)
        : before_(before), after_(after) {}

    ResultsDiff compare(double confidence) {
        compare_inputs();
        collect_surfaces();
        collect_observers();
        const std::size_t n = pairs_.size() + points_.size();
        diff_.compared = n;
        const double level =
            (1.0 - confidence) / static_cast<double>(std::max<std::size_t>(1, n));
        const double factor = student_quantile(1.0 - level, degrees());
        for (const Pair& p : pairs_)
            if (has_moved(p, factor))
                diff_.values.push_back({p.where, p.what, p.unit, p.before, p.after});
        compare_points(factor);
        compare_verdicts();
        return std::move(diff_);
    }

private:
    [[nodiscard]] double degrees() const {
        const auto least = std::min(before_.results.replicates, after_.results.replicates);
        return static_cast<double>(std::max<std::uint64_t>(2, least) - 1);
    }

    void compare_inputs() {
        const auto differ = [&](const std::string& what, const auto& a, const auto& b) {
            if (a != b)
                diff_.inputs.push_back(fmt::format("{}: {} -> {}", what, a, b));
        };
        differ("isolux", before_.version, after_.version);
        differ("seed", before_.seed, after_.seed);
        differ("tolerance", before_.tolerance, after_.tolerance);
        differ("confidence", before_.confidence, after_.confidence);
        if (before_.project.sha256 != after_.project.sha256)
            diff_.inputs.push_back("project file: contents differ");
        std::map<std::string, std::string> files;
        for (const InputFile& f : before_.inputs)
            files[f.file] = f.sha256;
        for (const InputFile& f : after_.inputs) {
            const auto known = files.find(f.file);
            if (known == files.end())
                diff_.inputs.push_back("file " + f.file + ": only in the second");
            else if (known->second != f.sha256)
                diff_.inputs.push_back("file " + f.file + ": contents differ");
            if (known != files.end())
                known->second.clear();
        }
        for (const auto& [file, hash] : files)
            if (!hash.empty())
                diff_.inputs.push_back("file " + file + ": only in the first");
    }

    void collect_surfaces() {
        for (const SurfaceResult& a : before_.results.surfaces) {
            const std::string& name = a.surface.name;
            const SurfaceResult* b = find_surface(after_.results, name);
            if (b == nullptr) {
                diff_.missing.push_back("surface " + name + ": only in the first");
                continue;
            }
            const auto add =
                [&](const char* what, const char* unit, Estimate SurfaceSummary::*m) {
                    pairs_.push_back({name, what, unit, a.summary.*m, b->summary.*m});
                };
            add("Em", "lx", &SurfaceSummary::mean);
            add("Emin", "lx", &SurfaceSummary::minimum);
            add("Emax", "lx", &SurfaceSummary::maximum);
            add("U0", "1", &SurfaceSummary::uniformity);
            add("Ud", "1", &SurfaceSummary::diversity);
            collect_points(a, *b);
        }
        for (const SurfaceResult& b : after_.results.surfaces)
            if (find_surface(before_.results, b.surface.name) == nullptr)
                diff_.missing.push_back("surface " + b.surface.name + ": only in the second");
    }

    void collect_points(const SurfaceResult& a, const SurfaceResult& b) {
        if (a.points.size() != b.points.size()) {
            diff_.missing.push_back(fmt::format("surface {}: {} points -> {}",
                                                a.surface.name,
                                                a.points.size(),
                                                b.points.size()));
            return;
        }
        for (std::size_t i = 0; i < a.points.size(); ++i)
            points_.push_back({a.surface.name, "", "lx", a.points[i].total, b.points[i].total});
    }

    /// One line a surface: how many points moved, and the one that moved furthest.
    void compare_points(double factor) {
        for (std::size_t first = 0; first < points_.size();) {
            std::size_t end = first;
            std::size_t moved = 0;
            std::optional<std::size_t> worst;
            const auto distance = [&](std::size_t i) {
                return std::abs(points_[i].after.mean - points_[i].before.mean);
            };
            for (; end < points_.size() && points_[end].where == points_[first].where; ++end)
                if (has_moved(points_[end], factor)) {
                    ++moved;
                    if (!worst || distance(end) > distance(*worst))
                        worst = end;
                }
            if (worst)
                diff_.values.push_back(
                    {points_[*worst].where,
                     fmt::format("{} of {} points, most", moved, end - first),
                     "lx",
                     points_[*worst].before,
                     points_[*worst].after});
            first = end;
        }
    }

    void collect_observers() {
        for (const ObserverGroupResult& a : before_.results.observers) {
            const ObserverGroupResult* b = find_observers(after_.results, a.group.name);
            if (b == nullptr)
                diff_.missing.push_back("observers " + a.group.name + ": only in the first");
            else if (a.worst && b->worst)
                pairs_.push_back({a.group.name,
                                  a.group.scale == GlareScale::unified ? "UGR" : "GR",
                                  "1",
                                  a.ratings[*a.worst].value,
                                  b->ratings[*b->worst].value});
        }
        for (const ObserverGroupResult& b : after_.results.observers)
            if (find_observers(before_.results, b.group.name) == nullptr)
                diff_.missing.push_back("observers " + b.group.name + ": only in the second");
    }

    void compare_verdicts() {
        const auto key = [](const Verdict& v) {
            return std::pair(v.subject,
                             v.requirement.standard + " " + v.requirement.row + " "
                                 + v.requirement.symbol);
        };
        const auto find = [&](const Results& r, const auto& wanted) -> const Verdict* {
            for (const Verdict& v : r.verdicts)
                if (key(v) == wanted)
                    return &v;
            return nullptr;
        };
        const auto add = [&](const auto& name, std::string_view a, std::string_view b) {
            diff_.verdicts.push_back({name.first, name.second, std::string(a), std::string(b)});
        };
        for (const Verdict& v : before_.results.verdicts) {
            const Verdict* other = find(after_.results, key(v));
            if (other == nullptr)
                add(key(v), to_word(v.decision), "-");
            else if (other->decision != v.decision)
                add(key(v), to_word(v.decision), to_word(other->decision));
        }
        for (const Verdict& v : after_.results.verdicts)
            if (find(before_.results, key(v)) == nullptr)
                add(key(v), "-", to_word(v.decision));
    }

    const ResultsDocument& before_;
    const ResultsDocument& after_;
    ResultsDiff diff_;
    std::vector<Pair> pairs_;
    std::vector<Pair> points_;
};

} // namespace

ResultsDiff compare_results(const ResultsDocument& before,
                            const ResultsDocument& after,
                            double confidence) {
    return Comparison(before, after).compare(confidence);
}

} // namespace isolux
