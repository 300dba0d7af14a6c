#include "isolux/photometry/ies_tokens.h"

#include <algorithm>
#include <utility>

#include "isolux/photometry/plane_symmetry.h"

namespace isolux {

IesTokens::IesTokens(const SourceText& text, std::size_t first_line, const Findings& findings)
    : findings_(findings), last_line_(text.last_line()) {
    for (std::size_t n = first_line; n <= text.line_count(); ++n)
        tokenise(text.line(n), n);
}

void IesTokens::tokenise(std::string_view text, std::size_t line) {
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    constexpr std::string_view separators = " \t\r\v\f,";
    std::size_t end = 0;
    while (true) {
        const std::size_t begin = text.find_first_not_of(separators, end);
        if (begin == std::string_view::npos)
            return;
        if (begin >= 2 && text[begin - 1] == ',' && is_digit(text[begin - 2])
            && is_digit(text[begin]))
            has_tight_comma_ = true;
        end = std::min(text.find_first_of(separators, begin), text.size());
        tokens_.push_back({text.substr(begin, end - begin), line});
    }
}

std::size_t IesTokens::line() const noexcept {
    return next_ < tokens_.size() ? tokens_[next_].line : last_line_;
}

FileNumber IesTokens::take_number(std::string_view what) {
    if (remaining() == 0)
        findings_.fail(last_line_,
                       "the file ends before the " + std::string(what)
                           + " (the record is incomplete)",
                       "Truncated file?");
    const Token token = tokens_[next_];
    const auto value = parse_number(token.text);
    if (!value)
        findings_.fail(token.line,
                       quoted(token.text) + " is not a number (expected: the "
                           + std::string(what) + ")");
    ++next_;
    return {*value, token.line};
}

FileNumber IesTokens::take_count(std::string_view what, int least) {
    const FileNumber n = take_number(what);
    if (!is_whole(n.value) || n.value < least)
        findings_.fail(n.line,
                       to_text(n.value) + " as the " + std::string(what)
                           + " (must be a whole number, at least " + std::to_string(least)
                           + ")",
                       comma_hint({}));
    return n;
}

std::vector<FileNumber> IesTokens::take_numbers(std::size_t count, std::string_view what) {
    std::vector<FileNumber> numbers;
    numbers.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(take_number(what));
    return numbers;
}

void IesTokens::expect_ascending(const std::vector<FileNumber>& values,
                                 std::string_view what) const {
    for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i].value - values[i - 1].value > same_file_angle))
            findings_.fail(values[i].line,
                           std::string(what) + " " + to_text(values[i].value) + " after "
                               + to_text(values[i - 1].value) + " (they must ascend)",
                           comma_hint({}));
}

std::string IesTokens::comma_hint(std::string otherwise) const {
    return has_tight_comma_ ? "Decimal commas? In LM-63 a comma separates numbers, the decimal "
                              "sign is a point"
                            : std::move(otherwise);
}

} // namespace isolux
