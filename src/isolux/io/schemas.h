#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The published JSON Schemas (`schema/<name>.schema.json`), carried inside the library.
namespace isolux {

/// Names of all schemas, in alphabetical order: "project", ...
[[nodiscard]] std::vector<std::string> schema_names();

/// Text of a schema, exactly as published.
[[nodiscard]] std::optional<std::string_view> find_schema(std::string_view name) noexcept;

} // namespace isolux
