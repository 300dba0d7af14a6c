#pragma once

#include <filesystem>
#include <string_view>

#include "isolux/calc/project.h"

namespace isolux {

/// Reads a project file (JSON with comments) and every file it names: checks the JSON, the
/// schema (`project_schema()`), the meaning, and expands fields, lines, rings and arrays. Paths
/// in the file are relative to its folder. What was assumed on the way is in
/// Project::notices.
/// @throws InputError  with every problem found: `file:line:column` for what is no JSON,
/// `file:line: #/json/pointer` for the rest
[[nodiscard]] Project read_project(const std::filesystem::path& path);

/// The same from the text of the file. @param path  names the file in messages and says where
/// other files are looked for; it need not exist
[[nodiscard]] Project parse_project(std::string_view text, const std::filesystem::path& path);

} // namespace isolux
