#pragma once

#include <stdexcept>
#include <string_view>

#include "isolux/base/error.h"

/// The only place that writes to the standard streams.
namespace isolux {

/// Whoever read our standard output has closed it; nothing is left to say.
class OutputClosed : public std::runtime_error {
public:
    OutputClosed() : std::runtime_error("standard output was closed by its reader") {}
};

/// Writes to standard output. @throws OutputClosed, or std::system_error when the disk is full
void print(std::string_view text);

/// Makes sure that everything printed has left the program. Throws as print() does.
void flush_output();

/// One line on standard error: `error: ` or `notice: ` and the message.
void report_error(const Message& message) noexcept;
void report_notice(const Message& message) noexcept;

/// A line of plain talk on standard error.
void report_line(std::string_view text) noexcept;

} // namespace isolux
