#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isolux {

/// A place where a document departs from the schema.
struct SchemaFinding {
    std::string pointer; ///< JSON pointer
    std::string reason;  ///< the validator's words
};

/// Where the text of a project file departs from `project_schema()`: the deepest places only,
/// not the objects around them.
/// @pre the text is JSON (with comments)
[[nodiscard]] std::vector<SchemaFinding> check_project_schema(std::string_view text);

} // namespace isolux
