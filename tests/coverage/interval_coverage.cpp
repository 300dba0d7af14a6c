// How often the 95 % intervals of whole runs hold the truth: many seeded runs of shipped
// projects; points, Em and U0 apart. METHODS "Coverage" has the figures it gave.
//
//   interval_coverage [RUNS [PROJECT ...]]      default 1000, three projects

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "isolux/calc/calculate.h"
#include "isolux/io/project_json.h"

#include "support/source_dir.h"

namespace isolux {
namespace {

constexpr double confidence = 0.95;

/// Points taken from each project, spread over its first surface.
constexpr std::size_t points_taken = 24;

/// Runs with other seeds behind the truth, and their units: its error is an eleventh of a
/// run's.
constexpr std::size_t truth_runs = 32;
constexpr std::size_t truth_units = 4;

/// Accepted without an explanation.
constexpr double lowest = 0.935;
constexpr double highest = 0.965;

struct Truth {
    std::vector<double> points;
    double mean = 0.0;
    double uniformity = 0.0;
};

/// Every n-th point of the first grid.
CalculationSurface pick_points(const Project& project) {
    CalculationSurface picked;
    const CalculationSurface& all = project.surfaces.front();
    picked.name = all.name;
    picked.kind = all.kind;
    const std::size_t n = std::min(points_taken, all.receivers.size());
    for (std::size_t i = 0; i < n; ++i)
        picked.receivers.push_back(all.receivers[(2 * i + 1) * all.receivers.size() / (2 * n)]);
    return picked;
}

SurfaceResult run(const Scene& scene,
                  const CalculationSurface& surface,
                  std::uint64_t seed,
                  std::size_t units) {
    Settings settings;
    settings.seed = seed;
    settings.fixed_units = units;
    return calculate(scene, {&surface, 1}, settings).surfaces.front();
}

Truth find_truth(const Scene& scene, const CalculationSurface& surface) {
    Truth truth;
    truth.points.assign(surface.receivers.size(), 0.0);
    for (std::size_t r = 0; r < truth_runs; ++r) {
        const SurfaceResult result = run(scene, surface, 1'000'000 + r, truth_units);
        for (std::size_t p = 0; p < truth.points.size(); ++p)
            truth.points[p] += result.points[p].total.mean / truth_runs;
    }
    double sum = 0.0;
    for (const double e : truth.points)
        sum += e;
    truth.mean = sum / static_cast<double>(truth.points.size());
    truth.uniformity = std::ranges::min(truth.points) / truth.mean;
    return truth;
}

std::string verdict(std::size_t hits, std::size_t of) {
    const double share = static_cast<double>(hits) / static_cast<double>(of);
    return fmt::format("{:.2f} %{}",
                       100.0 * share,
                       share < lowest    ? " (too few)"
                       : share > highest ? " (too many)"
                                         : "");
}

void measure(const std::filesystem::path& file, std::size_t runs) {
    Project project = read_project(file);
    const CalculationSurface surface = pick_points(project);
    const std::string name = project.name;
    const Scene scene = build_scene(std::move(project.scene));
    const Truth truth = find_truth(scene, surface);
    std::vector<std::size_t> hits(truth.points.size(), 0);
    std::size_t hits_mean = 0;
    std::size_t hits_uniformity = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const SurfaceResult r = run(scene, surface, seed, 1);
        for (std::size_t p = 0; p < hits.size(); ++p)
            hits[p] +=
                confidence_interval(r.points[p].total, confidence).contains(truth.points[p]);
        hits_mean += confidence_interval(r.summary.mean, confidence).contains(truth.mean);
        hits_uniformity +=
            confidence_interval(r.summary.uniformity, confidence).contains(truth.uniformity);
    }
    std::size_t all = 0;
    for (const std::size_t h : hits)
        all += h;
    fmt::print("{} ({}, {} points, {} runs): points {}, single points {:.1f}..{:.1f} %; Em {}; "
               "U0 {}\n",
               name,
               surface.name,
               hits.size(),
               runs,
               verdict(all, runs * hits.size()),
               100.0 * static_cast<double>(std::ranges::min(hits)) / static_cast<double>(runs),
               100.0 * static_cast<double>(std::ranges::max(hits)) / static_cast<double>(runs),
               verdict(hits_mean, runs),
               verdict(hits_uniformity, runs));
    std::fflush(stdout);
}

} // namespace
} // namespace isolux

int main(int argc, char** argv) {
    const std::size_t runs = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1000;
    std::vector<std::string> projects(argv + std::min(argc, 2), argv + argc);
    if (projects.empty())
        projects = {"cornell-box", "corridor-l-shape", "classroom"};
    for (const std::string& project : projects)
        isolux::measure(isolux::test::source_dir() / "projects" / project / "project.json",
                        runs);
    return 0;
}
