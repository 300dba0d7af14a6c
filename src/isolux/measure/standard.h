#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isolux/measure/requirement.h"

/// A lighting standard as a table: columns say what is limited, rows hold the limits.
namespace isolux {

/// Where a number comes from. The key "recalled" marks what nobody has compared with print.
struct StandardSource {
    std::string key;
    std::string text;
};

struct StandardColumn {
    Requirement form; ///< without row, limit and source
    std::string
        raises;       ///< symbol whose limit this one replaces where modified values are wanted
    std::string with; ///< applies to every row that has this symbol ...
    std::optional<double> limit; ///< ... with this limit
    std::string source;          ///< key; of `limit`
};

struct StandardRow {
    std::string id;
    std::string clause;
    std::string place; ///< the group of rows it belongs to
    std::string task;
    std::vector<std::pair<std::string, double>> limits;       ///< by symbol
    std::string source;                                       ///< key
    std::vector<std::pair<std::string, std::string>> sources; ///< keys by symbol
    std::string note;
    std::vector<std::string> also; ///< everyday words for it, for the search
};

struct Standard {
    std::string name;
    std::string title;
    std::vector<std::string> notes;
    std::vector<StandardSource> sources;
    std::vector<StandardColumn> columns;
    std::vector<StandardRow> rows;
};

[[nodiscard]] const StandardRow* find_row(const Standard& standard,
                                          std::string_view id) noexcept;
[[nodiscard]] std::optional<double> find_limit(const StandardRow& row,
                                               std::string_view symbol) noexcept;

enum class RowLevel {
    required,
    modified ///< the raised values, where the row has some
};

/// Everything a row asks for, in the order of the columns.
[[nodiscard]] std::vector<Requirement>
requirements_of(const Standard& standard, const StandardRow& row, RowLevel level);

} // namespace isolux
