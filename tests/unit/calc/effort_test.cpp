#include <algorithm>
#include <array>
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
                          .look = 60.0,
                          .point = 150.0};

/// So many points, all open.
SharedTask open_task(const VarianceModel& model, std::size_t points) {
    return {{points, 0, 0, 0}, {model, {}, {}, {}}, costs, {}};
}

double variance_of(const VarianceModel& model, const Effort& e) {
    return model.of(e.paths, e.at[0]) + model.of_direct(e.at[0]);
}

double cost_of(const EffortChoice& c, std::size_t points) {
    return static_cast<double>(c.units) * costs.of(c.effort.paths, c.effort.at[0], points);
}

TEST(Effort, ReachesWhatIsAllowed) {
    const VarianceModel model{.paths = 3000.0, .draws = 20.0, .directions = 2.0, .direct = 0.5};
    const EffortChoice c = choose_effort(open_task(model, 300));
    EXPECT_LE(variance_of(model, c.effort) / static_cast<double>(c.units), 0.3);
}

TEST(Effort, StaysWithinItsBoundsAndPowersOfTwo) {
    for (const double scale : {0.0, 1e-3, 1.0, 1e3, 1e9}) {
        const VarianceModel model{.paths = 1e3 * scale,
                                  .draws = 10.0 * scale,
                                  .directions = scale,
                                  .direct = scale,
                                  .look_samples = 4.0};
        const EffortChoice c = choose_effort(open_task(model, 100));
        for (const auto& [value, least, most] :
             {std::tuple{c.effort.paths, fewest_paths, most_paths},
              std::tuple{c.effort.at[0].draws, fewest_draws, most_draws},
              std::tuple{c.effort.at[0].directions, std::size_t{1}, most_directions},
              std::tuple{c.effort.at[0].looks, std::size_t{1}, std::size_t{16}},
              std::tuple{c.units, std::size_t{1}, most_units}}) {
            EXPECT_TRUE(std::has_single_bit(value));
            EXPECT_GE(value, least);
            EXPECT_LE(value, most);
        }
    }
}

TEST(Effort, IsLeastWhereNothingIsAskedFor) {
    const EffortChoice c = choose_effort(open_task({}, 100));
    EXPECT_EQ(c.effort.paths, fewest_paths);
    EXPECT_EQ(c.effort.at[0].draws, fewest_draws);
    EXPECT_EQ(c.effort.at[0].directions, 1U);
    EXPECT_EQ(c.effort.at[0].looks, 1U);
    EXPECT_EQ(c.units, 1U);
}

TEST(Effort, SendsRaysWhereOpeningsShineByMirrorsWithoutImages) {
    EXPECT_EQ(fewest_rays_by_mirrors(0.0), 1U);
    EXPECT_EQ(fewest_rays_by_mirrors(0.001), 1U);
    EXPECT_EQ(fewest_rays_by_mirrors(0.01), 4U);
    EXPECT_EQ(fewest_rays_by_mirrors(1.0), 32U);
    SharedTask task = open_task({}, 100);
    task.costs.fewest_directions = 4;
    EXPECT_EQ(choose_effort(task).effort.at[0].directions, 4U);
    EXPECT_EQ(balance_effort(task, 1024).at[0].directions, 4U);
}

TEST(Effort, DoesNotShrinkWhereTheFirstLookCannotReachTheGoal) {
    for (const double farther : {1.0, 100.0, 1e6}) {
        const VarianceModel far{.paths = 1e7 * farther,
                                .draws = 1e5 * farther,
                                .directions = 1e4 * farther,
                                .direct = 1e3};
        const EffortChoice c = choose_effort(open_task(far, 300));
        EXPECT_EQ(c.units, most_units) << farther;
        EXPECT_GT(c.effort.paths, 2 * fewest_paths) << farther;
        EXPECT_GT(c.effort.at[0].draws, 4 * fewest_draws) << farther;
    }
}

