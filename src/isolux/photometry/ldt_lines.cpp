#include "isolux/photometry/ldt_lines.h"

#include <algorithm>
#include <utility>

#include "isolux/photometry/findings.h"

namespace isolux {

LdtLines::LdtLines(const SourceText& text, Findings& findings)
    : text_(text), findings_(findings), last_(text.line_count() == 0 ? 0 : text.last_line()) {}

std::string_view LdtLines::take_line(std::string_view what) {
    if (next_ > last_)
        findings_.fail(std::max<std::size_t>(last_, 1),
                       "the file ends before the " + std::string(what)
                           + " (EULUMDAT has one value a line, in a fixed order)",
                       "Truncated file?");
    return trim(text_.line(next_++));
}

std::string LdtLines::take_text(std::string_view what) { return std::string(take_line(what)); }

double LdtLines::to_number(std::string_view text, std::string_view what) {
    const std::size_t line = next_ - 1;
    if (const auto value = parse_number(text))
        return *value;
    if (std::ranges::count(text, ',') == 1 && text.find('.') == std::string_view::npos) {
        std::string with_point(text);
        std::ranges::replace(with_point, ',', '.');
        if (const auto value = parse_number(with_point)) {
            if (!std::exchange(has_told_of_commas_, true))
                findings_.warn(line, "decimal comma (EULUMDAT has decimal points; accepted)");
            return *value;
        }
    }
    const bool has_both = text.find(',') != std::string_view::npos;
    findings_.fail(line,
                   quoted(text) + " is not a number (expected: the " + std::string(what) + ")",
                   has_both ? "Write numbers without a thousands separator"
                            : "Is a line missing above, or one too many?");
}

FileNumber LdtLines::take_number(std::string_view what) {
    const std::string_view text = take_line(what);
    if (text.empty()) {
        findings_.warn(next_ - 1, "blank line for the " + std::string(what) + " (read as 0)");
        return {0.0, next_ - 1};
    }
    return {to_number(text, what), next_ - 1};
}

FileNumber LdtLines::take_informative(std::string_view what) {
    const std::string_view text = next_ <= last_ ? peek() : std::string_view{};
    const bool has_digit_first =
        text.find_first_of("0123456789") < 2; // perhaps after a sign or a point
    if (text.empty()
        || (has_digit_first
            && text.find_first_not_of("0123456789.,+-eE") == std::string_view::npos))
        return take_number(what);
    findings_.warn(next_,
                   quoted(text) + " for the " + std::string(what)
                       + " (not a number; nothing depends on it, read as 0)");
    return {0.0, next_++};
}

FileNumber LdtLines::take_count(std::string_view what, int least, int most) {
    const std::string_view text = take_line(what);
    const std::string range = " (must be a whole number from " + std::to_string(least) + " to "
                              + std::to_string(most) + ")";
    if (text.empty())
        findings_.fail(next_ - 1, "blank line for the " + std::string(what) + range);
    const double value = to_number(text, what);
    if (!is_whole(value) || value < least || value > most)
        findings_.fail(next_ - 1, to_text(value) + " as the " + std::string(what) + range);
    return {value, next_ - 1};
}

std::vector<FileNumber> LdtLines::take_numbers(std::size_t count, std::string_view what) {
    std::vector<FileNumber> numbers;
    numbers.reserve(std::min(count, remaining()));
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(take_number(what));
    return numbers;
}

} // namespace isolux
