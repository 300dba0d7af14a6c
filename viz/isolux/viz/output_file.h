#pragma once

#include <filesystem>
#include <string_view>

namespace isolux {

/// Writes `bytes` under a temporary name beside `path`, then renames: a kill at any moment
/// leaves no half file. @throws std::system_error naming the path
void write_output_file(const std::filesystem::path& path, std::string_view bytes);

} // namespace isolux
