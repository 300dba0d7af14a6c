#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/base/error.h"

/// Where in its text a JSON value stands. Our JSON parser does not tell; a scan over texts,
/// brackets and commas does.
namespace isolux {

/// The line, counted from 1, of every pointer (RFC 6901): that of a member's key, of an
/// element's first character. A pointer to nothing has the line of what is nearest above it; a
/// key that stands twice, the line of the second.
/// @pre `text` is JSON, with comments perhaps; anything else gives some line, too
[[nodiscard]] std::vector<std::size_t> find_lines(std::string_view text,
                                                  std::span<const std::string> pointers);

/// Gives messages about `file` their line: "file#/rooms/0" becomes "file:7: #/rooms/0", and
/// what is about the file as a whole, "file#", becomes "file:1". Others stay as they are.
void add_lines(std::vector<Message>& messages, const std::string& file, std::string_view text);

} // namespace isolux
