#pragma once

#include <cstddef>
#include <string>

#include "isolux/cli/verbs.h"
#include "isolux/photometry/read_photometry.h"

/// The sub-verbs of `isolux photometry`. A new one is one file with its `add_photometry_x`, one
/// line here and one in the table of photometry.cpp.
namespace isolux {

[[nodiscard]] Action add_photometry_info(CLI::App& verb);
[[nodiscard]] Action add_photometry_candela(CLI::App& verb);
[[nodiscard]] Action add_photometry_convert(CLI::App& verb);
[[nodiscard]] Action add_photometry_plot(CLI::App& verb);
[[nodiscard]] Action add_photometry_ugr_table(CLI::App& verb);
[[nodiscard]] Action add_photometry_validate(CLI::App& verb);

/// How a luminaire file is to be read; the same options for every sub-verb.
struct LuminaireFileOptions {
    bool strict = false;
    std::string lamp_set = "1";
    std::string variant; ///< GLDF
};

/// Adds --strict, --lamp-set and --variant.
void add_luminaire_file_options(CLI::App& verb, LuminaireFileOptions& options);

/// @throws InputError  an option that is no number, or whatever the file has wrong
[[nodiscard]] Parsed<LuminairePhotometry>
read_luminaire_file(const std::string& file, const LuminaireFileOptions& options);

/// The line a message's place ends with; 0 if it names none.
[[nodiscard]] std::size_t line_of(const Message& message) noexcept;

} // namespace isolux
