#include "isolux/io/project_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isolux {

namespace {

GridWish read_spacing(const JsonNode& node) {
    GridWish wish;
    if (node.is(JsonValue::Kind::array)) {
        const auto both =
            read_numbers(node, 2, 2, "[along the columns, along the rows]", any_length);
        if (both)
            wish.spacing = Point2{(*both)[0], (*both)[1]};
    } else if (const std::optional<double> one = read_number(node, any_length)) {
        wish.spacing = Point2{*one, *one};
    }
    return wish;
}

} // namespace

GridWish read_grid(const JsonNode& node) {
    if (node.is(JsonValue::Kind::text)) {
        constexpr std::array<std::string_view, 1> words{"standard"};
        static_cast<void>(read_choice(node, words));
        return {};
    }
    const JsonObject object(node, "a grid", {"rounding", "spacing", "columns", "rows"});
    const std::optional<std::string> form =
        object.require_one_of({"rounding", "spacing", "columns"});
    if (!form)
        return {};
    const JsonNode given = *object.find(*form);
    if (*form != "columns")
        object.exclude(*form, {"rows"});
    if (*form == "spacing")
        return read_spacing(given);
    GridWish wish;
    if (*form == "rounding") {
        constexpr std::array<std::string_view, 3> words{"up", "nearest", "odd"};
        wish.rounding = static_cast<GridRounding>(read_choice(given, words).value_or(0));
        return wish;
    }
    const std::optional<std::int64_t> columns = read_integer(given, 1, 10'000);
    const std::optional<JsonNode> rows_node = object.require("rows");
    const std::optional<std::int64_t> rows =
        rows_node ? read_integer(*rows_node, 1, 10'000) : std::nullopt;
    if (columns && rows)
        wish.counts =
            GridCounts{static_cast<std::size_t>(*columns), static_cast<std::size_t>(*rows)};
    return wish;
}

/// Columns and rows; nothing if there would be too many.
std::optional<GridCounts> choose_counts(const GridWish& wish, double width, double height) {
    if (wish.counts)
        return static_cast<double>(wish.counts->columns)
                           * static_cast<double>(wish.counts->rows)
                       <= most_grid_points
                   ? wish.counts
                   : std::nullopt;
    if (!wish.spacing) {
        const GridCounts counts =
            make_standard_grid(Metre(width), Metre(height), wish.rounding);
        return static_cast<double>(counts.columns) * static_cast<double>(counts.rows)
                       <= most_grid_points
                   ? std::optional(counts)
                   : std::nullopt;
    }
    constexpr double rounding = 1e-9;
    const double columns = std::max(1.0, std::ceil(width / wish.spacing->x * (1.0 - rounding)));
    const double rows = std::max(1.0, std::ceil(height / wish.spacing->y * (1.0 - rounding)));
    if (columns * rows > most_grid_points)
        return std::nullopt;
    return GridCounts{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows)};
}

} // namespace isolux
