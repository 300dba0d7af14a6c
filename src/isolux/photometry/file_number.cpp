#include "isolux/photometry/file_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace isolux {

namespace {

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }

} // namespace

std::optional<double> parse_number(std::string_view text) {
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-'))
            return std::nullopt;
    }
    // from_chars would also take "inf" and "nan"
    const std::size_t first = text.starts_with('-') ? 1 : 0;
    const bool starts_like_a_number =
        first < text.size()
        && (is_digit(text[first])
            || (text[first] == '.' && first + 1 < text.size() && is_digit(text[first + 1])));
    if (!starts_like_a_number)
        return std::nullopt;

    std::string with_e; // Fortran programs write 1.5D+03
    const std::size_t d = text.find_first_of("dD");
    if (d != std::string_view::npos) {
        with_e = text;
        with_e[d] = 'e';
        text = with_e;
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size())
        return std::nullopt;
    if (error == std::errc::result_out_of_range) {
        const std::size_t e = text.find_first_of("eE");
        const bool is_tiny = e != std::string_view::npos && text.substr(e + 1).starts_with('-');
        return is_tiny ? std::optional(0.0) : std::nullopt;
    }
    return error == std::errc{} && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string to_text(double value) {
    std::array<char, 32> buffer{};
    constexpr double longest_plain = 1e15; // 1000000000, not 1e+09
    const bool is_plain = value == std::floor(value) && std::abs(value) < longest_plain;
    char* const end = buffer.data() + buffer.size();
    const auto result = is_plain
                            ? std::to_chars(buffer.data(), end, value, std::chars_format::fixed)
                            : std::to_chars(buffer.data(), end, value);
    return {buffer.data(), result.ptr};
}

std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::size_t size = std::min(text.size(), longest);
    while (size > 0 && size < text.size()
           && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80)
        --size; // not within a UTF-8 sequence
    std::string result = "'";
    for (const char c : text.substr(0, size))
        result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
    return result + (size < text.size() ? "...'" : "'");
}

bool is_whole(double value) noexcept {
    return std::abs(value) <= 2147483647.0 && value == std::floor(value);
}

} // namespace isolux
