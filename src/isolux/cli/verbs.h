#pragma once

#include <functional>

namespace CLI {
class App;
}

/// The command's verbs. A new verb is one file with `Action add_x(CLI::App& verb)`, one line
/// here and one in the table of command_line.cpp.
namespace isolux {

/// What the process ends with.
enum class ExitCode {
    success = 0,
    failure = 1,   ///< anything that is not the user's input
    bad_input = 2, ///< the user's files or options
};

/// What a verb does once its options are known. InputError becomes ExitCode::bad_input, any
/// other exception ExitCode::failure.
using Action = std::function<ExitCode()>;

/// Each adds its options, description and examples to the sub-command `verb`.
[[nodiscard]] Action add_run(CLI::App& verb);
[[nodiscard]] Action add_sense(CLI::App& verb);
[[nodiscard]] Action add_luminance(CLI::App& verb);
[[nodiscard]] Action add_render(CLI::App& verb);
[[nodiscard]] Action add_compare(CLI::App& verb);
[[nodiscard]] Action add_check(CLI::App& verb);
[[nodiscard]] Action add_selftest(CLI::App& verb);
[[nodiscard]] Action add_reference(CLI::App& verb);
[[nodiscard]] Action add_report(CLI::App& verb);
[[nodiscard]] Action add_experiment(CLI::App& verb);
[[nodiscard]] Action add_bench(CLI::App& verb);
[[nodiscard]] Action add_schema(CLI::App& verb);
[[nodiscard]] Action add_photometry(CLI::App& verb);
[[nodiscard]] Action add_standards(CLI::App& verb);
[[nodiscard]] Action add_diff(CLI::App& verb);
[[nodiscard]] Action add_scenes(CLI::App& verb);
[[nodiscard]] Action add_view(CLI::App& verb);

} // namespace isolux
