#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace isolux {

/// A file could not be written: `path: cannot be written (why). Suggestion?`
class WriteError : public std::system_error {
public:
    WriteError(const std::filesystem::path& path, std::error_code why);

    [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

private:
    std::string text_;
};

/// Writes a whole file: under a temporary name (hidden, ends in ".tmp") in the same folder,
/// flushed to the disk, then renamed. A kill or a power cut at any moment leaves the old file
/// or the new one, never half of one. The folder must exist.
/// @throws WriteError  disk full, no permission, no such folder ...; the old file is untouched
void write_file_safely(const std::filesystem::path& path, std::string_view bytes);

/// Removes a file; one that is not there is no error. @throws WriteError
void remove_file(const std::filesystem::path& path);

/// Makes a folder, and those above it, where they are missing. @throws WriteError
void make_folder(const std::filesystem::path& path);

} // namespace isolux
