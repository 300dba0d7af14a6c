#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/parse_values.h"
#include "isolux/cli/photometry_verbs.h"
#include "isolux/photometry/ugr_table.h"

namespace isolux {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    std::string file;
    std::string spacing;
    LuminaireFileOptions reading;
    bool as_json = false;
};

/// Spacing over height of the tables asked for: both usual ones, or the one given.
std::vector<double> spacings(const Options& o) {
    if (o.spacing.empty())
        return {0.25, 1.0};
    const double s = parse_finite_number(o.spacing);
    if (s == 0.25 || s == 1.0)
        return {s};
    throw InputError(
        "--spacing",
        fmt::format("'{}' is not 0.25 or 1 (the two that CIE tables have)", o.spacing));
}

/// NaN and infinities, of luminaires without light, are no numbers of JSON.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json values_to_json(const UgrValues& values) {
    Json rows = Json::array();
    for (std::size_t r = 0; r < ugr_rooms.size(); ++r) {
        Json row = Json::array();
        for (const double value : values[r])
            row.push_back(number(value));
        rows.push_back({{"x", ugr_rooms[r].across}, {"y", ugr_rooms[r].along}, {"ugr", row}});
    }
    return rows;
}

Json table_to_json(const UgrTable& table) {
    return {{"spacing_to_height", table.spacing_to_height},
            {"crosswise", values_to_json(table.crosswise)},
            {"endwise", values_to_json(table.endwise)}};
}

std::string cell(double value) {
    return std::isfinite(value) ? fmt::format("{:6.1f}", value) : "     -";
}

std::string table_to_text(const UgrTable& table, Lumen flux) {
    std::string text =
        fmt::format("UGR corrected for the luminaire's own {:.0f} lm, spacing {} x height\n",
                    flux.value(),
                    table.spacing_to_height);
    const auto percent_row = [&text](const char* name, double UgrReflectances::*rho) {
        text += fmt::format("{:<9}", name);
        for (int view = 0; view < 2; ++view) {
            text += "  ";
            for (const UgrReflectances& r : ugr_reflectances)
                text += fmt::format("{:6.0f}", 100.0 * (r.*rho));
        }
        text += "\n";
    };
    percent_row("ceiling %", &UgrReflectances::ceiling);
    percent_row("walls %", &UgrReflectances::walls);
    percent_row("plane %", &UgrReflectances::plane);
    text += fmt::format("{:<9}  {:>30}  {:>30}\n", "room", "seen crosswise", "seen endwise");
    for (std::size_t r = 0; r < ugr_rooms.size(); ++r) {
        text += fmt::format("{:>2}H {:>2}H  ", ugr_rooms[r].across, ugr_rooms[r].along);
        for (const UgrValues* values : {&table.crosswise, &table.endwise}) {
            text += values == &table.crosswise ? " " : "  ";
            for (const double value : (*values)[r])
                text += cell(value);
        }
        text += "\n";
    }
    return text;
}

ExitCode print_tables(const Options& o) {
    const auto parsed = read_luminaire_file(o.file, o.reading);
    for (const Message& notice : parsed.notices)
        report_notice(notice);
    std::string text;
    Json tables = Json::array();
    for (const double spacing : spacings(o)) {
        const auto table = make_ugr_table(parsed.value, spacing);
        if (!table)
            throw InputError(o.file,
                             "no UGR table (the opening shows no luminous area towards the "
                             "observer, so that no luminance follows)",
                             "A point, or a flat opening that faces sideways?");
        text += (text.empty() ? "" : "\n")
                + table_to_text(*table, parsed.value.distribution.flux());
        tables.push_back(table_to_json(*table));
    }
    print(o.as_json ? Json{{"file", o.file},
                           {"luminaire_flux_lm", parsed.value.distribution.flux().value()},
                           {"tables", tables}}
                              .dump(2)
                          + "\n"
                    : text);
    return ExitCode::success;
}

} // namespace

Action add_photometry_ugr_table(CLI::App& verb) {
    verb.description("Unified glare rating in 19 standard rooms, after CIE 117 and CIE 190");
    verb.footer(R"(
Rooms are X by Y in multiples of H, the height of the luminaires above the eye; X lies across the
line of sight. Crosswise: the long side is seen. Values are those of the file's own flux.

Examples:
  isolux photometry ugr-table desk.ldt
  isolux photometry ugr-table --spacing 0.25 --json desk.ldt)");
    const auto o = std::make_shared<Options>();
    verb.add_option("FILE", o->file, "A luminaire file")->required()->type_name("");
    verb.add_option(
        "--spacing", o->spacing, "Spacing over height: 0.25 or 1; both if not given");
    verb.add_flag("--json", o->as_json, "Print JSON with all digits");
    add_luminaire_file_options(verb, o->reading);
    return [o] { return print_tables(*o); };
}

} // namespace isolux
