#include "isolux/cli/parse_values.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/base/error.h"
#include "isolux/cli/suggest.h"

namespace isolux {

namespace {

// The same bounds as in the project file's schema.
constexpr double least_tolerance = 1e-4;
constexpr double largest_tolerance = 0.5;

std::string_view trim(std::string_view text) noexcept {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

[[noreturn]] void reject(std::string_view option, const std::string& what, const char* hint) {
    throw InputError(std::string(option), what, hint);
}

/// Seconds in a unit of time.
std::optional<double> find_seconds(std::string_view unit) noexcept {
    constexpr std::array<std::pair<std::string_view, double>, 8> units{{{"", 1.0},
                                                                        {"s", 1.0},
                                                                        {"sec", 1.0},
                                                                        {"ms", 0.001},
                                                                        {"m", 60.0},
                                                                        {"min", 60.0},
                                                                        {"h", 3600.0},
                                                                        {"hours", 3600.0}}};
    for (const auto& [name, seconds] : units) {
        if (unit == name)
            return seconds;
    }
    return std::nullopt;
}

} // namespace

double parse_finite_number(std::string_view text) noexcept {
    text = trim(text);
    if (text.starts_with('+') && text.size() > 1 && text[1] != '-')
        text.remove_prefix(1);
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end || !std::isfinite(value))
        return std::numeric_limits<double>::quiet_NaN();
    return value;
}

double parse_tolerance(std::string_view option, std::string_view text) {
    std::string_view number = trim(text);
    const bool in_percent = number.ends_with('%');
    if (in_percent)
        number.remove_suffix(1);
    const double value = parse_finite_number(number) * (in_percent ? 0.01 : 1.0);
    if (std::isnan(value))
        reject(option,
               fmt::format("'{}' is not a tolerance", text),
               "Write a share of the value such as 1% or 0.01");
    if (value < least_tolerance || value > largest_tolerance)
        reject(
            option,
            fmt::format("{} means {:.6g} % (a tolerance is 0.01 % to 50 %)", text, 100 * value),
            !in_percent && value >= 1.0 ? "Did you forget the percent sign?" : "");
    return value;
}

std::chrono::duration<double> parse_duration(std::string_view option, std::string_view text) {
    const std::string_view all = trim(text);
    const std::size_t unit = std::min(all.find_first_not_of("0123456789.+-eE"), all.size());
    const auto seconds = find_seconds(trim(all.substr(unit)));
    const double value = parse_finite_number(all.substr(0, unit)) * seconds.value_or(1.0);
    if (!seconds || std::isnan(value))
        reject(option,
               fmt::format("'{}' is not a time", text),
               "Write a number and s, min or h, such as 60s, 1.5min or 2h");
    if (value <= 0.0)
        reject(option,
               fmt::format("{} is not above zero (nothing could be calculated)", text),
               "Write a number and s, min or h, such as 60s, 1.5min or 2h");
    return std::chrono::duration<double>(value);
}

std::uint64_t parse_count(std::string_view option,
                          std::string_view text,
                          std::uint64_t minimum,
                          std::uint64_t maximum) {
    const std::string_view digits = trim(text);
    std::uint64_t value = 0;
    const char* const end = digits.data() + digits.size();
    const auto [rest, error] = std::from_chars(digits.data(), end, value);
    if (error == std::errc::result_out_of_range
        || (error == std::errc() && rest == end && (value < minimum || value > maximum)))
        reject(
            option, fmt::format("{} is out of range ({} to {})", text, minimum, maximum), "");
    if (error != std::errc() || rest != end)
        reject(option, fmt::format("'{}' is not a whole number", text), "");
    return value;
}

Estimator parse_estimator(std::string_view option, std::string_view text) {
    std::vector<std::string> names;
    for (const EstimatorName& name : estimator_names) {
        if (text == name.on_command_line || text == name.in_project)
            return name.estimator;
        names.emplace_back(name.on_command_line);
    }
    const auto similar = find_similar(text, names);
    throw InputError(std::string(option),
                     fmt::format("'{}' is not an estimator", text),
                     similar ? fmt::format("Did you mean {}?", *similar)
                             : fmt::format("Known are {}", fmt::join(names, ", ")));
}

} // namespace isolux
