#include <CLI/CLI.hpp>

#include "isolux/cli/console.h"
#include "isolux/cli/verbs.h"

namespace isolux {
Action add_schema(CLI::App& verb) {
    verb.description("Prints a JSON schema");
    return [] { return ExitCode::success; };
}
} // namespace isolux
