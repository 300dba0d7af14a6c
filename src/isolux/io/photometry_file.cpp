#include "isolux/io/photometry_file.h"

#include <string>

#include "isolux/io/text_file.h"

namespace isolux {

namespace {

/// A file beside `path`; nothing if it cannot be read (the photometric reader says so).
std::optional<std::string> read_beside(const std::filesystem::path& path,
                                       std::string_view name) {
    const std::filesystem::path plain = std::filesystem::path(name).filename();
    try {
        return read_file_bytes(path.parent_path() / plain, FileLimits::photometry);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

} // namespace

Parsed<LuminairePhotometry> read_photometry(const std::filesystem::path& path,
                                            const PhotometryOptions& options) {
    const std::string bytes = read_file_bytes(path, FileLimits::photometry);
    PhotometryOptions with_folder = options;
    with_folder.sibling = [&path](std::string_view name) { return read_beside(path, name); };
    return parse_photometry(bytes, path.generic_string(), with_folder);
}

} // namespace isolux
