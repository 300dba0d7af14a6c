#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "isolux/photometry/read_photometry.h"

#include "source_dir.h"

/// The photometric test files that may lie beside the checkout. Tests skip where they are
/// absent.
namespace isolux::corpus {

inline std::filesystem::path root() {
    return isolux::test::source_dir() / ".." / "shared" / "photometry";
}

inline bool is_present() { return std::filesystem::is_directory(root() / "valid"); }

inline std::string read_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline PhotometryOptions options_beside(const std::filesystem::path& path) {
    PhotometryOptions options;
    options.sibling =
        [folder = path.parent_path()](std::string_view name) -> std::optional<std::string> {
        if (!std::filesystem::is_regular_file(folder / name))
            return std::nullopt;
        return read_bytes(folder / name);
    };
    return options;
}

/// Reads folder/name; messages call it by `name` alone.
inline Parsed<LuminairePhotometry> read(const std::string& folder, const std::string& name) {
    const auto path = root() / folder / name;
    return parse_photometry(read_bytes(path), name, options_beside(path));
}

inline std::vector<std::string> files(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(root() / folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".ies" || extension == ".ldt")
            names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace isolux::corpus

#define ISOLUX_NEEDS_CORPUS()                                                                  \
    if (!isolux::corpus::is_present())                                                         \
    GTEST_SKIP() << "no photometric test files beside the checkout"
