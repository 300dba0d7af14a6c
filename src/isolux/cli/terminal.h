#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "isolux/calc/calculate.h"

namespace isolux {

/// Standard error is a terminal that can redraw a line, and somebody watches it.
[[nodiscard]] bool is_progress_wanted() noexcept;

/// Seconds as people say them: "0.4 s", "45 s", "3 min 20 s", "2 h 5 min".
[[nodiscard]] std::string format_seconds(double seconds);

/// "calculating   45 %   12 s left   worst point +-1.8 %", cut to `width` columns.
[[nodiscard]] std::string format_progress(const Progress& progress, std::size_t width);

/// One line on standard error that is drawn over and over, at most ten times a second, and
/// wiped when the object goes. Plain characters and a carriage return only: no colours, no
/// escape sequences, so there is nothing that NO_COLOR would have to switch off.
class ProgressLine {
public:
    explicit ProgressLine(bool is_shown) noexcept : is_shown_(is_shown) {}

    ~ProgressLine() { clear(); }

    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void show(const Progress& progress);
    void clear() noexcept;

private:
    bool is_shown_;
    std::size_t drawn_ = 0; ///< columns to wipe
    std::chrono::steady_clock::time_point next_{};
};

} // namespace isolux
