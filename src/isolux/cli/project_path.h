#pragma once

#include <filesystem>
#include <string>

namespace isolux {

/// The project file meant by a command-line argument: the file itself, or the `project.json`
/// of a folder. @throws InputError  when there is no such thing
[[nodiscard]] std::filesystem::path find_project_file(const std::string& argument);

} // namespace isolux
