#pragma once

#include "isolux/cli/verbs.h"

/// The experiments of `isolux experiment`. A new one is one file with
/// `Action add_x_experiment(CLI::App& experiment)`, one line here and one in the table of
/// experiment.cpp.
namespace isolux {

/// Each adds its options, description and examples to the sub-command.
[[nodiscard]] Action add_sobolev_experiment(CLI::App& experiment);
[[nodiscard]] Action add_denoise_experiment(CLI::App& experiment);
[[nodiscard]] Action add_soft_shadow_experiment(CLI::App& experiment);
[[nodiscard]] Action add_indirect_experiment(CLI::App& experiment);
[[nodiscard]] Action add_lens_experiment(CLI::App& experiment);

} // namespace isolux
