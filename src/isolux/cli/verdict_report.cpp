#include "isolux/cli/verdict_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "isolux/calc/judge.h"
#include "isolux/cli/run_report.h"
#include "isolux/cli/text_table.h"

namespace isolux {

namespace {

/// As many decimals as two digits of the half width need; four digits without doubt.
std::string format_value(const Verdict& v) {
    const double half = 0.5 * (v.interval.upper - v.interval.lower);
    if (!(half > 1e-9 * std::abs(v.value.mean)))
        return fmt::format("{:.4g}", v.value.mean);
    const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, 9);
    return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]",
                       v.value.mean,
                       decimals,
                       v.interval.lower,
                       decimals,
                       v.interval.upper,
                       decimals);
}

std::string unit_of(const Requirement& r) { return r.unit == "1" ? "" : " " + r.unit; }

std::string format_limit(const Requirement& r) {
    return fmt::format(
        "{} {:g}{}", r.sense == Sense::at_least ? ">=" : "<=", r.limit, unit_of(r));
}

/// How far inside the limit the value surely is; the value's own margin where nothing is sure.
std::string format_margin(const Verdict& v) {
    const double margin = v.decision == Decision::undecided ? v.margin : v.least_margin;
    return fmt::format("{:+.3g}{}", margin, unit_of(v.requirement));
}

} // namespace

std::string to_verdict_table(const Results& results) {
    if (results.verdicts.empty())
        return {};
    TextTable table({{"verdict", Align::left},
                     {"what", Align::left},
                     {"where", Align::left},
                     {"value [interval]", Align::right},
                     {"limit", Align::right},
                     {"margin", Align::right},
                     {"clause", Align::left},
                     {"", Align::left}});
    std::size_t recalled = 0;
    for (const Verdict& v : results.verdicts) {
        const Requirement& r = v.requirement;
        const bool is_judged = v.decision != Decision::not_judged;
        std::string remark = r.is_recommendation ? "recommendation" : "";
        if (!v.reason.empty())
            remark += (remark.empty() ? "" : "; ") + v.reason;
        recalled += r.is_recalled ? 1 : 0;
        table.add_row({std::string(to_word(v.decision)),
                       r.symbol,
                       v.subject,
                       is_judged ? format_value(v) : "",
                       format_limit(r),
                       is_judged ? format_margin(v) : "",
                       fmt::format("{} row {}, {}", r.standard, r.row, r.clause),
                       remark});
    }
    std::string text = table.text();
    text += fmt::format("all requirements: {}; margins count from the unfavourable end of the "
                        "interval\n",
                        to_word(overall(results.verdicts)));
    if (recalled > 0)
        text += fmt::format("{} of {} limits are recalled, not compared with the printed "
                            "standard (`isolux standards` tells which)\n",
                            recalled,
                            results.verdicts.size());
    return text + "\n";
}

std::string to_observer_table(const Results& results) {
    if (results.observers.empty())
        return {};
    TextTable table({{"observers", Align::left},
                     {"lines of sight", Align::right},
                     {"", Align::left},
                     {"worst", Align::right},
                     {"at", Align::left},
                     {"looking", Align::left},
                     {"", Align::left}});
    for (const ObserverGroupResult& o : results.observers) {
        const std::string scale = o.group.scale == GlareScale::unified ? "UGR" : "GR";
        std::vector<std::string> cells{
            o.group.name, fmt::format("{}", o.group.sight_lines.size()), scale, "", "", "", ""};
        if (o.worst) {
            const SightLine& line = o.group.sight_lines[*o.worst];
            cells[3] = format_estimate(o.ratings[*o.worst].value, results.confidence);
            cells[4] = fmt::format("{:.3g} {:.3g} {:.3g}", line.eye.x, line.eye.y, line.eye.z);
            cells[5] = fmt::format("{:.3g} {:.3g} {:.3g}",
                                   line.direction.x(),
                                   line.direction.y(),
                                   line.direction.z());
            cells[6] = o.by_table ? fmt::format("{:.1f} by {}", *o.by_table, o.table_note)
                                  : o.table_note;
        } else if (!o.ratings.empty()) {
            cells[6] = o.ratings.front().reason;
        }
        table.add_row(std::move(cells));
    }
    return table.text() + "\n";
}

std::string to_energy_table(const Results& results) {
    std::string text;
    for (const EnergyResult& e : results.energy) {
        if (!e.watts)
            continue;
        text += fmt::format("energy: {}, {:.4g} W over {:.4g} m2, {:.3g} W/m2",
                            e.room,
                            *e.watts,
                            e.floor_area,
                            e.density);
        if (e.density_per_100_lux.samples > 0)
            text += fmt::format(", {} W/(m2 100 lx) on {}",
                                format_estimate(e.density_per_100_lux, results.confidence),
                                e.surface);
        if (e.leni)
            text += fmt::format(", LENI {:.3g} kWh/(m2 a)", *e.leni);
        text += "\n";
    }
    return text.empty() ? text : text + "\n";
}

} // namespace isolux
