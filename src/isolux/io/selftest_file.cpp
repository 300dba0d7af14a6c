#include "isolux/io/selftest_file.h"

#include <nlohmann/json.hpp>

#include "isolux/io/text_file.h"

namespace isolux {

std::optional<SelftestRecord> find_selftest(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "selftest.json";
    if (!std::filesystem::exists(file))
        return std::nullopt;
    try {
        const auto j = nlohmann::json::parse(read_file_bytes(file, FileLimits::project));
        SelftestRecord test{j.at("version"), j.at("seed"), j.at("rows").size(), 0};
        for (const auto& row : j.at("rows"))
            test.passed += row.at("pass").get<bool>() ? 1U : 0U;
        return test;
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

} // namespace isolux
