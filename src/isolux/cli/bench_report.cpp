#include "isolux/cli/bench_report.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/cli/text_table.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(Estimator estimator) {
    return std::ranges::find(estimator_names, estimator, &EstimatorName::estimator)
        ->on_command_line;
}

std::string seconds(const TimeToError& time) {
    const char* const mark = time.source == TimeSource::at_most        ? "<="
                             : time.source == TimeSource::extrapolated ? "~"
                                                                       : "";
    return fmt::format("{}{:.2g}", mark, time.cpu_seconds);
}

std::string_view word_of(TimeSource source) {
    switch (source) {
    case TimeSource::interpolated:
        return "interpolated";
    case TimeSource::at_most:
        return "at most";
    case TimeSource::extrapolated:
        return "extrapolated";
    }
    return "";
}

Json to_json(const EstimatorBench& e) {
    Json j{{"estimator", name_of(e.estimator)}, {"description", e.description}};
    j["times"] = Json::array();
    for (std::size_t t = 0; t < target_errors.size(); ++t)
        j["times"].push_back({{"rms_error", target_errors[t]},
                              {"cpu_seconds", e.times[t].cpu_seconds},
                              {"found", word_of(e.times[t].source)}});
    j["efficiency_per_second"] = e.efficiency;
    j["efficiency_over_seeds"] = {e.lowest_efficiency, e.highest_efficiency};
    j["rays_per_cpu_second"] = e.rays_per_second;
    j["runs"] = Json::array();
    for (const BenchRun& r : e.runs)
        j["runs"].push_back({{"units", r.units},
                             {"cpu_seconds", r.cpu_seconds},
                             {"rms_error", r.rms_error},
                             {"rays", r.rays}});
    return j;
}

Json to_json(const std::vector<ScalingRow>& rows) {
    Json list = Json::array();
    for (const ScalingRow& r : rows)
        list.push_back({{"points", r.points},
                        {"luminaires", r.luminaires},
                        {"cpu_seconds", r.cpu_seconds},
                        {"stated_rms_error", r.stated_error},
                        {"cpu_seconds_to_1_percent", r.seconds_to_1_percent}});
    return list;
}

} // namespace

std::string to_text(const RoomBench& room) {
    std::string text = fmt::format(
        "{}: {} points, {} luminaires, {} triangles; compared with a run of {:.2g} CPU s that "
        "states {:.2g} % RMS\n\n",
        room.name,
        room.points,
        room.luminaires,
        room.triangles,
        room.reference_seconds,
        100.0 * room.reference_error);
    std::vector<TextTable::Column> columns{{"estimator", Align::left}};
    for (const double target : target_errors)
        columns.push_back({fmt::format("CPU s to {:g} %", 100.0 * target), Align::right});
    columns.push_back({"efficiency 1/s", Align::right});
    columns.push_back({"over the seeds", Align::right});
    columns.push_back({"Mrays/s", Align::right});
    TextTable table(columns);
    for (const EstimatorBench& e : room.estimators) {
        std::vector<std::string> row{std::string(name_of(e.estimator))};
        for (const TimeToError& t : e.times)
            row.push_back(seconds(t));
        row.push_back(fmt::format("{:.3g}", e.efficiency));
        row.push_back(fmt::format("{:.2g}..{:.2g}", e.lowest_efficiency, e.highest_efficiency));
        row.push_back(fmt::format("{:.3g}", 1e-6 * e.rays_per_second));
        table.add_row(row);
    }
    return text + table.text()
           + fmt::format("\nshadow rays in packets: {:.3g} million/s, the bare ray tracer on "
                         "the same rays {:.3g} million/s ({:.0f} %)\n",
                         1e-6 * room.shadow_rays_per_second,
                         1e-6 * room.bare_rays_per_second,
                         100.0 * room.shadow_rays_per_second / room.bare_rays_per_second);
}

std::string scaling_text(const std::string& title, const std::vector<ScalingRow>& rows) {
    TextTable table({{"points", Align::right},
                     {"luminaires", Align::right},
                     {"CPU/s", Align::right},
                     {"stated RMS/%", Align::right},
                     {"CPU s to 1 %", Align::right},
                     {"us a point", Align::right}});
    for (const ScalingRow& r : rows)
        table.add_row(
            {fmt::format("{}", r.points),
             fmt::format("{}", r.luminaires),
             fmt::format("{:.3g}", r.cpu_seconds),
             fmt::format("{:.2g}", 100.0 * r.stated_error),
             fmt::format("{:.3g}", r.seconds_to_1_percent),
             fmt::format("{:.3g}",
                         1e6 * r.seconds_to_1_percent
                             / static_cast<double>(std::max<std::size_t>(1, r.points)))});
    return title + "\n\n" + table.text();
}

std::string to_json(const BenchReport& report) {
    Json document{{"isolux_bench", 1},
                  {"version", ISOLUX_VERSION},
                  {"threads", report.threads},
                  {"seed", report.settings.seed},
                  {"seeds", report.settings.seeds},
                  {"seconds_per_estimator", report.settings.seconds}};
    document["rooms"] = Json::array();
    for (const RoomBench& r : report.rooms) {
        Json room{{"name", r.name},
                  {"points", r.points},
                  {"luminaires", r.luminaires},
                  {"triangles", r.triangles},
                  {"reference_cpu_seconds", r.reference_seconds},
                  {"reference_stated_rms_error", r.reference_error},
                  {"shadow_rays_per_second", r.shadow_rays_per_second},
                  {"bare_rays_per_second", r.bare_rays_per_second}};
        room["estimators"] = Json::array();
        for (const EstimatorBench& e : r.estimators)
            room["estimators"].push_back(to_json(e));
        document["rooms"].push_back(std::move(room));
    }
    document["by_points"] = to_json(report.by_points);
    document["by_luminaires"] = to_json(report.by_luminaires);
    document["by_luminaires_and_size"] = to_json(report.by_luminaires_and_size);
    return document.dump(2) + "\n";
}

} // namespace isolux
