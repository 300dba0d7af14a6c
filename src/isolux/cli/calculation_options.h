#pragma once

#include <memory>
#include <string>

#include "isolux/base/parallel.h"
#include "isolux/calc/project.h"

namespace CLI {
class App;
}

namespace isolux {

/// Options that several verbs share, as the user typed them; empty where not given.
struct CalculationOptions {
    std::string project;
    std::string tolerance;
    std::string seed;
    std::string estimator;
    std::string threads;
};

void add_calculation_options(CLI::App& verb, CalculationOptions& options);

/// The project's own settings, changed by what the command line says. @throws InputError
[[nodiscard]] Settings apply(const CalculationOptions& options, Settings settings);

/// Holds the number of threads while it lives. @throws InputError
[[nodiscard]] std::unique_ptr<ThreadLimit> limit_threads(const CalculationOptions& options);

/// Reads the project and adds what is odd about its scene to its notices.
/// @throws InputError  with everything that is wrong
[[nodiscard]] Project load_project(const std::string& argument);

} // namespace isolux
