#include <bit>
#include <tuple>

#include <gtest/gtest.h>

#include "isolux/calc/effort.h"
#include "isolux/calc/pilot.h"
#include "isolux/calc/work_plan.h"

namespace isolux {
namespace {

constexpr UnitCosts costs{.path = 600.0,
                          .pair = 1.0,
                          .draw = 60.0,
                          .direction = 400.0,
                          .sample = 1000.0,
                          .point = 150.0};

double cost_of(const EffortChoice& c, std::size_t points) {
    return static_cast<double>(c.units) * costs.of(c.effort, points);
}

TEST(Effort, ReachesWhatIsAllowed) {
    const VarianceModel model{.paths = 3000.0, .draws = 20.0, .directions = 2.0, .direct = 0.5};
    const EffortChoice c = choose_effort(model, costs, 300);
    EXPECT_LE((model.of(c.effort) + model.direct) / static_cast<double>(c.units), 0.7);
}

TEST(Effort, StaysWithinItsBoundsAndPowersOfTwo) {
    for (const double scale : {0.0, 1e-3, 1.0, 1e3, 1e9}) {
        const VarianceModel model{
            .paths = 1e3 * scale, .draws = 10.0 * scale, .directions = scale, .direct = 0.0};
        const EffortChoice c = choose_effort(model, costs, 100);
        for (const auto& [value, least, most] :
             {std::tuple{c.effort.paths, fewest_paths, most_paths},
              std::tuple{c.effort.draws, fewest_draws, most_draws},
              std::tuple{c.effort.directions, std::size_t{1}, most_directions},
              std::tuple{c.units, std::size_t{1}, most_units}}) {
            EXPECT_TRUE(std::has_single_bit(value));
            EXPECT_GE(value, least);
            EXPECT_LE(value, most);
        }
    }
}

TEST(Effort, IsLeastWhereNothingIsAskedFor) {
    const EffortChoice c = choose_effort({}, costs, 100);
    EXPECT_EQ(c.effort.paths, fewest_paths);
    EXPECT_EQ(c.effort.draws, fewest_draws);
    EXPECT_EQ(c.effort.directions, 1U);
    EXPECT_EQ(c.units, 1U);
}

TEST(Effort, WalksMorePathsWhereMorePointsShareThem) {
    const VarianceModel model{.paths = 2000.0, .draws = 10.0, .directions = 1.0};
    const EffortChoice few = choose_effort(model, costs, 10);
    const EffortChoice many = choose_effort(model, costs, 10000);
    EXPECT_GT(many.effort.paths * many.units, few.effort.paths * few.units);
}

TEST(Effort, CostsNoMoreThanItsNeighbours) {
    const VarianceModel model{.paths = 5000.0, .draws = 40.0, .directions = 3.0, .direct = 0.1};
    const EffortChoice best = choose_effort(model, costs, 300);
    for (const std::size_t factor : {1U, 4U}) {
        EffortChoice other = best;
        other.effort.paths = other.effort.paths * factor / 2;
        while ((model.of(other.effort) + model.direct) / static_cast<double>(other.units) > 0.7)
            other.units *= 2;
        EXPECT_GE(cost_of(other, 300), cost_of(best, 300));
    }
}

TEST(WorkPlan, TracesAClassWherePathTracingIsMoreEfficient) {
    Pilot pilot;
    pilot.points = {30, 30};
    pilot.all = {.paths = 100.0, .draws = 4.0, .directions = 1.0, .samples = 50.0};
    pilot.of_class[0] = {.paths = 100.0, .draws = 4.0, .directions = 1.0, .samples = 50.0};
    pilot.of_class[1] = {.paths = 1e6, .draws = 4.0, .directions = 1.0, .samples = 1.0};
    const WorkPlan plan = make_work_plan(Settings{}, pilot, costs, 60);
    EXPECT_EQ(plan.of_class[0], PointEstimator::mis);
    EXPECT_EQ(plan.of_class[1], PointEstimator::path_tracing);
    EXPECT_GT(plan.advantage[0], 1.0);
    EXPECT_LT(plan.advantage[1], 0.8);
    EXPECT_NE(describe_advantage(plan).find("open points"), std::string::npos);
}

TEST(WorkPlan, LeavesTheEstimatorToTheUserWhoNamesOne) {
    Pilot pilot;
    pilot.points = {30, 30};
    pilot.of_class[1] = {.paths = 1e6, .draws = 4.0, .directions = 1.0, .samples = 1.0};
    Settings settings;
    settings.estimator = Estimator::local_estimation_mis;
    const WorkPlan plan = make_work_plan(settings, pilot, costs, 60);
    EXPECT_EQ(plan.of_class[1], PointEstimator::mis);
}

} // namespace
} // namespace isolux
