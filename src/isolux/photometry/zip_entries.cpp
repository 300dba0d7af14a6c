#include "isolux/photometry/zip_entries.h"

#include <algorithm>
#include <cstdint>

#include <zip.h>

#include "isolux/photometry/file_number.h"
#include "isolux/photometry/source_text.h"

namespace isolux {

namespace {

constexpr std::int64_t most_entries = 4096;
constexpr std::uint64_t largest_entry = SourceText::max_bytes;
/// No text of numbers packs better than that; zeros do.
constexpr std::uint64_t largest_growth = 1000;

zip_t* handle(void* archive) { return static_cast<zip_t*>(archive); }

std::string reason(zip_error_t& error) {
    std::string text = zip_error_strerror(&error);
    zip_error_fini(&error);
    return text;
}

} // namespace

ZipEntries::ZipEntries(std::string_view bytes, const Findings& findings) : findings_(findings) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* const source =
        zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source != nullptr)
        archive_ = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (archive_ == nullptr) {
        if (source != nullptr)
            zip_source_free(source);
        findings.fail(1,
                      "a ZIP container that cannot be opened (" + reason(error) + ")",
                      "Truncated file?");
    }
    zip_error_fini(&error);
    const std::int64_t count = zip_get_num_entries(handle(archive_), 0);
    if (count > most_entries) {
        zip_discard(handle(archive_));
        findings.fail(1,
                      std::to_string(count)
                          + " files in the container (no luminaire needs more " + "than "
                          + std::to_string(most_entries) + ")");
    }
    for (std::int64_t i = 0; i < count; ++i) {
        const char* const name =
            zip_get_name(handle(archive_), static_cast<zip_uint64_t>(i), ZIP_FL_ENC_GUESS);
        names_.emplace_back(name != nullptr ? name : "");
    }
}

ZipEntries::~ZipEntries() {
    if (archive_ != nullptr)
        zip_discard(handle(archive_));
}

bool ZipEntries::is_inside(std::string_view name) noexcept {
    if (name.empty() || name.starts_with('/') || name.find('\\') != std::string_view::npos
        || name.find(':') != std::string_view::npos || name.size() > 1024)
        return false;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        if (name.substr(begin, end - begin) == "..")
            return false;
        begin = end + 1;
    }
    return true;
}

std::optional<std::size_t> ZipEntries::index_of(std::string_view name) const {
    const auto exact = std::ranges::find(names_, name);
    if (exact != names_.end())
        return static_cast<std::size_t>(exact - names_.begin());
    std::optional<std::size_t> similar;
    const std::string upper = to_upper(name);
    for (std::size_t i = 0; i < names_.size(); ++i)
        if (to_upper(names_[i]) == upper) {
            if (similar)
                return std::nullopt;
            similar = i;
        }
    return similar;
}

std::optional<std::string> ZipEntries::read(std::string_view name) const {
    if (!is_inside(name))
        findings_.fail(1,
                       "the name " + quoted(name)
                           + " leads out of the container (such files are not opened)");
    const auto index = index_of(name);
    if (!index)
        return std::nullopt;
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat_index(handle(archive_), *index, 0, &stat) != 0
        || (stat.valid & ZIP_STAT_SIZE) == 0)
        findings_.fail(1, quoted(name) + " in the container has no size (damaged directory)");
    if (stat.size > largest_entry
        || ((stat.valid & ZIP_STAT_COMP_SIZE) != 0
            && stat.size / largest_growth > stat.comp_size + 1))
        findings_.fail(1,
                       quoted(name) + " unpacks to " + std::to_string(stat.size)
                           + " bytes (no luminaire file needs that; a decompression bomb?)");
    zip_file_t* const file = zip_fopen_index(handle(archive_), *index, 0);
    if (file == nullptr)
        findings_.fail(1,
                       quoted(name) + " in the container cannot be read ("
                           + zip_strerror(handle(archive_)) + ")");
    std::string bytes(static_cast<std::size_t>(stat.size), '\0');
    const std::int64_t got = zip_fread(file, bytes.data(), bytes.size());
    char beyond = 0; // the checksum is compared where the entry ends
    const bool ends_there = zip_fread(file, &beyond, 1) == 0;
    const bool is_intact = zip_fclose(file) == 0 && ends_there;
    if (got != static_cast<std::int64_t>(bytes.size()) || !is_intact)
        findings_.fail(1, quoted(name) + " in the container is damaged");
    return bytes;
}

} // namespace isolux
