#pragma once

#include <filesystem>
#include <string>

namespace isolux {

/// The results.json in a folder of results, or the file itself.
/// @throws InputError  where there is none; for a project, with the command that makes results
[[nodiscard]] std::filesystem::path find_results_file(const std::string& argument);

} // namespace isolux
