#pragma once

#include <span>
#include <string>

#include "isolux/cli/verbs.h"

namespace isolux {

/// Runs one command line (without the program's name) and says how the process should end.
/// Results go to standard output, messages to standard error. Never throws.
[[nodiscard]] ExitCode run_command_line(std::span<const std::string> arguments) noexcept;

} // namespace isolux
