#include "isolux/io/text_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "isolux/base/error.h"
#include "isolux/io/suggest.h"

namespace isolux {

namespace fs = std::filesystem;

namespace {

/// Names in the folder where the file was looked for, for a suggestion.
std::vector<std::string> names_beside(const fs::path& path) {
    constexpr std::size_t enough = 1000;
    std::vector<std::string> names;
    std::error_code failed;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (fs::directory_iterator entry(folder, failed), end;
         !failed && entry != end && names.size() < enough;
         entry.increment(failed))
        names.push_back(entry->path().filename().string());
    return names;
}

[[noreturn]] void report_missing(const fs::path& path, const std::string& place) {
    std::error_code failed;
    const fs::path folder = path.parent_path();
    if (!folder.empty() && !fs::is_directory(folder, failed))
        throw InputError(place,
                         fmt::format("cannot find \"{}\" (there is no folder \"{}\")",
                                     path.generic_string(),
                                     folder.generic_string()),
                         "Paths are relative to the project file");
    throw InputError(place,
                     fmt::format("cannot find \"{}\" (no such file)", path.generic_string()),
                     did_you_mean(path.filename().string(), names_beside(path)));
}

} // namespace

std::string
read_file_bytes(const fs::path& path, std::uintmax_t largest, std::string_view where) {
    const std::string place(where.empty() ? path.generic_string() : std::string(where));
    std::error_code failed;
    const fs::file_status status = fs::status(path, failed);
    if (!fs::exists(status))
        report_missing(path, place);
    if (fs::is_directory(status))
        throw InputError(
            place,
            fmt::format("\"{}\" is a folder (a file belongs here)", path.generic_string()));
    if (fs::is_character_file(status) || fs::is_block_file(status) || fs::is_socket(status))
        throw InputError(
            place,
            fmt::format("\"{}\" is a device (a file belongs here)", path.generic_string()));
    const std::uintmax_t size = fs::is_regular_file(status) ? fs::file_size(path, failed) : 0;
    const auto too_large = [&] {
        return InputError(place,
                          fmt::format("\"{}\" is too large (at most {} MB are read)",
                                      path.generic_string(),
                                      largest / 1'000'000));
    };
    if (!failed && size > largest)
        throw too_large();

    std::ifstream stream(path, std::ios::binary);
    if (!stream)
        throw InputError(
            place,
            fmt::format("cannot open \"{}\" ({})",
                        path.generic_string(),
                        std::error_code(errno, std::generic_category()).message()));
    std::string bytes;
    bytes.reserve(size);
    std::vector<char> block(1 << 16);
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size()))
           || stream.gcount() > 0) {
        bytes.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (bytes.size() > largest)
            throw too_large();
    }
    if (stream.bad())
        throw std::system_error(errno, std::generic_category(), path.generic_string());
    return bytes;
}

} // namespace isolux
