#include "isolux/scene/mesh_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace isolux {
namespace {

constexpr std::string_view blanks = " \t\v\f";

/// `from_chars` knows no plus sign.
std::string_view without_plus(std::string_view word) noexcept {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

} // namespace

bool read_number(std::string_view word, double& value) noexcept {
    word = without_plus(word);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

bool read_integer(std::string_view word, std::int64_t& value) noexcept {
    word = without_plus(word);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

bool TextCursor::next_line() {
    while (!rest_.empty()) {
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        line_ = rest_.substr(0, end);
        const bool is_pair = rest_.substr(end, 2) == "\r\n";
        rest_.remove_prefix(std::min(rest_.size(), end + (is_pair ? 2 : 1)));
        ++line_number_;
        words_.clear();
        std::string_view left = line_.substr(0, line_.find('#'));
        while (true) {
            left.remove_prefix(std::min(left.find_first_not_of(blanks), left.size()));
            if (left.empty())
                break;
            const std::size_t length = std::min(left.find_first_of(blanks), left.size());
            words_.push_back(left.substr(0, length));
            left.remove_prefix(length);
        }
        if (!words_.empty())
            return true;
    }
    return false;
}

std::string_view TextCursor::word(std::size_t i) const {
    if (i >= words_.size())
        fail("the line is too short (a number is missing)", "Truncated file?");
    return words_[i];
}

double TextCursor::number(std::size_t i) const {
    double value = 0.0;
    if (!read_number(word(i), value))
        fail(fmt::format("'{:.40}' is not a number (a coordinate was expected)", word(i)));
    return value;
}

std::int64_t TextCursor::integer(std::size_t i) const {
    std::int64_t value = 0;
    if (!read_integer(word(i), value))
        fail(fmt::format("'{:.40}' is not a whole number (a count or index was expected)",
                         word(i)));
    return value;
}

Point3 TextCursor::point(std::size_t first) const {
    return {number(first), number(first + 1), number(first + 2)};
}

void TextCursor::fail(std::string what, std::string hint) const {
    fail_at(line_number_, std::move(what), std::move(hint));
}

void TextCursor::fail_at(std::size_t line_number, std::string what, std::string hint) const {
    throw InputError(
        fmt::format("{}:{}", source_, line_number), std::move(what), std::move(hint));
}

} // namespace isolux
