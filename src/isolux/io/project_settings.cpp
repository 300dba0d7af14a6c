#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "isolux/io/project_reader.h"

namespace isolux {

namespace {

struct NumberWithUnit {
    double value = 0.0;
    std::string unit; ///< what follows the number, blanks removed
};

std::optional<NumberWithUnit> split(const std::string& text) {
    NumberWithUnit split;
    const char* end = text.data() + text.size();
    const auto [rest, failed] = std::from_chars(text.data(), end, split.value);
    if (failed != std::errc() || text.front() == '-')
        return std::nullopt;
    for (const char* c = rest; c != end; ++c)
        if (*c != ' ')
            split.unit += *c;
    return split;
}

/// A number in [lower, upper]. 2 where 2 % may be meant is told how to say that.
std::optional<double> read_plain_share(const JsonNode& node, double lower, double upper) {
    const double value = node.value().number;
    const double share = value / 100.0;
    if (!node.is(JsonValue::Kind::number) || value <= upper || value < 1.0 || share < lower
        || share > upper)
        return read_number(node, {lower, upper});
    node.error(fmt::format("{} is too large (it must be at most {})", value, upper),
               fmt::format("Write \"{}%\" or {:.4g}?", value, share));
    return std::nullopt;
}

/// A number in [lower, upper], or a percentage as text.
std::optional<double> read_percentage(const JsonNode& node, double lower, double upper) {
    if (!node.is(JsonValue::Kind::text))
        return read_plain_share(node, lower, upper);
    const std::optional<NumberWithUnit> given = split(node.value().text);
    if (!given || given->unit != "%") {
        node.error(
            fmt::format("\"{}\" is not a percentage (a number or text such as \"{}%\" is "
                        "expected)",
                        node.value().text,
                        lower < 0.5 ? 1 : 95));
        return std::nullopt;
    }
    const double share = given->value / 100.0;
    if (share >= lower && share <= upper)
        return share;
    node.error(fmt::format("{} % is too {} (it must be at {} {} %)",
                           given->value,
                           share < lower ? "small" : "large",
                           share < lower ? "least" : "most",
                           100.0 * (share < lower ? lower : upper)));
    return std::nullopt;
}

std::optional<double> read_seconds(const JsonNode& node) {
    constexpr NumberRange any_time{0.0, 31'557'600.0, true, " s"}; // up to a year
    if (!node.is(JsonValue::Kind::text))
        return read_number(node, any_time);
    const std::optional<NumberWithUnit> given = split(node.value().text);
    const std::string unit = given ? given->unit : std::string();
    const double seconds = unit == "s"     ? 1.0
                           : unit == "min" ? 60.0
                           : unit == "h"   ? 3600.0
                                           : 0.0;
    if (seconds == 0.0) {
        node.error(fmt::format("\"{}\" is not a time (a number of seconds or text such as "
                               "\"90s\", \"5min\", \"1h\" is expected)",
                               node.value().text));
        return std::nullopt;
    }
    const double value = given->value * seconds;
    if (value > any_time.lower && value <= any_time.upper)
        return value;
    node.error(
        fmt::format("a time limit of {} s makes no sense (above 0, at most a year)", value));
    return std::nullopt;
}

} // namespace

void read_settings(const JsonNode& node, Settings& settings) {
    const JsonObject object(node,
                            "settings",
                            {"tolerance",
                             "absolute_tolerance",
                             "confidence",
                             "time_limit",
                             "seed",
                             "statement",
                             "stopping",
                             "estimator",
                             "photometer_head_radius",
                             "direct_only",
                             "contributions",
                             "sensitivities"});
    if (const std::optional<JsonNode> given = object.find("tolerance"))
        settings.tolerance = read_percentage(*given, 1e-4, 0.5).value_or(settings.tolerance);
    settings.absolute_tolerance = object.number(
        "absolute_tolerance", {0.0, 1e6, true, " lx"}, settings.absolute_tolerance);
    if (const std::optional<JsonNode> given = object.find("confidence"))
        settings.confidence =
            read_percentage(*given, 0.5, 0.9999).value_or(settings.confidence);
    if (const std::optional<JsonNode> given = object.find("time_limit"))
        if (const std::optional<double> seconds = read_seconds(*given))
            settings.time_limit = std::chrono::duration<double>(*seconds);
    if (const std::optional<JsonNode> given = object.find("seed")) {
        constexpr std::int64_t largest = 9'007'199'254'740'991; // exact in a JSON number
        if (const std::optional<std::int64_t> seed = read_integer(*given, 0, largest))
            settings.seed = static_cast<std::uint64_t>(*seed);
    }
    if (const std::optional<JsonNode> given = object.find("statement")) {
        constexpr std::array<std::string_view, 2> words{"per point", "all points"};
        settings.statement = static_cast<Statement>(read_choice(*given, words).value_or(0));
    }
    if (const std::optional<JsonNode> given = object.find("stopping")) {
        constexpr std::array<std::string_view, 2> words{"doubling", "two stages"};
        settings.stopping = static_cast<Stopping>(read_choice(*given, words).value_or(0));
    }
    if (const std::optional<JsonNode> given = object.find("estimator")) {
        std::array<std::string_view, estimator_names.size()> words;
        std::ranges::transform(
            estimator_names, words.begin(), [](const auto& name) { return name.in_project; });
        settings.estimator = estimator_names[read_choice(*given, words).value_or(0)].estimator;
    }
    settings.photometer_head_radius = object.number(
        "photometer_head_radius", {1e-4, 1.0, false, " m"}, settings.photometer_head_radius);
    settings.direct_only = object.boolean("direct_only", settings.direct_only);
    if (const std::optional<JsonNode> given = object.find("contributions")) {
        constexpr std::array<std::string_view, 4> words{
            "automatic", "none", "groups", "luminaires"};
        settings.contributions =
            static_cast<SourceSplit>(read_choice(*given, words).value_or(0));
    }
    settings.sensitivities = object.boolean("sensitivities", settings.sensitivities);
}

} // namespace isolux
