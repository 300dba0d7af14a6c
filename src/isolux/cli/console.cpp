#include "isolux/cli/console.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

namespace isolux {

namespace {

[[noreturn]] void throw_output_error(int code) {
    if (code == EPIPE)
        throw OutputClosed();
    throw std::system_error(code, std::generic_category(), "standard output");
}

void report(const char* label, const Message& message) noexcept {
    try {
        report_line(label + to_string(message));
    } catch (...) { // out of memory while reporting: say the little that needs none
        std::fputs(label, stderr);
        std::fputs("out of memory\n", stderr);
    }
}

} // namespace

void print(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
        throw_output_error(errno);
}

void flush_output() {
    if (std::fflush(stdout) != 0)
        throw_output_error(errno);
}

void report_error(const Message& message) noexcept { report("error: ", message); }

void report_notice(const Message& message) noexcept { report("notice: ", message); }

void report_line(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fputc('\n', stderr);
}

} // namespace isolux