TEST(Effort, IsMoreWhereTheNoiseIs) {
    const VarianceModel calm{
        .paths = 2000.0, .draws = 2.0, .directions = 0.1, .look_samples = 30.0};
    VarianceModel noisy = calm;
    noisy.draws = 200.0;
    noisy.directions = 50.0;
    noisy.direct = 5.0;
    noisy.look_samples = 30.0;
    const EffortChoice c = choose_effort({{200, 0, 20, 0}, {calm, {}, noisy, {}}, costs, {}});
    EXPECT_GT(c.effort.at[2].draws, c.effort.at[0].draws);
    EXPECT_GT(c.effort.at[2].directions, c.effort.at[0].directions);
    EXPECT_GT(c.effort.at[2].looks, c.effort.at[0].looks);
}

TEST(Effort, FinishesEveryClassByItself) {
    // Two classes of a large task, the second far noisier: each is brought within what is
    // allowed, and the calm one does no more than it would without the other.
    const VarianceModel calm{.paths = 10.0, .draws = 0.5, .directions = 0.1};
    VarianceModel noisy = calm;
    noisy.directions = 20.0;
    const EffortChoice alone = choose_effort(open_task(calm, 20000));
    const EffortChoice both =
        choose_effort({{20000, 0, 0, 1500}, {calm, {}, {}, noisy}, costs, {}});
    EXPECT_EQ(both.effort.at[0].draws, alone.effort.at[0].draws);
    EXPECT_EQ(both.effort.at[0].directions, alone.effort.at[0].directions);
    EXPECT_EQ(both.units, 1U);
    EXPECT_LE(calm.of(both.effort.paths, both.effort.at[0]), 0.3);
    EXPECT_LE(noisy.of(both.effort.paths, both.effort.at[3]), 0.3);
}

TEST(Effort, LooksForTheFirstTimeWhenAQuarterOfThePointsShouldBeDone) {
    // so noisy that the second class needs many units however much it draws
    const VarianceModel calm{.paths = 10.0, .draws = 0.5, .directions = 0.1};
    const VarianceModel far{.paths = 1e6, .draws = 1e4, .directions = 1e4};
    const auto units = [&](std::size_t of_calm, std::size_t of_far) {
        return choose_effort({{of_calm, 0, of_far, 0}, {calm, {}, far, {}}, costs, {}}).units;
    };
    EXPECT_EQ(units(100, 100), 1U);
    EXPECT_EQ(units(100, 290), 1U);
    EXPECT_GT(units(100, 310), 1U);
    EXPECT_GT(units(0, 100), 1U);
}

TEST(Effort, WalksMorePathsWhereMorePointsShareThem) {
    const VarianceModel model{.paths = 2000.0, .draws = 10.0, .directions = 1.0};
    const EffortChoice few = choose_effort(open_task(model, 10));
    const EffortChoice many = choose_effort(open_task(model, 10000));
    EXPECT_GT(many.effort.paths * many.units, few.effort.paths * few.units);
}

TEST(Effort, CostsNoMoreThanItsNeighbours) {
    const VarianceModel model{.paths = 5000.0, .draws = 40.0, .directions = 3.0, .direct = 0.1};
    const EffortChoice best = choose_effort(open_task(model, 300));
    for (const std::size_t factor : {1U, 4U}) {
        EffortChoice other = best;
        other.effort.paths = other.effort.paths * factor / 2;
        while (variance_of(model, other.effort) / static_cast<double>(other.units) > 0.3)
            other.units *= 2;
        EXPECT_GE(cost_of(other, 300), cost_of(best, 300));
    }
}

TEST(GatherReach, EndsWhereVerticesLieCloser) {
    constexpr double area = 400.0;
    GatherReach reach(area);
    std::array<double, 200> ahead{};
    for (std::size_t i = 0; i < ahead.size(); ++i) {
        ahead[i] = 0.02 * static_cast<double>(i);
        reach.add(PointClass::near, ahead[i]);
    }
    double last = 1.1;
    for (std::size_t m = fewest_paths; m <= most_paths_of_a_tree; m *= 2) {
        const auto those = std::ranges::count_if(
            ahead, [&](double d) { return reach.includes(d, static_cast<double>(m)); });
        const double share = reach.share(1, m);
        EXPECT_DOUBLE_EQ(share, static_cast<double>(those) / 200.0) << m;
        EXPECT_LT(share, last);
        last = share;
    }
    EXPECT_TRUE(reach.includes(0.62, 1024.0)); // sqrt(400/1024) = 0.625
    EXPECT_FALSE(reach.includes(0.63, 1024.0));
    EXPECT_EQ(reach.share(0, 1024), 1.0); // a class without points
    EXPECT_EQ(GatherReach().share(1, 1024), 1.0);
    EXPECT_TRUE(GatherReach().includes(4.0, 131072.0));
}

