#pragma once

#include <string_view>

namespace isolux {

/// JSON Schema (draft 07) of the project file, the text of schema/project.schema.json.
[[nodiscard]] std::string_view project_schema() noexcept;

/// JSON Schema (draft 07) of results.json, the text of schema/results.schema.json.
[[nodiscard]] std::string_view results_schema() noexcept;

/// JSON Schema (draft 07) of a standard's file, the text of schema/standard.schema.json.
[[nodiscard]] std::string_view standard_schema() noexcept;

} // namespace isolux
