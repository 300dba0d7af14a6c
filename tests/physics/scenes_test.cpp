// A scene recombined from a real project's contributions is a new calculation with its dimming.

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/calc/calculate_project.h"
#include "isolux/calc/light_scenes.h"
#include "isolux/io/project_json.h"

#include "support/source_dir.h"

namespace isolux {
namespace {

Settings fixed_work(std::uint64_t seed) {
    Settings settings;
    settings.fixed_units = 2;
    settings.seed = seed;
    settings.contributions = SourceSplit::groups;
    return settings;
}

Project classroom() {
    Project p = read_project(test::source_dir() / "projects/classroom/project.json");
    p.requirements.clear(); // and with them the observers: only illuminances are compared
    p.observers.clear();
    return p;
}

/// A difference of two independent estimates, in its standard errors.
double distance(const Estimate& a, const Estimate& b) {
    return std::abs(a.mean - b.mean) / std::hypot(a.standard_error, b.standard_error);
}

/// Two-sided Student test of every point and every surface's mean. With fewer degrees of
/// freedom than Welch's the test is on the safe side: the false alarm rate of all comparisons
/// together stays below 1e-6.
TEST(Scenes, OfTheClassroomAreThoseOfANewCalculationWithTheSameDimming) {
    const LightScene lesson{"lesson",
                            {0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3, 1.2, 1.2, 1.2, 1.2}};
    Project full = classroom();
    Project dimmed = classroom();
    ASSERT_EQ(full.scene.luminaires.size(), lesson.factors.size());
    for (std::size_t l = 0; l < lesson.factors.size(); ++l)
        dimmed.scene.luminaires[l].scale *= lesson.factors[l];

    const Scene full_scene = build_scene(std::move(full.scene));
    const Results run = calculate_project(full_scene, full, fixed_work(1), {});
    const auto recombined = evaluate_scene(*run.contributions, lesson, run, {}, run.confidence);
    ASSERT_TRUE(recombined.has_value());
    const Scene dimmed_scene = build_scene(std::move(dimmed.scene));
    const Results fresh = calculate_project(dimmed_scene, dimmed, fixed_work(101), {});

    const auto levels = source_levels(run.contributions->sources, lesson.factors);
    ASSERT_TRUE(levels.has_value());
    const std::size_t comparisons = run.contributions->points + run.surfaces.size();
    const double limit =
        student_quantile(1.0 - 1e-6 / static_cast<double>(comparisons),
                         static_cast<double>(run.contributions->replicates - 1));
    std::size_t first = 0;
    for (std::size_t s = 0; s < run.surfaces.size(); ++s) {
        const std::string& name = run.surfaces[s].surface.name;
        const Estimate& mean = recombined->surfaces[s].mean;
        EXPECT_LT(distance(mean, fresh.surfaces[s].summary.mean), limit) << name;
        EXPECT_LT(mean.standard_error, 0.01 * mean.mean) << name; // the test has teeth
        const std::size_t points = run.surfaces[s].points.size();
        const ReplicateTable table = combine(*run.contributions, *levels, first, points);
        for (std::size_t p = 0; p < points; ++p) {
            std::vector<double> values;
            for (std::size_t r = 0; r < table.replicates; ++r)
                values.push_back(table.row(r)[p]);
            EXPECT_LT(
                distance(estimate_from_replicates(values), fresh.surfaces[s].points[p].total),
                limit)
                << name << " " << p;
        }
        first += points;
    }
}

} // namespace
} // namespace isolux
