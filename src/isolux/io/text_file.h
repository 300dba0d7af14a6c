#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace isolux {

/// Largest files we read, bytes. Whoever needs more has picked the wrong file.
struct FileLimits {
    static constexpr std::uintmax_t project = 16'000'000;
    static constexpr std::uintmax_t photometry = 32'000'000;
    static constexpr std::uintmax_t points = 256'000'000;
    static constexpr std::uintmax_t mesh = 1'000'000'000;
    static constexpr std::uintmax_t results = 1'000'000'000;
    static constexpr std::uintmax_t contributions = 8'000'000'000;
    static constexpr std::uintmax_t picture = 100'000'000;
};

/// The bytes of a file.
/// @param where  place to name in messages; empty: the path itself
/// @throws InputError  no such file (with the nearest name in its folder), a folder, too large
/// @throws std::system_error  the disk failed while reading
[[nodiscard]] std::string read_file_bytes(const std::filesystem::path& path,
                                          std::uintmax_t largest,
                                          std::string_view where = {});

} // namespace isolux
