#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace isolux {

/// What `isolux selftest -o` left in a results folder.
struct SelftestRecord {
    std::string version; ///< of the program that was tested
    std::uint64_t seed = 0;
    std::size_t rows = 0;
    std::size_t passed = 0;
};

/// Nothing where the folder holds no selftest.json that `isolux selftest` wrote.
[[nodiscard]] std::optional<SelftestRecord> find_selftest(const std::filesystem::path& folder);

} // namespace isolux