/// So many of 1000 open points gather beside any number of paths, the others beside none.
SharedTask partly_gathering_task(std::size_t gatherers) {
    const VarianceModel model{.paths = 3000.0, .draws = 20.0, .directions = 5.0};
    SharedTask task = open_task(model, 1000);
    task.reach = GatherReach(100.0);
    for (std::size_t i = 0; i < 1000; ++i)
        task.reach.add(PointClass::open, i < gatherers ? 0.001 : 4.0);
    return task;
}

double cost_of_best(const SharedTask& task) {
    const EffortChoice c = choose_effort(task);
    const double share = task.reach.share(0, c.effort.paths);
    return static_cast<double>(c.units)
           * costs.of(c.effort.paths, c.effort.at[0], 1000, Weighing::all, share);
}

TEST(Effort, CostsLessTheFewerGather) {
    double last = 1e300;
    for (const std::size_t gatherers : {1000U, 500U, 100U, 40U, 1U, 0U}) {
        const double cost = cost_of_best(partly_gathering_task(gatherers));
        EXPECT_LE(cost, 1.001 * last) << gatherers;
        last = cost;
    }
    // what the few need does not depend on how few they are
    const std::size_t few = choose_effort(partly_gathering_task(20)).effort.at[0].directions;
    const std::size_t all = choose_effort(partly_gathering_task(1000)).effort.at[0].directions;
    EXPECT_GT(few, 1U);
    EXPECT_LE(few, 2 * all);
    EXPECT_EQ(choose_effort(partly_gathering_task(0)).effort.at[0].directions, 1U);
}

TEST(Effort, PaysForGatherRaysByWhoSendsThem) {
    const PointEffort e{8, 4, 1};
    EXPECT_NEAR(costs.of(1024, e, 300) - costs.of(1024, e, 300, Weighing::all, 0.25),
                0.75 * 4.0 * costs.direction,
                1e-6);
    // before mirrors all send them, for what they bring by these
    SharedTask task = partly_gathering_task(0);
    task.costs.glance = 100.0;
    EXPECT_GT(choose_effort(task).effort.at[0].directions, 1U);
    EXPECT_DOUBLE_EQ(task.costs.direction_of(0.25), 0.25 * costs.direction + 75.0);
    EXPECT_DOUBLE_EQ(task.share_of_rays(0, 1024), 1.0);
}

/// A task whose points may share a tree.
SharedTask tree_task(std::size_t points, double cut) {
    const VarianceModel model{.paths = 3000.0, .draws = 0.5, .directions = 1.0, .light = 100.0};
    SharedTask task = open_task(model, points);
    task.costs.tree_path = 900.0;
    task.costs.cut = cut;
    task.costs.descent = 150.0;
    return task;
}

TEST(Effort, TakesATreeWhereVeryManyPointsShareIt) {
    constexpr double cut = 1000.0;
    for (const std::size_t points : {24000U, 1000000U}) {
        const Effort chosen = choose_effort(tree_task(points, cut)).effort;
        const Effort balanced = balance_paths(tree_task(points, cut), 8192);
        EXPECT_EQ(chosen.weighing, Weighing::tree) << points;
        EXPECT_EQ(balanced.weighing, Weighing::tree) << points;
        EXPECT_GT(balanced.paths, 16384U) << points;
        EXPECT_LE(balanced.paths, most_paths_of_a_tree) << points;
    }
}

