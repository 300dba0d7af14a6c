#include "isolux/viz/output_file.h"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace isolux {

void write_output_file(const std::filesystem::path& path, std::string_view bytes) {
    std::filesystem::path temporary = path;
    temporary += ".part";
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out)
        throw std::system_error(
            errno, std::generic_category(), "cannot write " + temporary.string());
    std::filesystem::rename(temporary, path);
}

} // namespace isolux
