#pragma once

#include <string>
#include <vector>

#include "isolux/io/json_value.h"

/// JSON values made by us, so that what isolux adds to a project reads like what a user writes.
namespace isolux {

[[nodiscard]] JsonValue json_text(std::string text);
[[nodiscard]] JsonValue json_number(double number);
[[nodiscard]] JsonValue json_object(std::vector<JsonMember> members);

} // namespace isolux
