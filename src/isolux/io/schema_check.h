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

/// Where a document departs from a schema: the deepest places only, not the objects around
/// them. @pre both texts are JSON (the document's may have comments)
[[nodiscard]] std::vector<SchemaFinding> check_schema(std::string_view schema,
                                                      std::string_view text);

/// Where the text of a project file departs from `project_schema()`: the deepest places only,
/// not the objects around them.
/// @pre the text is JSON (with comments)
[[nodiscard]] std::vector<SchemaFinding> check_project_schema(std::string_view text);

} // namespace isolux
