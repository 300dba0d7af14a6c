#pragma once

#include <string>
#include <vector>

namespace isolux {

enum class Align { left, right };

/// Columns of text, each as wide as its widest cell, two blanks between. Widths count
/// characters of UTF-8 text, not bytes.
class TextTable {
public:
    struct Column {
        std::string head;
        Align align = Align::left;
    };

    explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// @pre as many cells as columns
    void add_row(std::vector<std::string> cells);

    /// Head, a rule, and the rows; every line ends with a line feed and without blanks.
    [[nodiscard]] std::string text() const;

private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

} // namespace isolux
