#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/calc/contributions.h"
#include "isolux/calc/results.h"

/// The light of every source by itself, on disk. `contributions.npy` holds the numbers in
/// NumPy's format (version 1.0, little-endian float32, C order) with the axes part (direct,
/// indirect), source, replicate, point; `contributions.json` says what they are. Both are
/// written as whole files; the index carries the SHA-256 of the table, so that a mixed pair is
/// noticed.
namespace isolux {

/// Which points of the table belong to a surface.
struct SurfacePoints {
    std::string surface;
    std::size_t first_point = 0;
    std::size_t points = 0;

    friend bool operator==(const SurfacePoints&, const SurfacePoints&) = default;
};

/// A table and where its points lie.
struct ContributionsDocument {
    std::vector<SurfacePoints> surfaces;
    Contributions contributions;
};

inline constexpr const char* contributions_table = "contributions.npy";
inline constexpr const char* contributions_index = "contributions.json";

/// The table as the bytes of contributions.npy.
[[nodiscard]] std::string to_npy(const Contributions& contributions);

/// The index as JSON text. @param table_sha256  of the bytes of the table
[[nodiscard]] std::string to_contributions_json(const ContributionsDocument& document,
                                                std::string_view table_sha256);

/// Writes both files into an existing folder, the table first. @throws WriteError
void write_contributions(const std::filesystem::path& folder, const Results& results);

/// Removes both files where they are, so that those of an earlier run are not taken for this
/// one's. @throws WriteError
void remove_contributions(const std::filesystem::path& folder);

/// Reads both files of a results folder.
/// @throws InputError  a file is missing, is not of this format, or the two do not belong
/// together
[[nodiscard]] ContributionsDocument read_contributions(const std::filesystem::path& folder);

} // namespace isolux
