#include <gtest/gtest.h>

#include "isolux/cli/run_report.h"

namespace isolux {
namespace {

TEST(FormatEstimate, ShowsTwoDigitsOfTheDoubt) {
    // Student's t for 15 degrees of freedom and 95 % is 2.131.
    EXPECT_EQ(format_estimate({512.34567, 1.0, 16}, 0.95), "512.3 +-2.1");
    EXPECT_EQ(format_estimate({512.34567, 100.0, 16}, 0.95), "512 +-213");
    EXPECT_EQ(format_estimate({0.65432, 0.005, 16}, 0.95), "0.654 +-0.011");
}

TEST(FormatEstimate, ShowsDeterministicValuesAlone) {
    EXPECT_EQ(format_estimate({512.34567, 0.0, 16}, 0.95), "512.3");
    EXPECT_EQ(format_estimate({0.0, 0.0, 16}, 0.95), "0");
    EXPECT_EQ(format_estimate({0.5, 0.0, 1}, 0.95), "0.5");
}

SurfaceResult make_surface(const char* name, bool converged) {
    SurfaceResult s;
    s.surface.name = name;
    s.points.resize(45);
    s.summary.mean = {500.0, 1.0, 16};
    s.summary.minimum = {300.0, 2.0, 16};
    s.summary.maximum = {700.0, 2.0, 16};
    s.summary.uniformity = {0.6, 0.01, 16};
    s.summary.diversity = {0.43, 0.01, 16};
    s.converged = converged;
    return s;
}

TEST(MaintenanceLine, SaysWhetherValuesAreMaintainedOnes) {
    ScheduleEntry a;
    a.count = 2;
    a.maintenance.value = 0.8;
    EXPECT_EQ(to_maintenance_line({a, a}),
              "values are maintained ones: maintenance factor 0.8\n");
    ScheduleEntry b = a;
    b.maintenance.value = 0.67;
    EXPECT_EQ(to_maintenance_line({a, b}),
              "values are maintained ones: maintenance factor 0.8, 0.67\n");
    a.maintenance.value = 1.0;
    EXPECT_EQ(to_maintenance_line({a}),
              "values are initial ones: the maintenance factor is 1\n");
    EXPECT_EQ(to_maintenance_line({}), "");
}

TEST(SceneLines, HaveTheMeanOfEverySurface) {
    Results results;
    EXPECT_EQ(to_scene_lines(results), "");
    results.surfaces.push_back(make_surface("desk", true));
    SceneResult scene;
    scene.name = "evening";
    scene.surfaces.push_back(results.surfaces[0].summary);
    results.scenes.push_back(scene);
    EXPECT_EQ(to_scene_lines(results),
              "scene evening: desk Em 500.0 +-2.1 lx\n`isolux scenes` tells more of them\n");
}

TEST(SummaryTable, HasOneLineASurface) {
    Results results;
    results.surfaces.push_back(make_surface("desk", true));
    EXPECT_EQ(
        to_summary_table(results),
        "surface  points      Em [lx]    Emin [lx]    Emax [lx]             U0             "
        "Ud\n"
        "-------  ------  -----------  -----------  -----------  -------------  "
        "-------------\n"
        "desk         45  500.0 +-2.1  300.0 +-4.3  700.0 +-4.3  0.600 +-0.021  0.430 "
        "+-0.021\n");
}

TEST(SummaryTable, MarksWhatHasNotConvergedAndOtherQuantities) {
    Results results;
    results.surfaces.push_back(make_surface("desk", false));
    results.surfaces.back().surface.kind = IlluminanceKind::cylindrical;
    EXPECT_NE(to_summary_table(results).find("  cylindrical illuminance, not converged\n"),
              std::string::npos);
}

TEST(SummaryTable, MarksFlaggedErrorBarsWithAnAsterisk) {
    Results results;
    results.surfaces.push_back(make_surface("desk", true));
    results.surfaces.back().points[3].heavy_tail = true;
    EXPECT_NE(to_summary_table(results).find("  * 1 error bar flagged\n"), std::string::npos);
    results.surfaces.back().points[4].near_surface = true;
    EXPECT_NE(to_summary_table(results).find("  * 2 error bars flagged\n"), std::string::npos);
}

TEST(StatisticsNotes, AreSilentWhereThereIsNothingToTell) {
    Results results;
    results.surfaces.push_back(make_surface("desk", true));
    EXPECT_EQ(to_statistics_notes(results), "");
}

TEST(StatisticsNotes, TellWhatTheAsteriskSays) {
    Results results;
    results.surfaces.push_back(make_surface("desk", true));
    results.surfaces.back().points[3].suspicious_replicate = true;
    EXPECT_EQ(
        to_statistics_notes(results),
        "* an error bar is flagged where one replicate stands apart, the replicates have heavy "
        "tails, or another surface is within 1 mm (column flags of the .csv)\n");
}

TEST(RunFacts, TellFluxTimeAndRays) {
    Results results;
    results.flux_balance = {{24000.0, 0.0, 1}, {23900.0, 100.0, 16}, {0.0, 0.0, 16}};
    results.wall_seconds = 12.3;
    results.cpu_seconds = 24.4;
    results.rays = {5000, 20000, 7'800'000};
    results.paths = 1234;
    EXPECT_EQ(to_run_facts(results),
              "+- is half the 95 % confidence interval\n"
              "flux: 24000 lm emitted = 23900 +-213 lm absorbed + 0 lm escaped, 0.42 % "
              "unaccounted for\n"
              "time: 12 s (24 s of processor time); 7.8 million rays, 1234 light paths\n");
}

TEST(RunFacts, SayWhenLightWasNotFollowed) {
    Results results;
    results.flux_balance.emitted = {850.0, 0.0, 1};
    EXPECT_NE(
        to_run_facts(results).find("flux: 850 lm emitted; not followed (direct light only)\n"),
        std::string::npos);
}

} // namespace
} // namespace isolux