TEST(Effort, WeighsAllForFewPointsAndWhereTheTreeIsDear) {
    const auto expect_all = [](const SharedTask& task) {
        EXPECT_EQ(choose_effort(task).effort.weighing, Weighing::all);
        const Effort balanced = balance_paths(task, 8192);
        EXPECT_EQ(balanced.weighing, Weighing::all);
        EXPECT_EQ(balanced.paths, 8192U);
    };
    expect_all(tree_task(300, 1000.0));
    expect_all(tree_task(4095, 1000.0));
    expect_all(tree_task(24000, 1e6)); // points far apart have no cut in common
    expect_all(tree_task(24000, 0.0)); // nobody asks for one
}

TEST(Effort, KeepsATreeWithinItsMemory) {
    SharedTask task = tree_task(1000000, 1000.0);
    task.costs.vertices = 20.0; // branches
    const Effort e = balance_paths(task, 8192);
    EXPECT_EQ(e.weighing, Weighing::tree);
    EXPECT_LE(static_cast<double>(e.paths) * task.costs.vertices, most_vertices_of_a_tree);
}

TEST(Effort, CountsWhatTheTreeCostsAndVariesBy) {
    const SharedTask task = tree_task(24000, 1000.0);
    const PointEffort e{8, 4, 1};
    const VarianceModel& m = task.models[0];
    EXPECT_NEAR(m.of(8192, e, Weighing::tree) - m.of(8192, e), 1.5e-3 * m.light / 8.0, 1e-12);
    // by the tree a path costs a point nothing but its share of the walk
    const UnitCosts& c = task.costs;
    EXPECT_NEAR(c.of(65536, e, 24000, Weighing::tree) - c.of(32768, e, 24000, Weighing::tree),
                32768.0 * c.tree_path / 24000.0,
                1e-6);
    // ... so what a point costs alone, without the paths, does not depend on them
    EXPECT_NEAR(c.own(65536, e, Weighing::tree), c.own(4096, e, Weighing::tree), 1e-6);
}

TEST(WorkPlan, TracesAClassWherePathTracingIsMoreEfficient) {
    Pilot pilot;
    pilot.points = {30, 30};
    pilot.all = {.paths = 100.0, .draws = 4.0, .directions = 1.0, .samples = 50.0};
    pilot.of_class[0] = {.paths = 100.0, .draws = 4.0, .directions = 1.0, .samples = 50.0};
    pilot.of_class[1] = {.paths = 1e6, .draws = 4.0, .directions = 1.0, .samples = 1.0};
    const WorkPlan plan = make_work_plan(Settings{}, pilot, costs, {30, 30, 0, 0}, {});
    EXPECT_EQ(plan.of_class[0], PointEstimator::mis);
    EXPECT_EQ(plan.of_class[1], PointEstimator::path_tracing);
    EXPECT_GT(plan.advantage[0], 1.0);
    EXPECT_LT(plan.advantage[1], 0.8);
    EXPECT_NE(describe_advantage(plan).find("open points"), std::string::npos);
}

TEST(WorkPlan, LooksAtTheLuminairesWhereTracedPointsNeedIt) {
    Pilot pilot;
    pilot.points = {30, 30};
    pilot.of_class[0] = {.paths = 100.0, .draws = 4.0, .directions = 1.0, .samples = 50.0};
    pilot.of_class[1] = {.paths = 1e6,
                         .draws = 4.0,
                         .directions = 1.0,
                         .direct = 50.0,
                         .samples = 1.0,
                         .look_samples = 8.0};
    const WorkPlan plan = make_work_plan(Settings{}, pilot, costs, {30, 30, 0, 0}, {});
    ASSERT_EQ(plan.of_class[1], PointEstimator::path_tracing);
    EXPECT_EQ(plan.effort.at[0].looks, 1U);
    EXPECT_GT(plan.effort.at[1].looks, 4U);
}

TEST(WorkPlan, LeavesTheEstimatorToTheUserWhoNamesOne) {
    Pilot pilot;
    pilot.points = {30, 30};
    pilot.of_class[1] = {.paths = 1e6, .draws = 4.0, .directions = 1.0, .samples = 1.0};
    Settings settings;
    settings.estimator = Estimator::local_estimation_mis;
    const WorkPlan plan = make_work_plan(settings, pilot, costs, {30, 30, 0, 0}, {});
    EXPECT_EQ(plan.of_class[1], PointEstimator::mis);
}

} // namespace
} // namespace isolux
