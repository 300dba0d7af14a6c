#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/photometry/findings.h"

namespace isolux {

/// The files in a ZIP container that lies in memory; nothing is ever written to the disk.
///
/// What is unpacked is bounded: at most 4096 entries, 32 MiB an entry, and no entry that grows
/// more than thousandfold. Names that point out of the container (absolute ones, drive letters,
/// "..") are refused when they are asked for.
class ZipEntries {
public:
    /// @param bytes  must outlive the object
    /// @throws InputError  no readable container, too many entries
    ZipEntries(std::string_view bytes, const Findings& findings);
    ~ZipEntries();
    ZipEntries(const ZipEntries&) = delete;
    ZipEntries& operator=(const ZipEntries&) = delete;

    [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }

    /// The whole entry of exactly that name, else of the only name that equals it but for the
    /// case of its letters; nothing if there is none.
    /// @throws InputError  encrypted, damaged, too large, or a name that leaves the container
    [[nodiscard]] std::optional<std::string> read(std::string_view name) const;

    /// False for absolute names, backslashes, drive letters and steps upwards.
    [[nodiscard]] static bool is_inside(std::string_view name) noexcept;

private:
    [[nodiscard]] std::optional<std::size_t> index_of(std::string_view name) const;

    const Findings& findings_;
    void* archive_ = nullptr; ///< zip_t
    std::vector<std::string> names_;
};

} // namespace isolux
