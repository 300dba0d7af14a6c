#include "isolux/cli/results_path.h"

#include <system_error>

#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/io/json_value.h"
#include "isolux/io/text_file.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

/// Whether a file is a project's: JSON with the key that every project has.
bool is_project_file(const fs::path& path) {
    try {
        const std::string text = read_file_bytes(path, FileLimits::project);
        return parse_json(text, path.string()).find("isolux") != nullptr;
    } catch (const std::exception&) {
        return false; // its own reader says better what is wrong with it
    }
}

[[noreturn]] void throw_is_project(const std::string& argument) {
    throw InputError(
        argument,
        "that is a project, not its results",
        fmt::format("Run `isolux run {}` first and name the folder it writes", argument));
}

} // namespace

fs::path find_results_file(const std::string& argument) {
    const fs::path path(argument);
    std::error_code error;
    if (!fs::is_directory(path, error)) {
        if (path.filename() != "results.json" && is_project_file(path))
            throw_is_project(argument);
        return path;
    }
    const fs::path results = path / "results.json";
    if (fs::exists(results, error))
        return results;
    if (fs::exists(path / "project.json", error))
        throw_is_project(argument);
    throw InputError(argument,
                     "no results.json in this folder",
                     "`isolux run PROJECT -o DIR` writes results into DIR");
}

} // namespace isolux
