#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/base/error.h"
#include "isolux/base/parallel.h"
#include "isolux/calc/bench_rooms.h"
#include "isolux/cli/bench_report.h"
#include "isolux/cli/calculation_options.h"
#include "isolux/cli/console.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/terminal.h"
#include "isolux/cli/verbs.h"

namespace isolux {

namespace {

/// Sizes of the tasks that cost is measured against.
constexpr std::array<std::size_t, 4> point_counts{100, 1000, 10000, 100000};
constexpr std::array<std::size_t, 5> luminaire_counts{1, 30, 200, 1000, 3000};
constexpr std::size_t points_under_luminaires = 96;

struct BenchOptions {
    std::string project;
    std::string rooms;
    std::string estimators;
    std::string seconds = "1";
    std::string seeds = "3";
    std::string seed = "1";
    std::string threads;
    std::string most_points = "100000";
    std::string most_luminaires = "3000";
    bool is_json = false;
    bool is_quiet = false;
};

std::vector<std::string> split(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

BenchSettings read_settings(const BenchOptions& o) {
    BenchSettings settings;
    settings.seconds = parse_duration("--seconds", o.seconds).count();
    settings.reference_seconds = 8.0 * settings.seconds;
    settings.seeds = parse_count("--seeds", o.seeds, 1, 1000);
    settings.seed = parse_count("--seed", o.seed, 0, UINT32_MAX);
    if (o.estimators == "all") {
        settings.estimators.clear();
        for (const EstimatorName& e : estimator_names)
            settings.estimators.push_back(e.estimator);
    } else if (!o.estimators.empty()) {
        settings.estimators.clear();
        for (const std::string& word : split(o.estimators))
            settings.estimators.push_back(parse_estimator("--estimators", word));
    }
    return settings;
}

std::vector<std::string> read_rooms(const BenchOptions& o) {
    const std::span<const std::string_view> known = bench_room_names();
    if (o.rooms.empty())
        return {known.begin(), known.end()};
    if (o.rooms == "none")
        return {};
    std::vector<std::string> rooms = split(o.rooms);
    for (const std::string& room : rooms)
        if (std::ranges::find(known, room) == known.end())
            throw InputError("--rooms",
                             fmt::format("'{}' is not a room", room),
                             fmt::format("Known are {}, or none", fmt::join(known, ", ")));
    return rooms;
}

/// Shows what is going on; a bench has no share of work done to tell.
class BenchLine {
public:
    explicit BenchLine(bool is_shown) : line_(is_shown) {}

    void show(const std::string& what) {
        Progress progress;
        progress.stage = what.c_str();
        progress.seconds_left = -1.0;
        line_.show(progress);
    }

    void clear() noexcept { line_.clear(); }

private:
    ProgressLine line_;
};

class Bench {
public:
    explicit Bench(const BenchOptions& o)
        : options_(o), line_(!o.is_quiet && is_progress_wanted()) {
        report_.settings = read_settings(o);
        report_.threads = o.threads.empty() ? hardware_threads()
                                            : parse_count("--threads", o.threads, 1, 1024);
    }

    ExitCode run() {
        const std::vector<std::string> rooms = read_rooms(options_);
        const std::size_t most_points =
            parse_count("--points", options_.most_points, 0, 10'000'000);
        const std::size_t most_luminaires =
            parse_count("--luminaires", options_.most_luminaires, 0, 100'000);
        if (options_.project.empty()) {
            for (const std::string& name : rooms) {
                BenchRoom room = make_bench_room(name);
                measure(name, build_scene(std::move(room.scene)), room.surfaces);
            }
            scale_points(most_points);
            scale_luminaires(most_luminaires);
        } else {
            measure_project();
        }
        line_.clear();
        if (options_.is_json)
            print(to_json(report_));
        return ExitCode::success;
    }

private:
    void measure_project() {
        Project project = load_project(options_.project);
        std::size_t points = 0;
        for (const CalculationSurface& s : project.surfaces)
            points += s.receivers.size();
        if (points == 0 || project.scene.luminaires.empty())
            throw InputError(options_.project,
                             "no points or no luminaires (nothing to measure)",
                             "Give it a calculation surface and a luminaire");
        measure(project.name, build_scene(std::move(project.scene)), project.surfaces);
    }

    void measure(const std::string& name,
                 const Scene& scene,
                 const std::vector<CalculationSurface>& surfaces) {
        report_.rooms.push_back(
            measure_room(name, scene, surfaces, report_.settings, [&](const auto& what) {
                line_.show(what);
            }));
        say(to_text(report_.rooms.back()) + "\n");
    }

    ScalingRow scale(BenchRoom room) {
        line_.show(room.description);
        return measure_scaling(
            build_scene(std::move(room.scene)), room.surfaces, report_.settings.seed);
    }

    void scale_points(std::size_t most) {
        for (const std::size_t n : point_counts) {
            if (n > most)
                break;
            const auto rows = static_cast<std::size_t>(
                std::max(1.0, std::round(std::sqrt(static_cast<double>(n) / 1.5))));
            report_.by_points.push_back(
                scale(make_empty_bench_room((n + rows - 1) / rows, rows, 2, 2)));
        }
        if (!report_.by_points.empty())
            say(scaling_text("Cost against points, empty room, 4 panels", report_.by_points)
                + "\n");
    }

    void scale_luminaires(std::size_t most) {
        for (const std::size_t n : luminaire_counts) {
            if (n > most)
                break;
            const auto rows = static_cast<std::size_t>(
                std::max(1.0, std::floor(std::sqrt(static_cast<double>(n)))));
            const std::size_t columns = (n + rows - 1) / rows;
            report_.by_luminaires.push_back(
                scale(make_hall_bench_room(12, points_under_luminaires / 12, columns, rows)));
            report_.by_luminaires_and_size.push_back(
                scale(make_empty_bench_room(12, points_under_luminaires / 12, columns, rows)));
        }
        if (report_.by_luminaires.empty())
            return;
        say(scaling_text("Cost against luminaires, hall of 60 m x 40 m x 6 m",
                         report_.by_luminaires)
            + "\n");
        say(scaling_text("Cost against luminaires, empty room that grows with them",
                         report_.by_luminaires_and_size));
    }

    /// Tables appear as they are done.
    void say(const std::string& text) {
        line_.clear();
        if (!options_.is_json) {
            print(text);
            flush_output();
        }
    }

    const BenchOptions& options_;
    BenchLine line_;
    BenchReport report_;
};

ExitCode run_bench(const BenchOptions& o) {
    Bench bench(o);
    const ThreadLimit limit(o.threads.empty() ? 0
                                              : parse_count("--threads", o.threads, 1, 1024));
    return bench.run();
}

} // namespace

Action add_bench(CLI::App& verb) {
    verb.description("Measure CPU seconds to an error, for every estimator");
    verb.footer(R"(
For each room: CPU seconds (scene built) to 2, 1, 0.5 and 0.2 % RMS error over the points, against
an independent long run, less what that states of its own error; efficiency = 1/(mean square
error x CPU seconds) with its spread over seeds; rays a second, and shadow rays beside the bare
ray tracer's on the same rays, which searches all triangles, outer walls too. Then cost against
the number of points and of luminaires. "~" is extrapolated from the longest run, "<=" reached
by the shortest.

Without PROJECT the program's own rooms are measured; that takes some minutes.

Examples:
  isolux bench                                            everything
  isolux bench projects/open-office                       a project of yours
  isolux bench --rooms doorway,near-walls --estimators mis,path-tracing --seconds 4
  isolux bench --rooms none --points 10000 --luminaires 1000      cost against size only
  isolux bench --rooms empty-room --points 0 --luminaires 0 --json)");
    const auto o = std::make_shared<BenchOptions>();
    verb.add_option("PROJECT", o->project, "A project file, or a folder with project.json")
        ->type_name("");
    verb.add_option("--rooms", o->rooms, "Rooms by name, with commas; none (default: all)")
        ->type_name("NAMES");
    verb.add_option("--estimators",
                    o->estimators,
                    "By name, with commas; all (default auto,mis,path-tracing,local)")
        ->type_name("NAMES");
    verb.add_option("--seconds", o->seconds, "CPU time of an estimator's longest run")
        ->type_name("TIME")
        ->capture_default_str();
    verb.add_option("--seeds", o->seeds, "Repeats of the longest run, for the spread")
        ->type_name("N")
        ->capture_default_str();
    verb.add_option("--points", o->most_points, "Largest number of points to scale to")
        ->type_name("N")
        ->capture_default_str();
    verb.add_option("--luminaires", o->most_luminaires, "Largest number of luminaires")
        ->type_name("N")
        ->capture_default_str();
    verb.add_option("--seed", o->seed, "Seed of the random numbers")
        ->type_name("N")
        ->capture_default_str();
    verb.add_option("--threads", o->threads, "Threads to use (default: all)")->type_name("N");
    verb.add_flag("--json", o->is_json, "Print JSON, with every run");
    verb.add_flag("--quiet", o->is_quiet, "No progress line");
    return [o] { return run_bench(*o); };
}

} // namespace isolux
