#include "isolux/cli/terminal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace isolux {

namespace {

std::size_t terminal_width() noexcept {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return 80;
}

void write_raw(std::string_view text) noexcept {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

} // namespace

bool is_progress_wanted() noexcept {
    const char* const kind = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && (kind == nullptr || std::string_view(kind) != "dumb");
}

std::string format_seconds(double seconds) {
    if (seconds < 9.95)
        return fmt::format("{:.1f} s", std::max(seconds, 0.0));
    if (seconds < 119.5)
        return fmt::format("{:.0f} s", seconds);
    const auto whole = static_cast<long long>(std::min(std::round(seconds), 9e15));
    if (whole < 7200)
        return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string format_progress(const Progress& progress, std::size_t width) {
    const double share = std::clamp(progress.fraction, 0.0, 1.0);
    std::string line = fmt::format("{} {:3.0f} %", progress.stage, std::floor(100.0 * share));
    if (progress.seconds_left >= 0.0)
        line += fmt::format("   {} left", format_seconds(progress.seconds_left));
    if (progress.worst_relative_error > 0.0 && std::isfinite(progress.worst_relative_error))
        line += fmt::format("   worst point +-{:.2g} %", 100.0 * progress.worst_relative_error);
    return line.substr(0, width);
}

void ProgressLine::show(const Progress& progress) {
    if (!is_shown_)
        return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_)
        return;
    next_ = now + std::chrono::milliseconds(100);
    // The last column stays free: some terminals start a new line once it is filled.
    std::string line = format_progress(progress, terminal_width() - 1);
    const std::size_t columns = line.size();
    if (columns < drawn_)
        line.append(drawn_ - columns, ' ');
    write_raw("\r" + line);
    drawn_ = columns;
}

void ProgressLine::clear() noexcept {
    if (drawn_ == 0)
        return;
    write_raw("\r");
    for (std::size_t column = 0; column < drawn_; ++column)
        std::fputc(' ', stderr);
    write_raw("\r");
    drawn_ = 0;
}

} // namespace isolux
