#include "isolux/io/schema.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "isolux/base/error.h"
#include "isolux/cli/console.h"
#include "isolux/cli/suggest.h"
#include "isolux/cli/verbs.h"

namespace isolux {

namespace {

const std::array<std::string, 3> names{"project", "results", "standard"};

ExitCode print_schema(const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        const auto similar = find_similar(name, names);
        throw InputError("isolux schema",
                         fmt::format("there is no schema '{}'", name),
                         similar ? fmt::format("Did you mean {}?", *similar)
                                 : fmt::format("Known are {}", fmt::join(names, ", ")));
    }
    print(name == "project"   ? project_schema()
          : name == "results" ? results_schema()
                              : standard_schema());
    return ExitCode::success;
}

} // namespace

Action add_schema(CLI::App& verb) {
    verb.description("Print the JSON schema of project files, of results.json or of standards");
    verb.footer(R"(
Examples:
  isolux schema > project.schema.json     give it to your editor
  isolux schema results                   what results.json contains
  isolux schema standard                  for a table of requirements of your own)");
    const auto name = std::make_shared<std::string>("project");
    verb.add_option("NAME", *name, fmt::format("{}", fmt::join(names, ", ")))
        ->capture_default_str();
    return [name] { return print_schema(*name); };
}

} // namespace isolux
