#include <algorithm>
#include <cmath>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/base/parallel.h"
#include "isolux/calc/calculate.h"
#include "isolux/calc/stopping.h"
#include "isolux/io/project_json.h"

#include "support/source_dir.h"

/// METHODS eq. (124): points that change to path tracing in the middle of a calculation, in a
/// shipped room where some do.
namespace isolux {
namespace {

constexpr double z_limit = 7.0; // METHODS 7.1

class LastPointsOfARun : public testing::Test {
protected:
    LastPointsOfARun()
        : project_(read_project(test::source_dir() / "projects/classroom/project.json")) {
        surfaces_ = project_.surfaces;
        scene_.emplace(build_scene(std::move(project_.scene)));
        settings_.tolerance = 0.05;
        settings_.contributions = SourceSplit::luminaires;
        settings_.sensitivities = true;
    }

    Results run(std::uint64_t seed, const Control& control = {}) {
        settings_.seed = seed;
        return calculate(*scene_, surfaces_, settings_, control);
    }

    static bool some_changed(const Results& r) {
        return r.estimator.find("path tracing (0 points)") == std::string::npos;
    }

    static std::vector<double> values(const Results& r) {
        std::vector<double> all;
        for (const SurfaceResult& s : r.surfaces)
            for (const PointResult& p : s.points)
                all.push_back(p.total.mean);
        return all;
    }

    Project project_;
    std::vector<CalculationSurface> surfaces_;
    std::optional<Scene> scene_;
    Settings settings_;
};

TEST_F(LastPointsOfARun, AreThoseOfPathTracing) {
    constexpr std::size_t runs = 8;
    std::vector<double> sum(values(run(1)).size(), 0.0);
    std::vector<double> squares(sum.size(), 0.0);
    std::size_t with_changes = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const Results r = run(seed);
        EXPECT_TRUE(r.converged);
        with_changes += some_changed(r) ? 1 : 0;
        const std::vector<double> v = values(r);
        for (std::size_t p = 0; p < v.size(); ++p) {
            sum[p] += v[p] / runs;
            squares[p] += v[p] * v[p] / runs;
        }
    }
    EXPECT_GE(with_changes, runs / 2);
    Settings traced;
    traced.estimator = Estimator::path_tracing;
    traced.fixed_units = 16;
    traced.seed = 1U << 20U;
    const Results truth = calculate(*scene_, surfaces_, traced);
    double common = 0.0;
    std::size_t p = 0;
    for (const SurfaceResult& s : truth.surfaces)
        for (const PointResult& t : s.points) {
            const double own = std::max(0.0, squares[p] - sum[p] * sum[p]) / (runs - 1.0);
            const double error = std::sqrt(own + std::pow(t.total.standard_error, 2));
            // seven degrees of freedom have long tails; a lost part would be ten times this
            EXPECT_LT(std::abs(sum[p] - t.total.mean), z_limit * error + 0.02 * t.total.mean)
                << s.surface.name << " point " << p << ": " << sum[p] << ", " << t.total.mean;
            common += (sum[p] / t.total.mean - 1.0) / static_cast<double>(sum.size());
            ++p;
        }
    EXPECT_LT(std::abs(common), 0.005);
}

TEST_F(LastPointsOfARun, KeepTheirBooks) {
    const Results r = run(1);
    ASSERT_TRUE(some_changed(r)) << r.estimator;
    ASSERT_TRUE(r.contributions);
    const Contributions& c = *r.contributions;
    const std::vector<double> all = values(r);
    for (std::size_t p = 0; p < all.size(); ++p) {
        double sum = 0.0;
        for (std::size_t s = 0; s < c.sources.size(); ++s)
            for (std::size_t k = 0; k < c.replicates; ++k) {
                const std::size_t at = (s * c.replicates + k) * c.points + p;
                sum += static_cast<double>(c.direct[at]) + static_cast<double>(c.indirect[at]);
            }
        EXPECT_NEAR(sum / static_cast<double>(c.replicates), all[p], 1e-5 * all[p]) << p;
    }
}

TEST_F(LastPointsOfARun, AreTheSameForAnyNumberOfThreads) {
    std::vector<double> first;
    for (const std::size_t threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const Results r = run(1);
        EXPECT_TRUE(some_changed(r));
        if (first.empty())
            first = values(r);
        EXPECT_EQ(values(r), first) << threads;
    }
}

TEST_F(LastPointsOfARun, KeepWhatTheyHadWhenStoppedBeforeThereIsMore) {
    std::uint64_t seed = 1;
    for (const int looks : {1, 2, 3}) {
        const auto suits = [&] {
            const Results r = run(seed);
            return r.looks > static_cast<std::size_t>(looks) && some_changed(r);
        };
        while (seed < 50 && !suits())
            ++seed;
        std::stop_source stop;
        Control control;
        control.stop = stop.get_token();
        double worst = 0.0;
        int seen = 0;
        control.progress = [&](const Progress& p) {
            seen += p.worst_relative_error != worst ? 1 : 0;
            worst = p.worst_relative_error;
            if (seen == looks)
                stop.request_stop();
        };
        const Results r = run(seed, control);
        EXPECT_TRUE(r.interrupted) << seed;
        for (const SurfaceResult& s : r.surfaces)
            for (const PointResult& p : s.points)
                EXPECT_GT(p.indirect.mean, 0.0) << looks;
    }
}

/// METHODS 3.6: at the first look the error of a point with a heavy tail counts sqrt(2) times.
/// Runs that end there hold all of them to that; without the rule 14 points would not.
TEST_F(LastPointsOfARun, AreLessTrustedWithAHeavyTail) {
    settings_.contributions = SourceSplit::none;
    settings_.sensitivities = false;
    settings_.absolute_tolerance = 80.0; // so that about half of the runs end at once
    const double factor =
        StoppingRule(settings_.tolerance, settings_.confidence, 1).factor(0, 16);
    int ended = 0;
    int heavy = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const Results r = run(seed);
        if (r.looks > 1)
            continue;
        ++ended;
        for (const SurfaceResult& s : r.surfaces)
            for (const PointResult& p : s.points) {
                if (!p.heavy_tail)
                    continue;
                ++heavy;
                EXPECT_LE(
                    std::sqrt(2.0) * factor * p.total.standard_error,
                    std::max(settings_.absolute_tolerance, settings_.tolerance * p.total.mean)
                        * (1.0 + 1e-9));
            }
    }
    EXPECT_GT(ended, 10);
    EXPECT_LT(ended, 30);
    EXPECT_GT(heavy, 100);
}

TEST_F(LastPointsOfARun, OfWhichNothingIsKnownEndInAMessage) {
    for (const double limit : {1e-6, 0.02, 0.05, 0.1}) {
        settings_.time_limit = std::chrono::duration<double>(limit);
        const Results r = run(1);
        if (r.replicates == 0)
            EXPECT_FALSE(r.notices.empty());
        else
            EXPECT_GE(r.replicates, 4U);
    }
}

} // namespace
} // namespace isolux
