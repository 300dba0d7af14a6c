// How far runs that stop by themselves are from a long one, point by point: what stopping and
// changes of estimator cost (METHODS "Stopping" has the figures it gave).
//
//   stopped_runs PROJECT TOLERANCE RUNS UNITS        UNITS: of the long run
//   stopped_runs classroom 0.04 60 256

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "isolux/calc/calculate.h"
#include "isolux/io/project_json.h"

#include "support/source_dir.h"

namespace isolux {
namespace {

std::vector<Estimate> totals(const Results& results) {
    std::vector<Estimate> all;
    for (const SurfaceResult& s : results.surfaces)
        for (const PointResult& p : s.points)
            all.push_back(p.total);
    return all;
}

void measure(const Project& project,
             const Scene& scene,
             double tolerance,
             std::size_t runs,
             std::size_t units) {
    Settings settings;
    settings.seed = 1ULL << 33U;
    settings.fixed_units = units;
    const std::vector<Estimate> truth = totals(calculate(scene, project.surfaces, settings));
    settings.fixed_units.reset();
    settings.tolerance = tolerance;
    const double points = static_cast<double>(truth.size());
    std::vector<double> deviation(truth.size(), 0.0); // mean over the runs
    std::vector<double> of_run;
    double held = 0.0;
    double within = 0.0;
    for (std::size_t run = 1; run <= runs; ++run) {
        settings.seed = run;
        const std::vector<Estimate> found =
            totals(calculate(scene, project.surfaces, settings));
        double sum = 0.0;
        for (std::size_t p = 0; p < truth.size(); ++p) {
            const double d = found[p].mean / truth[p].mean - 1.0;
            deviation[p] += d / static_cast<double>(runs);
            sum += d / points;
            held += confidence_interval(found[p], 0.95).contains(truth[p].mean) ? 1.0 : 0.0;
            within += std::abs(d) <= tolerance ? 1.0 : 0.0;
        }
        of_run.push_back(sum);
    }
    const Estimate mean = estimate_from_replicates(of_run);
    const auto [lowest, highest] = std::ranges::minmax(deviation);
    fmt::print("{}: {} runs to {} %: mean deviation {:.3f} +- {:.3f} %, of a point {:.2f} .. "
               "{:.2f} %; held by {:.2f} % of the intervals, {:.2f} % within the tolerance\n",
               project.name,
               runs,
               100.0 * tolerance,
               100.0 * mean.mean,
               100.0 * mean.standard_error,
               100.0 * lowest,
               100.0 * highest,
               100.0 * held / (points * static_cast<double>(runs)),
               100.0 * within / (points * static_cast<double>(runs)));
}

} // namespace
} // namespace isolux

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fputs("stopped_runs PROJECT TOLERANCE RUNS UNITS\n", stderr);
        return 2;
    }
    isolux::Project project = isolux::read_project(isolux::test::source_dir() / "projects"
                                                   / argv[1] / "project.json");
    const isolux::Scene scene = isolux::build_scene(std::move(project.scene));
    isolux::measure(project,
                    scene,
                    std::strtod(argv[2], nullptr),
                    std::strtoul(argv[3], nullptr, 10),
                    std::strtoul(argv[4], nullptr, 10));
    return 0;
}
