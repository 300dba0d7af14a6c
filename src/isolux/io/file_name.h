#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isolux {

/// A file name without its extension for a thing the user named: the name itself as far as it
/// can be one. Characters that mean something to a file system or a shell's globbing, control
/// characters and bytes that are no UTF-8 become "_"; at most 120 bytes; never empty, never
/// hidden, no space or dot at an end.
[[nodiscard]] std::string file_stem(std::string_view name);

/// The stems of several names, all different even where upper and lower case are not: the
/// second "desk" becomes "desk-2".
[[nodiscard]] std::vector<std::string> file_stems(std::span<const std::string> names);

} // namespace isolux
