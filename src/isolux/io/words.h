#pragma once

#include <span>
#include <string>
#include <string_view>

namespace isolux {

/// `"a", "b" and "c"`. @param last_joint  "and", "or"
[[nodiscard]] std::string enumerate(std::span<const std::string> words,
                                    std::string_view last_joint);

/// Text of the user in quotes as it may stand in a message: short, no control characters.
[[nodiscard]] std::string in_quotes(std::string_view text);

} // namespace isolux
