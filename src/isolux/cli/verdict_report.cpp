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

/// What rounding left of a zero.
double without_dust(double cosine) { return std::abs(cosine) < 1e-12 ? 0.0 : cosine; }

std::string unit_of(const Requirement& r) { return r.unit == "1" ? "" : " " + r.unit; }

std::string format_limit(const Requirement& r) {
    return fmt::format(
        "{} {:g}{}", r.sense == Sense::at_least ? ">=" : "<=", r.limit, unit_of(r));
}

/// How far the value is from the limit, positive on the right side.
std::string format_margin(const Verdict& v) {
    return fmt::format("{:+.3g}{}", v.margin, unit_of(v.requirement));
}

/// What a reader wants to know first comes first.
int rank_of(Decision d) {
    switch (d) {
    case Decision::fail:
        return 0;
    case Decision::undecided:
        return 1;
    case Decision::pass:
        return 2;
    case Decision::not_judged:
        break;
    }
    return 3;
}

/// "verdict: fail (limits: 1 fail, 2 undecided, 23 pass, 4 not judged)"
std::string to_headline(const std::vector<Verdict>& verdicts) {
    const auto count = [&](Decision d) {
        return std::ranges::count_if(verdicts,
                                     [d](const Verdict& v) { return v.decision == d; });
    };
    std::string counts;
    for (const Decision d :
         {Decision::fail, Decision::undecided, Decision::pass, Decision::not_judged})
        if (const auto n = count(d); n > 0)
            counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", n, to_word(d));
    return fmt::format("verdict: {} (limits: {})\n\n", to_word(overall(verdicts)), counts);
}

/// The rows behind the short names in the table.
std::string to_row_list(const std::vector<Verdict>& verdicts) {
    std::string text;
    std::vector<std::string> known;
    for (const Verdict& v : verdicts) {
        const Requirement& r = v.requirement;
        std::string line = fmt::format("row {}: {}", r.row, r.standard);
        if (!r.task.empty())
            line += ", " + r.task;
        if (std::ranges::find(known, line) != known.end())
            continue;
        text += line + "\n";
        known.push_back(std::move(line));
    }
    return text;
}

} // namespace

std::string to_verdict_table(const Results& results) {
    if (results.verdicts.empty())
        return {};
    std::vector<Verdict> verdicts = results.verdicts;
    std::ranges::stable_sort(
        verdicts, {}, [](const Verdict& v) { return rank_of(v.decision); });
    TextTable table({{"verdict", Align::left},
                     {"what", Align::left},
                     {"where", Align::left},
                     {"value [interval]", Align::right},
                     {"limit", Align::right},
                     {"margin", Align::right},
                     {"row", Align::left},
                     {"note", Align::left}});
    std::size_t recalled = 0;
    for (const Verdict& v : verdicts) {
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
                       r.row,
                       remark});
    }
    std::string text =
        to_headline(results.verdicts) + table.text() + to_row_list(results.verdicts)
        + "intervals of verdicts allow for every look at the errors on the way, so "
          "they are wider than those above; margin: from the value to the limit\n";
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
                                   without_dust(line.direction.x()),
                                   without_dust(line.direction.y()),
                                   without_dust(line.direction.z()));
            cells[6] = o.by_table ? fmt::format("{:.1f} by {}", *o.by_table, o.table_note)
                       : o.table_note.empty() ? ""
                                              : "no value by " + o.table_note;
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
