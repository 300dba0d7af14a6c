#include "isolux/cli/project_path.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/cli/suggest.h"

namespace isolux {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> entries_of(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error))
        names.push_back(entry.path().filename().string());
    return names;
}

std::string only_project_in(const fs::path& folder) {
    std::string found;
    for (const std::string& name : entries_of(folder)) {
        if (!name.ends_with(".json"))
            continue;
        if (!found.empty())
            return {};
        found = name;
    }
    return found.empty() ? found : (folder / found).string();
}

bool is_luminaire_file(const fs::path& path) {
    std::string ending = path.extension().string();
    for (char& c : ending)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    constexpr std::array<std::string_view, 4> endings{".ldt", ".ies", ".gldf", ".xml"};
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

} // namespace

std::filesystem::path find_project_file(const std::string& argument) {
    fs::path path(argument);
    std::error_code error;
    if (fs::is_directory(path, error)) {
        if (fs::exists(path / "project.json", error))
            return path / "project.json";
        const std::string other = only_project_in(path);
        throw InputError(argument,
                         "no project.json in this folder",
                         other.empty() ? "Name the project file itself"
                                       : fmt::format("Did you mean {}?", other));
    }
    if (fs::exists(path, error)) {
        if (is_luminaire_file(path))
            throw InputError(
                argument,
                "this is a luminaire file, not a project",
                fmt::format("`isolux photometry info {}` tells what it says", argument));
        return path;
    }
    if (!path.has_filename())
        path = path.parent_path();
    const fs::path folder = path.parent_path();
    const auto similar = find_similar(path.filename().string(), entries_of(folder));
    throw InputError(argument,
                     "no such file or folder",
                     similar ? fmt::format("Did you mean {}?", (folder / *similar).string())
                             : "");
}

} // namespace isolux
