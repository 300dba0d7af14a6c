#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "isolux/measure/standard.h"

namespace isolux {

/// The standards that come with isolux, the texts of standards/*.json.
[[nodiscard]] std::vector<Standard> builtin_standards();

/// A standard's file, schema/standard.schema.json, checked for meaning: known words, symbols
/// that exist, sources that exist, no row twice.
/// @throws InputError  with every problem found
[[nodiscard]] Standard parse_standard(std::string_view text, std::string_view source);

/// The same from a file. @throws InputError  also where the file cannot be read
[[nodiscard]] Standard read_standard(const std::filesystem::path& path);

} // namespace isolux
