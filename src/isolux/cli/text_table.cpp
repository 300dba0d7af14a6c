#include "isolux/cli/text_table.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "isolux/base/check.h"

namespace isolux {

namespace {

std::size_t width_of(std::string_view text) noexcept {
    // Continuation bytes of UTF-8 (10xxxxxx) take no column of their own.
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
    }));
}

} // namespace

void TextTable::add_row(std::vector<std::string> cells) {
    ISOLUX_EXPECT(cells.size() == columns_.size());
    rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        std::size_t width = width_of(columns_[c].head);
        for (const auto& row : rows_)
            width = std::max(width, width_of(row[c]));
        widths.push_back(width);
    }
    std::string all;
    const auto append_line = [&](const auto& cell_of) {
        std::string line;
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const std::string cell = cell_of(c);
            const std::string padding(widths[c] - width_of(cell), ' ');
            line += c == 0 ? "" : "  ";
            line += columns_[c].align == Align::left ? cell + padding : padding + cell;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        all += line + '\n';
    };
    append_line([&](std::size_t c) { return columns_[c].head; });
    append_line([&](std::size_t c) { return std::string(widths[c], '-'); });
    for (const auto& row : rows_)
        append_line([&](std::size_t c) { return row[c]; });
    return all;
}

} // namespace isolux
