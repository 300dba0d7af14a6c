#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace isolux {

/// A number as a file states it, and the line it stands on (from 1; 0: the file has no such
/// line).
struct FileNumber {
    double value = 0.0;
    std::size_t line = 0;
};

/// Reads a whole text as one finite decimal number: sign, digits, point, exponent E or D.
/// Hexadecimal, inf, nan, trailing characters and values outside a double's range give nothing.
/// Independent of the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// The shortest text that reads back as the same double.
[[nodiscard]] std::string to_text(double value);

/// A stranger's text made fit for a message: shortened, control characters replaced.
[[nodiscard]] std::string quoted(std::string_view text);

/// True for 3, 3.0, -2: a whole number that an int can hold.
[[nodiscard]] bool is_whole(double value) noexcept;

} // namespace isolux
