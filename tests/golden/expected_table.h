#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isolux/io/csv.h"

/// expected.csv, as to_summary_csv() writes it, and how it is compared.
namespace isolux::test {

/// Chance that two honest values of one quantity disagree. Some hundred and fifty are compared:
/// two in a thousand changes of a sampler raise a false alarm.
inline constexpr double false_alarm = 1e-5;

/// Largest honest difference in combined standard errors: 6.5 for 16 replicates, where the
/// error itself is known to a fifth only.
inline double error_limit(std::size_t replicates) {
    const double freedom = std::max(1.0, static_cast<double>(replicates) - 1.0);
    return student_quantile(1.0 - false_alarm, freedom);
}

using QuantityName = std::pair<std::string, std::string>; ///< surface, quantity
using Table = std::map<QuantityName, Estimate>;

inline double to_number(const CsvRecord& record, std::size_t field, const std::string& source) {
    const std::string text = field < record.fields.size() ? record.fields[field] : "";
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw InputError(source + ":" + std::to_string(record.line),
                         "'" + text + "' is not a number");
    return value;
}

inline Table read_table(std::string_view csv, const std::string& source) {
    Table table;
    bool is_header = true;
    for (const CsvRecord& r : parse_csv(csv, source)) {
        if (!is_header)
            table[{r.fields.at(0), r.fields.at(1)}] = {
                to_number(r, 3, source),
                to_number(r, 4, source),
                static_cast<std::size_t>(to_number(r, 7, source))};
        is_header = false;
    }
    return table;
}

/// What does not agree, in words; nothing if all does. Deterministic values have 1e-9 for
/// rounding.
inline std::vector<std::string> disagreements(const Table& found, const Table& expected) {
    std::vector<std::string> all;
    for (const auto& [name, e] : expected) {
        const std::string place = name.first + ", " + name.second + ": ";
        const auto match = found.find(name);
        if (match == found.end()) {
            all.push_back(place + "expected, but not calculated");
            continue;
        }
        const Estimate& f = match->second;
        const double error = std::hypot(f.standard_error, e.standard_error);
        const double limit =
            error_limit(std::max(f.samples, e.samples)) * error + 1e-9 * std::abs(e.mean);
        if (std::abs(f.mean - e.mean) <= limit)
            continue;
        std::ostringstream text;
        text << place << f.mean << " +- " << f.standard_error << " found, " << e.mean << " +- "
             << e.standard_error << " expected";
        all.push_back(text.str());
    }
    for (const auto& [name, f] : found)
        if (!expected.contains(name))
            all.push_back(name.first + ", " + name.second + ": not in expected.csv");
    return all;
}

} // namespace isolux::test
