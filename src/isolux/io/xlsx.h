#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "isolux/io/results_json.h"

namespace isolux {

/// Names for sheets: at most 31 characters, without what spreadsheets refuse, all different
/// even where upper and lower case are not. @param reserved  names that are taken already
[[nodiscard]] std::vector<std::string> sheet_names(std::span<const std::string> names,
                                                   std::span<const std::string> reserved);

/// Writes the results as an Excel workbook: summary, verdicts, observers, luminaires, energy,
/// one sheet a surface with its points, and what was calculated with. Units stand in the heads,
/// which stay in view; numbers are numbers, with as many decimals as their errors deserve.
/// @throws WriteError
void write_xlsx(const std::filesystem::path& path, const ResultsDocument& document);

} // namespace isolux
